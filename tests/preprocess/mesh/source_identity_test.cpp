#include "preprocess/mesh/source_identity.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>

namespace farcell {
namespace {

// A mesh of files and nothing else.
class Files final : public MeshReader {
 public:
  explicit Files(std::vector<std::filesystem::path> files) : files_(std::move(files)) {}
  const MeshInfo& info() const override { return info_; }
  std::vector<std::filesystem::path> files() const override { return files_; }
  Result<MeshCounts> forEachTriangle(const Sink&) override { return MeshCounts{}; }

 private:
  std::vector<std::filesystem::path> files_;
  MeshInfo info_;
};

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
    return sourceIdentity(Files({directory_ / "a.ply", directory_ / "b\n\\.ply"}));
  }

  std::filesystem::path directory_;
};

TEST_F(SourceIdentityTest, IsEqualWhileNothingChangesAndSurvivesItsText) {
  const SourceIdentity now = identity().value();
  ASSERT_EQ(now.files.size(), 2u);
  EXPECT_EQ(now.files[0].sizeBytes, 3u);
  EXPECT_EQ(identity().value(), now);
  EXPECT_EQ(now.changeSince(now), "");
  const std::string text = now.text();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2);
  const auto parsed = SourceIdentity::parse("journal", text);
  ASSERT_TRUE(parsed) << parsed.error().message;
  EXPECT_EQ(*parsed, now);
}

TEST_F(SourceIdentityTest, TellsSizeTimeAndReplacementApart) {
  const SourceIdentity before = identity().value();
  const std::filesystem::path a = directory_ / "a.ply";
  const auto written = std::filesystem::last_write_time(a);
  write("a.ply", "longer");
  EXPECT_NE(identity().value().changeSince(before).find("6 bytes, before 3"), std::string::npos);
  write("a.ply", "two");
  std::filesystem::last_write_time(a, written + std::chrono::nanoseconds(1));
  EXPECT_NE(identity().value().changeSince(before).find("written at"), std::string::npos);
  write("c.ply", "six");  // beside the old file, so that it has another inode
  std::filesystem::rename(directory_ / "c.ply", a);
  std::filesystem::last_write_time(a, written);
  EXPECT_NE(identity().value().changeSince(before).find("another file"), std::string::npos);
  EXPECT_NE(sourceIdentity(Files({a})).value().changeSince(before), "");
}

TEST_F(SourceIdentityTest, AVanishedFileIsNotFound) {
  std::filesystem::remove(directory_ / "a.ply");
  const auto gone = identity();
  ASSERT_FALSE(gone);
  EXPECT_EQ(gone.error().kind, ErrorKind::notFound);
}

TEST_F(SourceIdentityTest, BrokenTextIsCorrupt) {
  const std::string text = identity().value().text();
  for (size_t length = 1; length < text.size(); ++length) {
    const bool isWhole = text[length - 1] == '\n';
    EXPECT_EQ(SourceIdentity::parse("journal", std::string_view(text).substr(0, length)).has_value(), isWhole)
        << length;
  }
  for (const char* broken : {"x 1 2 /a\n", "1 2 3 \n", "1 2 /a\n", "1 2 3 /a\\\n", "1 2 3 /a\\b\n", "-1 2 3 /a\n"})
    EXPECT_FALSE(SourceIdentity::parse("journal", broken)) << broken;
}

}  // namespace
}  // namespace farcell
