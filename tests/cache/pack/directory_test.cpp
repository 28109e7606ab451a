// A directory whose checksums are right but whose fields lie: only the reader's own checks can refuse it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "tests/cache/pack/samples.h"

namespace farcell {
namespace {

using samples::Bytes;
using samples::TemporaryFile;

class LyingDirectory : public ::testing::Test {
 protected:
  void SetUp() override {
    samples::write(samples::fullPack(), file_.path());
    bytes_ = samples::readAll(file_.path());
    const Result<PackFile> pack = PackFile::open(file_.path());
    ASSERT_TRUE(pack.has_value());
    directory_ = pack->directory();
    const PageRecord& last = directory_.pages.back();
    directoryOffset_ = last.offsetBytes + last.storedBytes;
  }

  Result<PackFile> reopen(const Directory& directory) { return reopen(directory, encodeDirectory(directory)); }
  Result<PackFile> reopen(const Directory& directory, const Bytes& encoded) {
    samples::writeAll(file_.path(), samples::withDirectory(bytes_, directory, directoryOffset_, encoded));
    return PackFile::open(file_.path());
  }

  // Opens the pack after `change`; it must be refused for that reason.
  void expectRefused(const char* what, const std::function<void(Directory&)>& change, const std::string& reason = "") {
    SCOPED_TRACE(what);
    Directory directory = directory_;
    change(directory);
    const Result<PackFile> pack = reopen(directory);
    ASSERT_FALSE(pack.has_value());
    EXPECT_EQ(pack.error().kind, ErrorKind::corrupt);
    for (const std::string& part :
         {file_.path().string() + ": offset ", std::string("expected "), std::string("found "), reason})
      EXPECT_NE(pack.error().message.find(part), std::string::npos) << pack.error().message;
  }

  TemporaryFile file_{"lying.far"};
  Bytes bytes_;
  Directory directory_;
  uint64_t directoryOffset_ = 0;
};

TEST_F(LyingDirectory, ErrorsOfAWayAreAllKnownOrNone) {
  const auto known = [](ErrorTable & errors, ErrorWay way) -> auto& { return errors.codes[static_cast<size_t>(way)]; };
  Directory whole = directory_;
  for (CellRecord& cell : whole.cells) {
    if (cell.meshTriangles > 0) known(cell.errors, ErrorWay::mesh) = {1, 255, 161, 7};
    if (cell.viewPageCount > 0) known(cell.errors, ErrorWay::blended) = {9, 8, 7, 6};
  }
  const Result<PackFile> pack = reopen(whole);
  ASSERT_TRUE(pack.has_value()) << pack.error().message;
  for (size_t i = 0; i < whole.cells.size(); ++i) EXPECT_EQ(pack->directory().cells[i].errors, whole.cells[i].errors);

  const auto viewless =
      std::find_if(whole.cells.begin(), whole.cells.end(), [](auto& c) { return c.viewPageCount == 0; });
  expectRefused(
      "known at three scales",
      [&](Directory& d) {
        known(d.cells[1].errors, ErrorWay::mesh) = {1, 2, 0, 4};
      },
      "errors of way 0");
  if (viewless != whole.cells.end()) {
    const auto index = static_cast<size_t>(viewless - whole.cells.begin());
    expectRefused(
        "of views that are not there",
        [&](Directory& d) {
          known(d.cells[index].errors, ErrorWay::depthCorrected) = {1, 2, 3, 4};
        },
        "no errors of way 1");
  }
  expectRefused(
      "without measuring",
      [&](Directory& d) {
        d.model.settings.measure = Measure::off;
        known(d.cells[1].errors, ErrorWay::mesh) = {1, 2, 3, 4};
      },
      "no errors of way 0");
}

TEST_F(LyingDirectory, IsAcceptedWhenItTellsTheTruth) {
  const Result<PackFile> pack = reopen(directory_);
  ASSERT_TRUE(pack.has_value()) << pack.error().message;
  EXPECT_TRUE(pack->verify(10, nullptr).empty());
  EXPECT_EQ(samples::readAll(file_.path()), bytes_);
}

TEST_F(LyingDirectory, IsRefusedForItsGrid) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double side : {0.0, -1.0, kNan, kInfinity, std::numeric_limits<double>::denorm_min()})
    expectRefused(
        "side", [&](Directory& d) { d.model.grid.side = side; }, "a side above 0");
  for (const double origin : {kNan, kInfinity, -kInfinity})
    expectRefused(
        "origin", [&](Directory& d) { d.model.grid.origin.y = origin; }, "a finite grid");
  expectRefused(
      "sum", [](Directory& d) { d.model.grid.side = d.model.grid.origin.x = 1.7e308; }, "a finite grid");
  for (const int bits : {0, -1, 15, 25, 64, INT32_MAX})
    expectRefused(
        "bits", [&](Directory& d) { d.model.grid.bits = bits; }, "a grid of 16 to 24 bits");
  expectRefused(
      "bounds", [](Directory& d) { d.model.bounds.max.z = (1 << 20) + 1; }, "inside the root cube");
  expectRefused(
      "bounds", [](Directory& d) { d.model.bounds.min.x = -1; }, "inside the root cube");
}

