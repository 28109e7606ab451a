#include "cache/pack/pack_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>

#include <thread>

#include "tests/cache/pack/samples.h"

namespace farcell {
namespace {

using samples::Bytes;
using samples::FullPack;
using samples::TemporaryFile;

Error openError(const std::filesystem::path& path) {
  const Result<PackFile> pack = PackFile::open(path);
  EXPECT_FALSE(pack.has_value());
  return pack ? Error{ErrorKind::cancelled, ""} : pack.error();
}

TEST(PackFile, GivesBackEverythingThatWasWritten) {
  const TemporaryFile file("full.far");
  const FullPack expected = samples::fullPack();
  samples::write(expected, file.path());
  const Result<PackFile> pack = PackFile::open(file.path());
  ASSERT_TRUE(pack.has_value()) << pack.error().message;
  const Directory& directory = pack->directory();
  EXPECT_EQ(directory.model, expected.directory.model);
  EXPECT_EQ(directory.sourceName, expected.directory.sourceName);
  EXPECT_EQ(directory.sourceHash, expected.directory.sourceHash);
  BuildReport report = expected.directory.report;
  report.geometryBytes = directory.pages.at(2).storedBytes + directory.pages.at(3).storedBytes;
  report.impostorBytes =
      directory.pages[0].storedBytes + directory.pages[1].storedBytes + directory.pages.at(4).storedBytes;
  report.textureBytes = directory.pages.at(5).storedBytes + directory.pages.at(6).storedBytes;
  EXPECT_EQ(directory.report, report);
  ASSERT_EQ(directory.cells.size(), 3u);
  for (size_t i = 0; i < 3; ++i) {
    const CellRecord &found = directory.cells[i], &wanted = expected.directory.cells[i];
    EXPECT_EQ(
        std::tie(found.key, found.parent, found.firstChild, found.childCount, found.content, found.triangles),
        std::tie(wanted.key, wanted.parent, wanted.firstChild, wanted.childCount, wanted.content, wanted.triangles));
    EXPECT_EQ(std::tie(found.meshTriangles, found.geometricError, found.firstGeometryPage, found.geometryPageCount,
                       found.firstViewPage, found.viewPageCount, found.firstTexturePage, found.texturePageCount),
              std::tie(wanted.meshTriangles, wanted.geometricError, wanted.firstGeometryPage, wanted.geometryPageCount,
                       wanted.firstViewPage, wanted.viewPageCount, wanted.firstTexturePage, wanted.texturePageCount));
  }
  EXPECT_EQ(pack->readViews(0), expected.views[0]);
  EXPECT_EQ(pack->readViews(1), expected.views[1]);
  EXPECT_EQ(pack->readGeometry(2), expected.geometry[0]);
  EXPECT_EQ(pack->readGeometry(3), expected.geometry[1]);
  EXPECT_EQ(pack->readViews(4), expected.views[2]);
  EXPECT_EQ(pack->readAtlas(1, 0), expected.atlas);
  EXPECT_EQ(pack->readAtlas(2, 0), expected.atlas);
  EXPECT_TRUE(pack->atlasPages(0, 0).empty());
  std::vector<uint64_t> done;
  EXPECT_TRUE(pack->verify(10, [&](uint64_t pages) { done.push_back(pages); }).empty());
  EXPECT_EQ(done, (std::vector<uint64_t>{1, 2, 3, 4, 5, 6, 7}));
}

TEST(PackFile, HasTheSameBytesWhenWrittenTwice) {
  const TemporaryFile first("first.far"), second("second.far");
  samples::write(samples::fullPack(), first.path());
  samples::write(samples::fullPack(), second.path());
  EXPECT_EQ(samples::readAll(first.path()), samples::readAll(second.path()));
}

TEST(PackFile, IsReadFromManyThreadsAtOnce) {
  const TemporaryFile file("threads.far");
  const FullPack expected = samples::fullPack();
  samples::write(expected, file.path());
  const Result<PackFile> pack = PackFile::open(file.path());
  ASSERT_TRUE(pack.has_value());
  std::vector<std::thread> threads;
  std::atomic<int> wrong = 0;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      for (int i = 0; i < 50; ++i)
        if (pack->readViews(0) != expected.views[0] || pack->readGeometry(2) != expected.geometry[0]) ++wrong;
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

TEST(PackFile, MayHoldOneEmptyCellAndNoPage) {
  const TemporaryFile file("empty.far");
  Directory directory;
  directory.cells.resize(1);
  {
    Result<PackWriter> writer = PackWriter::create(file.path());
    ASSERT_TRUE(writer.has_value());
    const Result<uint64_t> size = writer->finish(directory);
    ASSERT_TRUE(size.has_value());
    EXPECT_EQ(*size, std::filesystem::file_size(file.path()));
  }
  const Result<PackFile> pack = PackFile::open(file.path());
  ASSERT_TRUE(pack.has_value()) << pack.error().message;
  EXPECT_TRUE(pack->directory().pages.empty());
  EXPECT_TRUE(pack->verify(1, nullptr).empty());
}

TEST(PackFile, AppearsOnlyWhenFinished) {
  const TemporaryFile file("unfinished.far");
  {
    Result<PackWriter> writer = PackWriter::create(file.path());
    ASSERT_TRUE(writer.has_value());
    ASSERT_TRUE(writer->add(PageKind::geometry, 0, 0, 0, encodeGeometryPage({})).has_value());
  }
  EXPECT_EQ(openError(file.path()).kind, ErrorKind::notFound);
}

TEST(PackFileDeathTest, WritesNoPackItsReaderWouldRefuse) {
  const TemporaryFile file("refused.far");
  Result<PackWriter> writer = PackWriter::create(file.path());
  ASSERT_TRUE(writer.has_value());
  EXPECT_DEATH((void)writer->finish({}), "the directory is valid.*a root cell");
}

TEST(PackFile, RefusesEveryTruncationAndOneByteMore) {
  const TemporaryFile file("cut.far");
  samples::write(samples::fullPack(), file.path());
  Bytes bytes = samples::readAll(file.path());
  for (size_t length = 0; length<bytes.size(); length += length> bytes.size() - 400 || length < 200 ? 1 : 97) {
    samples::writeAll(file.path(), std::span(bytes).first(length));
    const Error error = openError(file.path());
    EXPECT_EQ(error.kind, ErrorKind::corrupt) << length;
    EXPECT_NE(error.message.find(file.path().string() + ": offset "), std::string::npos) << error.message;
  }
  bytes.push_back(std::byte{0});
  samples::writeAll(file.path(), bytes);
  EXPECT_EQ(openError(file.path()).kind, ErrorKind::corrupt);
}

TEST(PackFile, IsNotOtherFilesDirectoriesOrNothing) {
  const TemporaryFile file("other.far");
  EXPECT_EQ(openError(file.path()).kind, ErrorKind::notFound);
  EXPECT_FALSE(PackFile::open(std::filesystem::temp_directory_path()).has_value());
  samples::writeAll(file.path(), Bytes(100000, std::byte{'v'}));
  EXPECT_NE(openError(file.path()).message.find("offset 0: expected the magic of a pack"), std::string::npos);
}

TEST(PackFile, SaysThatAFutureVersionIsUnsupported) {
  const TemporaryFile file("future.far");
  samples::write(samples::fullPack(), file.path());
  Bytes bytes = samples::readAll(file.path());
  bytes[8] = std::byte{1};
  samples::writeAll(file.path(), bytes);
  const Error error = openError(file.path());
  EXPECT_EQ(error.kind, ErrorKind::unsupported);
  EXPECT_NE(error.message.find("expected a pack of version 0, found version 1"), std::string::npos) << error.message;
}

// A pack of one triangle, one small view and one small atlas, so that every bit of the file can be tried.
void writeSmallPack(const std::filesystem::path& path) {
  Directory directory;
  directory.model.settings.form = {12, 16};
  directory.model.hasColours = directory.model.hasNormals = true;
  directory.model.settings.lighting = Lighting::relightable;
  directory.sourceName = "a";
  directory.cells.resize(1);
  directory.cells[0].form = {12, 16};
  directory.cells[0].content = {GridPoint(0), GridPoint(5, 5, 0)};
  directory.cells[0].triangles = 1;
  directory.cells[0].meshTriangles = 1;
  directory.cells[0].firstGeometryPage = 0;
  directory.cells[0].geometryPageCount = 1;
  directory.cells[0].firstViewPage = 1;
  directory.cells[0].viewPageCount = 1;
  directory.cells[0].firstTexturePage = 2;
  directory.cells[0].texturePageCount = 1;
  std::mt19937 random(1);
  ViewPage views;
  views.views.push_back(samples::randomView(random, 3, 16, true, 0));
  const auto group = static_cast<uint32_t>(Viewpoints::create(12)->group(3));
  const GeometryPage geometry = samples::cornerTriangle(5);
  Result<PackWriter> writer = PackWriter::create(path);
  ASSERT_TRUE(writer.has_value());
  ASSERT_TRUE(
      writer->add(PageKind::geometry, 0, 0, decodedSizeBytes(geometry), encodeGeometryPage(geometry)).has_value());
  ASSERT_TRUE(writer->add(PageKind::views, 0, group, decodedSizeBytes(views), encodeViewPage(views)).has_value());
  const TexturePage atlas = samples::randomAtlas(random, 8, 4, 3, 3);
  ASSERT_TRUE(writer->add(PageKind::texture, 0, 0, decodedSizeBytes(atlas), encodeTexturePage(atlas)).has_value());
  ASSERT_TRUE(writer->finish(directory).has_value());
}

bool damageIsFound(const std::filesystem::path& path) {
  const Result<PackFile> pack = PackFile::open(path);
  return !pack || !pack->verify(1, nullptr).empty();
}

// Sanitizers make this 30 times slower; there, every fifth bit (each position of a bit in turn) must do.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr size_t kBitStep = 5;
#else
constexpr size_t kBitStep = 1;
#endif

TEST(PackFile, LetsNoFlippedBitPass) {
  const TemporaryFile file("flips.far");
  writeSmallPack(file.path());
  const Bytes bytes = samples::readAll(file.path());
  ASSERT_FALSE(damageIsFound(file.path()));
  const int descriptor = ::open(file.path().c_str(), O_RDWR);
  ASSERT_GE(descriptor, 0);
  for (size_t bit = 0; bit < 8 * bytes.size(); bit += kBitStep) {
    const std::byte flipped = bytes[bit / 8] ^ std::byte{static_cast<uint8_t>(1 << bit % 8)};
    ASSERT_EQ(::pwrite(descriptor, &flipped, 1, static_cast<off_t>(bit / 8)), 1);
    EXPECT_TRUE(damageIsFound(file.path())) << "byte " << bit / 8 << " bit " << bit % 8;
    ASSERT_EQ(::pwrite(descriptor, &bytes[bit / 8], 1, static_cast<off_t>(bit / 8)), 1);
  }
  ::close(descriptor);
  EXPECT_FALSE(damageIsFound(file.path()));
}

TEST(PackFile, ReportsEachDamagedPageOnceWithPathOffsetExpectedAndFound) {
  const TemporaryFile file("damaged.far");
  samples::write(samples::fullPack(), file.path());
  const Result<PackFile> pack = PackFile::open(file.path());
  ASSERT_TRUE(pack.has_value());
  Bytes bytes = samples::readAll(file.path());
  for (const size_t page : {1u, 3u}) bytes[pack->directory().pages[page].offsetBytes + 2] ^= std::byte{1};
  samples::writeAll(file.path(), bytes);
  const Result<PackFile> damaged = PackFile::open(file.path());
  ASSERT_TRUE(damaged.has_value());
  const std::vector<Error> findings = damaged->verify(10, nullptr);
  ASSERT_EQ(findings.size(), 2u);
  const std::string place = fmt::format("{}: offset {}: page 1: expected checksum ", file.path().string(),
                                        pack->directory().pages[1].offsetBytes);
  EXPECT_EQ(findings[0].message.find(place), 0u) << findings[0].message;
  EXPECT_NE(findings[0].message.find(", found "), std::string::npos);
  EXPECT_EQ(damaged->verify(1, nullptr).size(), 1u);
  EXPECT_TRUE(damaged->readViews(0).has_value());
  EXPECT_EQ(damaged->readViews(1).error().kind, ErrorKind::corrupt);
}

TEST(PackFile, BelievesNoLitColoursWhereNoneCanBe) {
  const TemporaryFile file("shown.far");
  FullPack pack = samples::fullPack();
  pack.geometry[0].shown = {0x00808080};  // of a leaf, which is drawn under any light
  samples::write(pack, file.path());
  const Result<PackFile> opened = PackFile::open(file.path());
  ASSERT_TRUE(opened.has_value());
  EXPECT_EQ(opened->readGeometry(2).error().kind, ErrorKind::corrupt);
  EXPECT_TRUE(opened->readGeometry(3).has_value());
  EXPECT_EQ(opened->verify(10, nullptr).size(), 1u);
}

TEST(PackFile, BelievesNoSidesWhereTheModelHasNone) {
  for (const bool hasSides : {false, true}) {
    const TemporaryFile file("sides.far");
    FullPack pack = samples::fullPack();
    pack.directory.model.hasSides = hasSides;
    pack.geometry[0].colours[1] |= kSeenFromFront;
    samples::write(pack, file.path());
    const Result<PackFile> opened = PackFile::open(file.path());
    ASSERT_TRUE(opened.has_value()) << opened.error().message;
    EXPECT_EQ(opened->readGeometry(2).has_value(), hasSides);
    EXPECT_EQ(opened->directory().model.hasSides, hasSides);
  }
}

TEST(PackFile, FailsWithAnErrorWhenTheFileShrinksUnderIt) {
  const TemporaryFile file("shrinks.far");
  samples::write(samples::fullPack(), file.path());
  const Result<PackFile> pack = PackFile::open(file.path());
  ASSERT_TRUE(pack.has_value());
  std::filesystem::resize_file(file.path(), pack->directory().pages[4].offsetBytes + 1);
  EXPECT_FALSE(pack->readViews(4).has_value());
  EXPECT_FALSE(pack->verify(10, nullptr).empty());
}

}  // namespace
}  // namespace farcell
