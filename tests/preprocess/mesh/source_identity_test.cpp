#include "preprocess/mesh/source_identity.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>

namespace farcell {
namespace {

class SourceIdentityTest : public testing::Test {
 protected:
  SourceIdentityTest() {
    std::string name = (std::filesystem::temp_directory_path() / "farcell-identity.XXXXXX").string();
    directory_ = ::mkdtemp(name.data());
    write("a.ply", "one");
    write("b\n\\.ply", "two");
  }
  ~SourceIdentityTest() override { std::filesystem::remove_all(directory_); }

  void write(const std::string& name, const std::string& text) { std::ofstream(directory_ / name) << text; }
  Result<SourceIdentity> identity() const {
    return sourceIdentity(std::vector{directory_ / "a.ply", directory_ / "b\n\\.ply"});
  }

  std::filesystem::path directory_;
};

TEST_F(SourceIdentityTest, IsALineOfEachFileAndEqualWhileNothingChanges) {
  const SourceIdentity now = identity().value();
  ASSERT_EQ(now.files.size(), 2u);
  EXPECT_EQ(now.files[0].sizeBytes, 3u);
  const std::string text = now.text();
  EXPECT_EQ(identity().value().text(), text);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2);
  EXPECT_NE(text.find("/b\\n\\\\.ply\n"), std::string::npos) << text;
}

TEST_F(SourceIdentityTest, TellsSizeTimeAndReplacementApart) {
  const std::string before = identity().value().text();
  const std::filesystem::path a = directory_ / "a.ply";
  const auto written = std::filesystem::last_write_time(a);
  write("a.ply", "longer");
  std::filesystem::last_write_time(a, written);
  EXPECT_NE(identity().value().text(), before);
  write("a.ply", "two");
  std::filesystem::last_write_time(a, written + std::chrono::nanoseconds(1));
  EXPECT_NE(identity().value().text(), before);
  std::filesystem::last_write_time(a, written);
  EXPECT_EQ(identity().value().text(), before);
  write("c.ply", "six");  // beside the old file, so that it has another inode
  std::filesystem::rename(directory_ / "c.ply", a);
  std::filesystem::last_write_time(a, written);
  EXPECT_NE(identity().value().text(), before);
  EXPECT_NE(sourceIdentity(std::vector{a}).value().text(), before);
}

TEST_F(SourceIdentityTest, AVanishedFileIsNotFound) {
  std::filesystem::remove(directory_ / "a.ply");
  const auto gone = identity();
  ASSERT_FALSE(gone);
  EXPECT_EQ(gone.error().kind, ErrorKind::notFound);
}

}  // namespace
}  // namespace farcell
