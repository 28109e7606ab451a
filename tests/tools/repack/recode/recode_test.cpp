#include "tools/repack/recode/recode.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "cache/base/file.h"
#include "tests/cache/pack/samples.h"
#include "tests/support/synthetic_pack.h"

namespace farcell {
namespace {

class RecodeTest : public testing::Test {
 protected:
  void SetUp() override {
    directory_ = std::filesystem::temp_directory_path() / fmt::format("farcell_repack_{}", static_cast<int>(getpid()));
    std::filesystem::create_directory(directory_);
    const auto written =
        writeSyntheticPack(at("a.far"), sphereTriangles({1e6, 2, 3}, 2, 2, 0x0020c040),
                           {.level = 1, .views = 12, .imageSize = 32, .lighting = Lighting::relightable});
    ASSERT_TRUE(written) << written.error().message;
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  std::filesystem::path at(const std::string& name) const { return directory_ / name; }
  std::string textOf(const std::string& name) const { return readTextFile(at(name), 1 << 24).value(); }
  Result<RecodeResult> recode(const std::string& from, const std::string& to, int threads) const {
    const Result<PackFile> pack = PackFile::open(at(from));
    if (!pack) return tl::unexpected<Error>(pack.error());
    Progress silent(false);
    return recodePack(*pack, at(to), threads, silent);
  }
  int run(const std::string& arguments) const {
    const std::string command = fmt::format("cd '{}' && '{}/farcell-repack' {} >out.txt 2>err.txt", directory_.string(),
                                            FARCELL_PROGRAMS_DIR, arguments);
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::filesystem::path directory_;
};

// Cell by cell and page by page.
void expectSameContent(const PackFile& a, const PackFile& b) {
  EXPECT_EQ(a.directory().model, b.directory().model);
  EXPECT_EQ(a.directory().sourceHash, b.directory().sourceHash);
  ASSERT_EQ(a.directory().cells.size(), b.directory().cells.size());
  ASSERT_EQ(a.directory().pages.size(), b.directory().pages.size());
  for (uint32_t page = 0; page < a.directory().pages.size(); ++page) {
    const PageRecord &before = a.directory().pages[page], &after = b.directory().pages[page];
    ASSERT_EQ(before.kind, after.kind);
    EXPECT_EQ(before.cell, after.cell);
    EXPECT_EQ(before.decodedBytes, after.decodedBytes);
    EXPECT_LE(after.storedBytes, before.storedBytes);
    if (before.kind == PageKind::geometry) {
      EXPECT_EQ(a.readGeometry(page).value(), b.readGeometry(page).value());
    } else if (before.kind == PageKind::texture) {
      EXPECT_EQ(a.readTexture(page).value(), b.readTexture(page).value());
    } else {
      EXPECT_EQ(a.readViews(page).value(), b.readViews(page).value());
    }
  }
}

TEST_F(RecodeTest, APackIsSmallerAndHoldsWhatItHeld) {
  const auto result = recode("a.far", "b.far", 1);
  ASSERT_TRUE(result) << result.error().message;
  const PackFile before = PackFile::open(at("a.far")).value(), after = PackFile::open(at("b.far")).value();
  expectSameContent(before, after);
  EXPECT_TRUE(after.verify(1, {}).empty());
  EXPECT_EQ(result->before.pack, before.sizeBytes());
  EXPECT_EQ(result->after.pack, after.sizeBytes());
  EXPECT_EQ(result->after.impostors, after.directory().report.impostorBytes);
  EXPECT_EQ(result->after.geometry, after.directory().report.geometryBytes);
  EXPECT_EQ(result->before.impostors, before.directory().report.impostorBytes);
  EXPECT_EQ(result->pages, before.directory().pages.size());
  EXPECT_LT(after.directory().report.impostorBytes, before.directory().report.impostorBytes);
  EXPECT_EQ(after.directory().report.viewsKept, before.directory().report.viewsKept);
}

TEST_F(RecodeTest, FourThreadsGiveTheBytesOfOneAndASecondTimeGainsNothing) {
  ASSERT_TRUE(recode("a.far", "one.far", 1));
  ASSERT_TRUE(recode("a.far", "four.far", 4));
  EXPECT_TRUE(textOf("one.far") == textOf("four.far"));
  ASSERT_TRUE(recode("four.far", "four.far", 2)) << "a pack may take its own place";
  EXPECT_TRUE(textOf("one.far") == textOf("four.far"));
}

TEST_F(RecodeTest, CountsOfAReportStayTrue) {
  samples::write(samples::fullPack(), at("full.far"));
  ASSERT_TRUE(recode("full.far", "small.far", 2));
  const PackFile before = PackFile::open(at("full.far")).value(), after = PackFile::open(at("small.far")).value();
  expectSameContent(before, after);
  EXPECT_EQ(after.directory().report.viewsKept, before.directory().report.viewsKept);
  EXPECT_EQ(after.directory().report.viewsLeftOut, before.directory().report.viewsLeftOut);
  EXPECT_EQ(after.directory().report.skipped, before.directory().report.skipped);
}

TEST_F(RecodeTest, ADamagedPageIsAnErrorAndWritesNothing) {
  samples::Bytes bytes = samples::readAll(at("a.far"));
  const PageRecord page = PackFile::open(at("a.far")).value().directory().pages.back();
  bytes[page.offsetBytes + page.storedBytes / 2] ^= std::byte{16};
  samples::writeAll(at("bad.far"), bytes);
  EXPECT_EQ(recode("bad.far", "never.far", 2).error().kind, ErrorKind::corrupt);
  EXPECT_FALSE(std::filesystem::exists(at("never.far")));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory_), {}), 2) << "no temporary file is left";
}

TEST_F(RecodeTest, TheProgramTellsTheBytesAndItsExitCodeWhatWasWrong) {
  ASSERT_EQ(run("a.far -o b.far --json --quiet"), 0);
  const nlohmann::json json = nlohmann::json::parse(textOf("out.txt"));
  EXPECT_EQ(json["bytesBefore"]["pack"], std::filesystem::file_size(at("a.far")));
  EXPECT_EQ(json["bytes"]["pack"], std::filesystem::file_size(at("b.far")));
  EXPECT_LT(json["bytes"]["impostors"], json["bytesBefore"]["impostors"]);
  EXPECT_EQ(run("a.far -o c.far --quiet"), 0);
  EXPECT_NE(textOf("out.txt").find("impostors"), std::string::npos);
  EXPECT_EQ(run("nothing.far -o d.far"), 1);
  EXPECT_NE(textOf("err.txt").find("nothing.far"), std::string::npos);
  EXPECT_EQ(run("a.far"), 2);
  EXPECT_EQ(run("a.far -o d.far --threads -1"), 2);
  EXPECT_FALSE(std::filesystem::exists(at("d.far")));
}

}  // namespace
}  // namespace farcell
