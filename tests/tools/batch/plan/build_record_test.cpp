#include "tools/batch/plan/build_record.h"

#include <gtest/gtest.h>

#include <random>

#include "cache/base/file.h"
#include "tests/preprocess/read/read_support.h"

namespace farcell {
namespace {

namespace fs = std::filesystem;

class BuildRecordTest : public testing::Test {
 protected:
  BuildRecordTest() {
    const auto pack = identityOf(directory_.write("a.far", "pack"));
    const auto mesh = identityOf(directory_.write("a \xff\xc3\xa9.ply", "mesh"));
    record_ = {FARCELL_VERSION, {"--views=12", "--", "\xc3\xa9.ply"}, *pack, {*mesh}, 7};
    keep(recordText(record_));
  }
  fs::path place() const { return directory_.path() / "a.json"; }
  void keep(const std::string& text) const { directory_.write("a.json", text); }
  bool current() const { return currentRecord(place(), record_.arguments).has_value(); }

  test::TempDirectory directory_;
  BuildRecord record_;
};

TEST_F(BuildRecordTest, IsReadAsItWasWritten) {
  EXPECT_EQ(parseRecord(recordText(record_)), record_);
  EXPECT_EQ(currentRecord(place(), record_.arguments), record_);
}

TEST_F(BuildRecordTest, AnotherSizeOrTimeOfAnyFileIsNotCurrent) {
  for (const std::string& path : {record_.pack.path, record_.files[0].path}) {
    ASSERT_TRUE(current());
    const auto time = fs::last_write_time(path);
    fs::last_write_time(path, time + std::chrono::nanoseconds(1));
    EXPECT_FALSE(current()) << path;
    fs::last_write_time(path, time);
    ASSERT_TRUE(current());
    const auto bytes = fs::file_size(path);
    fs::resize_file(path, bytes + 1);
    fs::last_write_time(path, time);
    EXPECT_FALSE(current()) << path;
    fs::resize_file(path, bytes);
    fs::last_write_time(path, time);
  }
  fs::remove(record_.files[0].path);
  EXPECT_FALSE(current());
}

TEST_F(BuildRecordTest, OtherArgumentsAnotherVersionOrNoFilesAreNotCurrent) {
  EXPECT_FALSE(currentRecord(place(), {"--views=42", "--", "\xc3\xa9.ply"}));
  BuildRecord other = record_;
  other.version += "x";
  keep(recordText(other));
  EXPECT_FALSE(current());
  other = record_;
  other.files.clear();
  keep(recordText(other));
  EXPECT_FALSE(current());
}

TEST_F(BuildRecordTest, DamagedTextIsNoRecordOrTheOneItSays) {
  const uint32_t seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  const std::string whole = recordText(record_);
  for (size_t length = 0; length + 2 < whole.size(); ++length) EXPECT_FALSE(parseRecord(whole.substr(0, length)));
  for (int i = 0; i < 2'000; ++i) {
    std::string text = whole;
    text[random() % text.size()] = static_cast<char>(random());
    if (const auto record = parseRecord(text)) {
      EXPECT_EQ(parseRecord(recordText(*record)), record);
    }
  }
  EXPECT_FALSE(parseRecord(std::string(1'000'000, '[')));
  EXPECT_FALSE(parseRecord("{\"version\":1}"));
}

}  // namespace
}  // namespace farcell