TEST_F(LyingDirectory, IsRefusedForTheFormOfACell) {
  expectRefused(
      "other than the settings'",
      [](Directory& d) {
        d.cells[1].form = {12, 16};
      },
      "42 views of 16 texels");
  expectRefused(
      "forms", [](Directory& d) { d.model.settings.forms = static_cast<Forms>(3); }, "forms of 0 to 2");
  const auto refuse = [&](ViewForm form) {
    expectRefused(
        "form",
        [&](Directory& d) {
          d.model.settings.forms = Forms::chosen;
          d.cells[0].form = form;
        },
        "a set of viewpoints");
  };
  for (const int views : {0, 13, 41, 65535}) refuse({views, 64});
  for (const int size : {0, 8, 24, 2048, 65535}) refuse({42, size});
  // Of fewer views there are fewer groups than pages were made for.
  expectRefused(
      "groups",
      [](Directory& d) {
        d.model.settings.forms = Forms::chosen;
        d.pages[1].group = 12;
      },
      "a rising group below 12");
}

TEST_F(LyingDirectory, IsRefusedForItsSettings) {
  for (const int views : {0, -42, 13, 41, 2562, INT32_MAX})
    expectRefused(
        "views", [&](Directory& d) { d.model.settings.form.views = views; }, "a set of viewpoints");
  for (const int size : {0, -16, 8, 24, 127, 2048, INT32_MIN})
    expectRefused(
        "image size", [&](Directory& d) { d.model.settings.form.imageSize = size; }, "a power of two");
  for (const int samples : {0, -4, 2, 9, 256})
    expectRefused(
        "samples", [&](Directory& d) { d.model.settings.samples = samples; }, "samples");
  expectRefused(
      "leaf", [](Directory& d) { d.model.settings.leafTriangles = 0; }, "triangle a leaf");
  for (const int level : {-1, 16})
    expectRefused(
        "max level", [&](Directory& d) { d.model.settings.maxLevel = level; }, "levels");
  for (const int level : {-2, 16})
    expectRefused(
        "fixed level", [&](Directory& d) { d.model.settings.fixedLevel = level; }, "levels");
  for (const int error : {-1, 9})
    expectRefused(
        "view error", [&](Directory& d) { d.model.settings.viewError = error; }, "an error of views");
  expectRefused(
      "up", [](Directory& d) { d.model.settings.up = static_cast<UpAxis>(3); }, "up axis");
  for (const double unit :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    expectRefused(
        "unit", [&](Directory& d) { d.model.settings.metresPerUnit = unit; }, "a unit");
  expectRefused(
      "lighting", [](Directory& d) { d.model.settings.lighting = static_cast<Lighting>(2); }, "a lighting of 0 or 1");
  for (const Sun& sun : {Sun{7, 0}, Sun{0, -1.6}, Sun{NAN, 0}, Sun{0, INFINITY}})
    expectRefused(
        "sun", [&](Directory& d) { d.model.settings.sun = sun; }, "a sun");
  expectRefused(
      "simplifier", [](Directory& d) { d.model.settings.simplifier = static_cast<Simplifier>(2); }, "simplifier");
  expectRefused(
      "budget rule", [](Directory& d) { d.model.settings.budgetRule = static_cast<BudgetRule>(2); }, "budget rule");
}

TEST_F(LyingDirectory, IsRefusedForItsTree) {
  expectRefused(
      "no cells", [](Directory& d) { d.cells.clear(); }, "a root cell");
  expectRefused(
      "root key",
      [](Directory& d) {
        d.cells[0].key = {1, 0, 0, 0};
      },
      "cell 0");
  expectRefused(
      "root's parent", [](Directory& d) { d.cells[0].parent = 0; }, "no parent");
  expectRefused(
      "nine children", [](Directory& d) { d.cells[0].childCount = 9; }, "cell 0");
  expectRefused(
      "too many children", [](Directory& d) { d.cells[0].childCount = 3; }, "cell 0");
  expectRefused(
      "an orphan", [](Directory& d) { d.cells[0].childCount = 1; }, "another's child");
  expectRefused(
      "itself as child", [](Directory& d) { d.cells[0].firstChild = 0; }, "cell 0");
  expectRefused(
      "child far away", [](Directory& d) { d.cells[0].firstChild = kNone - 1; }, "cell 0");
  expectRefused(
      "a leaf with a first child", [](Directory& d) { d.cells[1].firstChild = 0; }, "cell 1");
  expectRefused(
      "another parent", [](Directory& d) { d.cells[2].parent = 1; }, "parent 0");
  expectRefused(
      "no parent", [](Directory& d) { d.cells[2].parent = kNone; }, "parent 0");
  expectRefused(
      "level skipped", [](Directory& d) { d.cells[1].key.level = 2; }, "a child of");
  expectRefused(
      "level zero", [](Directory& d) { d.cells[1].key.level = 0; }, "a child of");
  expectRefused(
      "level huge", [](Directory& d) { d.cells[1].key.level = 40; }, "a child of");
  expectRefused(
      "key outside", [](Directory& d) { d.cells[2].key.x = 2; }, "a child of");
  expectRefused(
      "twins", [](Directory& d) { d.cells[2].key = d.cells[1].key; }, "a cell after");
  expectRefused(
      "order", [](Directory& d) { std::swap(d.cells[1].key, d.cells[2].key); }, "a cell after");
}

TEST_F(LyingDirectory, IsRefusedForItsContent) {
  expectRefused(
      "outside its cube", [](Directory& d) { d.cells[2].content.min.x -= 1; }, "inside its cube");
  expectRefused(
      "outside its parent's", [](Directory& d) { d.cells[2].content.max.y = 1001; }, "its parent's");
  expectRefused(
      "outside the root", [](Directory& d) { d.cells[0].content.min.z = -1; }, "inside its cube");
  expectRefused(
      "empty with triangles", [](Directory& d) { d.cells[1].content = {}; }, "a box around 1 triangles");
}

TEST_F(LyingDirectory, IsRefusedForWhatItsCellsSayOfPages) {
  expectRefused(
      "geometry out of range", [](Directory& d) { d.cells[1].firstGeometryPage = 7; }, "its own geometry");
  expectRefused(
      "geometry of another", [](Directory& d) { d.cells[1].firstGeometryPage = 3; }, "its own geometry");
  expectRefused(
      "geometry that is views", [](Directory& d) { d.cells[1].firstGeometryPage = 0; }, "its own geometry");
  expectRefused(
      "none", [](Directory& d) { d.cells[1].firstGeometryPage = kNone; }, "1 pages for 1 triangles");
  expectRefused(
      "too few", [](Directory& d) { d.cells[1].geometryPageCount = 0; }, "1 pages for 1 triangles");
  expectRefused(
      "not all of a leaf's triangles", [](Directory& d) { d.cells[1].meshTriangles = 0; }, "all 1 triangles");
  expectRefused(
      "more than has parts",
      [](Directory& d) {
        d.cells[0].meshTriangles = UINT64_MAX;
        d.cells[0].firstGeometryPage = 2;
      },
      "at most");
  expectRefused(
      "an error that is no number", [](Directory& d) { d.cells[0].geometricError = std::nan(""); }, "geometric error");
  expectRefused(
      "an error below 0", [](Directory& d) { d.cells[0].geometricError = -1; }, "geometric error");
  expectRefused(
      "an error of a leaf", [](Directory& d) { d.cells[1].geometricError = 1; }, "no geometric error");
  expectRefused(
      "a part's number", [](Directory& d) { d.pages[2].group = 1; }, "by part");
  expectRefused(
      "of two cells",
      [](Directory& d) {
        d.cells[0].meshTriangles = 1;
        d.cells[0].firstGeometryPage = 2;
        d.cells[0].geometryPageCount = 1;
      },
      "its own geometry");
  expectRefused(
      "views out of range", [](Directory& d) { d.cells[2].viewPageCount = 4; }, "pages of views below 7");
  expectRefused(
      "views that wrap", [](Directory& d) { d.cells[2].viewPageCount = kNone - 1; }, "pages of views below 7");
  expectRefused(
      "first without count", [](Directory& d) { d.cells[2].viewPageCount = 0; }, "pages of views below 7");
  expectRefused(
      "count without first", [](Directory& d) { d.cells[2].firstViewPage = kNone; }, "pages of views below 7");
  expectRefused(
      "views of another", [](Directory& d) { d.cells[2].firstViewPage = 1; }, "its own views");
  expectRefused(
      "geometry among views", [](Directory& d) { d.cells[0].viewPageCount = 3; }, "its own views");
  expectRefused(
      "a page no cell names", [](Directory& d) { d.cells[0].viewPageCount = 1; }, "page 1");
}

TEST_F(LyingDirectory, IsRefusedForItsTextures) {
  expectRefused(
      "out of range", [](Directory& d) { d.cells[1].texturePageCount = 3; }, "pages of textures below 7");
  expectRefused(
      "first without count", [](Directory& d) { d.cells[2].texturePageCount = 0; }, "pages of textures below 7");
  expectRefused(
      "an inner cell's",
      [](Directory& d) {
        d.cells[0].firstTexturePage = 5;
        d.cells[0].texturePageCount = 2;
      },
      "of leaves only");
  expectRefused(
      "not all of another's", [](Directory& d) { d.cells[2].texturePageCount = 1; }, "of a cell before it");
  expectRefused(
      "of a cell after it", [](Directory& d) { d.pages[5].cell = d.pages[6].cell = 2; }, "of a cell before it");
  expectRefused(
      "views", [](Directory& d) { d.cells[1].firstTexturePage = d.cells[2].firstTexturePage = 4; }, "textures");
  expectRefused(
      "groups that do not begin", [](Directory& d) { d.pages[5].group = 1; }, "from group 0 on");
  expectRefused(
      "groups with a gap", [](Directory& d) { d.pages[6].group = 2; }, "from group 0 on");
  expectRefused(
      "of a part that is not there", [](Directory& d) { d.pages[6].group = 8; }, "of its parts");
  expectRefused(
      "a page no cell names",
      [](Directory& d) {
        for (const size_t leaf : {1, 2}) d.cells[leaf].texturePageCount = 1;
      },
      "page 6");
  expectRefused(
      "report", [](Directory& d) { ++d.report.textureBytes; }, "of textures");
}

TEST_F(LyingDirectory, IsRefusedForItsPages) {
  expectRefused("kind", [](Directory& d) { d.pages[0].kind = static_cast<PageKind>(4); });
  expectRefused("cell", [](Directory& d) { d.pages[0].cell = 3; });
  expectRefused(
      "group", [](Directory& d) { d.pages[4].group = 12; }, "a rising group below 12");
  expectRefused(
      "group order", [](Directory& d) { std::swap(d.pages[0].group, d.pages[1].group); }, "a rising group");
  expectRefused(
      "group of geometry", [](Directory& d) { d.pages[2].group = 1; }, "by part");
  expectRefused(
      "overlap", [](Directory& d) { d.pages[1].offsetBytes -= 8; }, "at offset");
  expectRefused(
      "gap", [](Directory& d) { d.pages[1].offsetBytes += 8; }, "at offset");
  expectRefused(
      "in the header", [](Directory& d) { d.pages[0].offsetBytes = 0; }, "at offset");
  expectRefused(
      "no bytes", [](Directory& d) { d.pages[0].storedBytes = 0; }, "at offset");
  expectRefused(
      "past the directory", [](Directory& d) { d.pages[6].storedBytes += 1; }, "at offset");
  expectRefused(
      "huge", [](Directory& d) { d.pages[6].storedBytes = ~0u; }, "at offset");
  expectRefused(
      "decodes to too much", [](Directory& d) { d.pages[1].decodedBytes = ~0u; }, "decoded bytes");
  expectRefused(
      "a page missing",
      [](Directory& d) {
        d.pages.pop_back();
        for (const size_t leaf : {1, 2}) d.cells[leaf].texturePageCount = 1;
      },
      "pages up to the directory");
  expectRefused(
      "report of views", [](Directory& d) { ++d.report.impostorBytes; }, "bytes of views");
  expectRefused(
      "report of geometry", [](Directory& d) { --d.report.geometryBytes; }, "of geometry");
}

TEST_F(LyingDirectory, IsRefusedForHashesThatDiffer) {
  Directory other = directory_;
  other.model.settings.leafTriangles += 1;
  const Result<PackFile> pack = reopen(other, encodeDirectory(directory_));
  ASSERT_FALSE(pack.has_value());
  EXPECT_NE(pack.error().message.find("settings of hash"), std::string::npos) << pack.error().message;
}

// What cell and page records claim of the pages themselves shows when the pages are read.
TEST_F(LyingDirectory, IsFoundOutWhenAPageIsRead) {
  const auto finding = [&](const std::function<void(Directory&)>& change) -> std::string {
    Directory directory = directory_;
    change(directory);
    const Result<PackFile> pack = reopen(directory);
    if (!pack) return "not even opened: " + pack.error().message;
    const std::vector<Error> findings = pack->verify(10, nullptr);
    return findings.size() == 1 ? findings[0].message : fmt::format("{} findings", findings.size());
  };
  const auto has = [](const std::string& message, const char* part) {
    return message.find(part) != std::string::npos ? ::testing::AssertionSuccess()
                                                   : ::testing::AssertionFailure() << message;
  };
  EXPECT_TRUE(has(finding([](Directory& d) { d.cells[1].triangles = d.cells[1].meshTriangles = 2; }),
                  "page 2: expected 2 triangles, found 1"));
  EXPECT_TRUE(has(finding([](Directory& d) { d.cells[1].content.max.x = 999; }), "page 2: expected positions inside"));
  EXPECT_TRUE(has(finding([](Directory& d) { d.pages[3].decodedBytes += 4; }), "page 3: expected 88 decoded bytes"));
  EXPECT_TRUE(has(finding([](Directory& d) { d.pages[3].decodedBytes -= 4; }), "page 3: byte 0 of the page"));
  EXPECT_TRUE(has(finding([](Directory& d) { d.pages[0].checksum ^= 1; }), "page 0: expected checksum"));
  EXPECT_TRUE(has(finding([](Directory& d) { d.pages[4].group += 2; }), "page 4: expected views of group"));
}

TEST_F(LyingDirectory, IsRefusedAtEveryTruncationAndWithOneByteMore) {
  Bytes encoded = encodeDirectory(directory_);
  for (size_t length = 0; length < encoded.size(); ++length) {
    DirectoryPlaces places;
    const Bytes part(encoded.begin(), encoded.begin() + static_cast<ptrdiff_t>(length));
    EXPECT_FALSE(decodeDirectory(part, 0, "pack", places).has_value()) << length;
  }
  encoded.push_back(std::byte{0});
  DirectoryPlaces places;
  EXPECT_FALSE(decodeDirectory(encoded, 0, "pack", places).has_value());
}

TEST_F(LyingDirectory, NeverBreaksTheReaderWhateverItsBytes) {
  const Bytes encoded = encodeDirectory(directory_);
  std::mt19937 random(1);
  for (int round = 0; round < 3000; ++round) {
    Bytes damaged = encoded;
    for (uint32_t i = 0; i <= samples::below(random, 3); ++i)
      damaged[samples::below(random, static_cast<uint32_t>(damaged.size()))] =
          static_cast<std::byte>(random() % 4 ? random() % 5 : random());
    DirectoryPlaces places;
    const Result<Directory> decoded = decodeDirectory(damaged, 0, "pack", places);
    if (!decoded) continue;
    const Result<PackFile> pack = reopen(*decoded, damaged);
    if (pack) (void)pack->verify(10, nullptr);
  }
}

TEST_F(LyingDirectory, BelievesNoCountOfRecordsBeyondItsBytes) {
  Directory small = directory_;
  small.cells.clear();
  small.pages.clear();
  const Bytes encoded = encodeDirectory(small);
  for (const size_t fromEnd : {8u, 4u}) {
    Bytes changed = encoded;
    for (size_t i = 0; i < 4; ++i) changed[changed.size() - fromEnd + i] = std::byte{0xfe};
    DirectoryPlaces places;
    EXPECT_FALSE(decodeDirectory(changed, 0, "pack", places).has_value());
  }
}

TEST(Footer, WithARightChecksumIsStillCheckedAgainstTheFile) {
  const Footer good{8192, 1000, 1, 2, 3, 8192 + 1000 + kFooterBytes};
  const auto decode = [](const Footer& footer, uint64_t fileBytes) {
    return decodeFooter(encodeFooter(footer), fileBytes, "pack");
  };
  EXPECT_TRUE(decode(good, good.fileBytes).has_value());
  EXPECT_FALSE(decode(good, good.fileBytes + 1).has_value());
  for (const uint64_t offset : {uint64_t{0}, uint64_t{8191}, uint64_t{12288}, uint64_t{1} << 63, ~uint64_t{0}}) {
    Footer footer = good;
    footer.directoryOffset = offset;
    EXPECT_FALSE(decode(footer, footer.fileBytes).has_value()) << offset;
  }
  for (const uint64_t size : {uint64_t{0}, uint64_t{999}, uint64_t{1001}, ~uint64_t{0}}) {
    Footer footer = good;
    footer.directoryBytes = size;
    EXPECT_FALSE(decode(footer, footer.fileBytes).has_value()) << size;
  }
}

}  // namespace
}  // namespace farcell
