#include "preprocess/build/journal.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <string>

#include "tests/preprocess/read/read_support.h"

namespace farcell::test {
namespace {

std::span<const std::byte> bytesOf(const std::string& text) { return std::as_bytes(std::span(text)); }
std::string textOf(std::span<const std::byte> bytes) {
  return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

class JournalTest : public testing::Test {
 protected:
  // Opens it; what it tells of is found in `heads` and `places`.
  Journal open(uint32_t writer = 0) {
    heads.clear();
    places.clear();
    return Journal::open(
               directory.path(), writer,
               [this](const JournalRecord& record, std::span<const std::byte> head, const JournalPlace& place) {
                 heads[record.id] = textOf(head);
                 places[record.id] = place;
               })
        .value();
  }
  std::filesystem::path file(int writer = 0) const { return directory.path() / fmt::format("cells.{}.log", writer); }

  TempDirectory directory;
  std::map<uint64_t, std::string> heads;
  std::map<uint64_t, JournalPlace> places;
};

TEST_F(JournalTest, TellsAgainWhatWasAdded) {
  {
    Journal journal = open();
    ASSERT_TRUE(journal.add({1, 7}, bytesOf("seven"), bytesOf("body of seven")));
    ASSERT_TRUE(journal.add({1, 8}, bytesOf(""), bytesOf("")));
    EXPECT_EQ(heads[7], "seven") << "told at once";
  }
  const Journal journal = open();
  ASSERT_EQ(heads.size(), 2u);
  EXPECT_EQ(heads[7], "seven");
  EXPECT_EQ(textOf(journal.read(places[7]).value()), "body of seven");
  EXPECT_EQ(textOf(journal.read(places[8]).value()), "");
}

TEST_F(JournalTest, AFileCutAnywhereKeepsTheRecordsBeforeTheCutAndGoesOn) {
  std::vector<uint64_t> ends = {0};
  {
    Journal journal = open();
    for (uint64_t id = 0; id < 3; ++id) {
      ASSERT_TRUE(journal.add({1, id}, bytesOf("head"), bytesOf(std::string(20 + id, 'b'))));
      ends.push_back(std::filesystem::file_size(file()));
    }
  }
  std::ifstream in(file(), std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(in)), {});
  for (size_t size = 0; size <= whole.size(); ++size) {
    std::ofstream(file(), std::ios::binary) << whole.substr(0, size);
    size_t kept = 0;
    while (kept < 3 && ends[kept + 1] <= size) ++kept;
    Journal journal = open();
    EXPECT_EQ(heads.size(), kept) << "cut at " << size;
    EXPECT_EQ(std::filesystem::file_size(file()), ends[kept]) << "cut at " << size;
    ASSERT_TRUE(journal.add({1, 99}, bytesOf("new"), bytesOf("x")));
  }
}

TEST_F(JournalTest, AFlippedBitEndsTheFileThere) {
  {
    Journal journal = open();
    ASSERT_TRUE(journal.add({1, 1}, bytesOf("first"), bytesOf("body")));
    ASSERT_TRUE(journal.add({1, 2}, bytesOf("second"), bytesOf("body")));
  }
  std::ifstream in(file(), std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(in)), {});
  for (size_t at = 0; at < whole.size(); ++at) {
    std::string flipped = whole;
    flipped[at] ^= 0x10;
    std::ofstream(file(), std::ios::binary) << flipped;
    open();
    EXPECT_EQ(heads.size(), at < whole.size() / 2 ? 0u : 1u) << "byte " << at;
  }
}

TEST_F(JournalTest, ReadsWhatOtherProcessesAddWithoutTouchingTheirFiles) {
  Journal other = Journal::open(directory.path(), 1, [](const auto&, auto, const auto&) {}).value();
  Journal own = open(0);
  ASSERT_TRUE(other.add({1, 5}, bytesOf("theirs"), bytesOf("their body")));
  EXPECT_EQ(heads.count(5), 0u);
  ASSERT_TRUE(own.refresh());
  EXPECT_EQ(heads[5], "theirs");
  EXPECT_EQ(textOf(own.read(places[5]).value()), "their body");
  // Half a record of a process that is still writing.
  std::ofstream(file(1), std::ios::binary | std::ios::app) << "FJR1 and then nothing";
  const auto size = std::filesystem::file_size(file(1));
  ASSERT_TRUE(own.refresh());
  open(0);
  EXPECT_EQ(std::filesystem::file_size(file(1)), size);
}

}  // namespace
}  // namespace farcell::test
