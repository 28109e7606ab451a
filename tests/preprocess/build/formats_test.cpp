// The same model in every format makes the same pack, but for what it says about its source.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "cache/base/file.h"
#include "cache/pack/pack_file.h"
#include "preprocess/build/build.h"
#include "tests/preprocess/read/read_support.h"
#include "tests/support/model_files.h"
#include "tests/support/sanitized.h"

namespace farcell::test {
namespace {

struct Format {
  const char* name;
  std::string (ModelFile::*bytes)() const;
};
constexpr Format kFormats[] = {
    {"little.ply", &ModelFile::plyLittle}, {"big.ply", &ModelFile::plyBig},   {"text.ply", &ModelFile::plyText},
    {"model.obj", &ModelFile::obj},        {"text.stl", &ModelFile::stlText}, {"binary.stl", &ModelFile::stlBinary},
    {"model.off", &ModelFile::off},        {"model.gltf", &ModelFile::gltf},  {"model.glb", &ModelFile::glb},
};

// A closed torus with bumps, on a lattice of 1 / 256: exact in floats and in few digits.
IndexedModel bumpyTorus() {
  constexpr uint32_t kAround = 72, kAcross = 40;
  IndexedModel model;
  for (uint32_t i = 0; i < kAround; ++i)
    for (uint32_t j = 0; j < kAcross; ++j) {
      const double u = 2 * std::numbers::pi * i / kAround, v = 2 * std::numbers::pi * j / kAcross;
      const double r = 1 + 0.2 * std::sin(7 * u) * std::cos(5 * v);
      const glm::dvec3 p((3 + r * std::cos(v)) * std::cos(u), (3 + r * std::cos(v)) * std::sin(u), r * std::sin(v));
      model.positions.emplace_back(glm::round(p * 256.0) / 256.0 + glm::dvec3(100, -2000, 0.5));
    }
  const auto at = [](uint32_t i, uint32_t j) { return i % kAround * kAcross + j % kAcross; };
  for (uint32_t i = 0; i < kAround; ++i)
    for (uint32_t j = 0; j < kAcross; ++j) {
      model.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      model.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return model;
}

// The positions, as floats, and triangles of an OBJ file.
IndexedModel modelOf(const std::filesystem::path& obj) {
  IndexedModel model;
  std::ifstream in(obj);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string keyword, corner;
    words >> keyword;
    glm::vec3 p;
    if (keyword == "v" && words >> p.x >> p.y >> p.z) model.positions.push_back(p);
    if (keyword != "f") continue;
    std::array<uint32_t, 3>& triangle = model.triangles.emplace_back();
    for (uint32_t& index : triangle)
      if (words >> corner) index = static_cast<uint32_t>(std::stoul(corner)) - 1;
  }
  return model;
}

struct Built {
  Directory directory;
  std::string beforeDirectory;  // header and pages, as they lie in the file
};

Built build(const TempDirectory& directory, const Format& format, const IndexedModel& model,
            const BuildOptions& options) {
  const std::filesystem::path mesh = directory.write(format.name, (ModelFile(model).*format.bytes)());
  const std::filesystem::path pack = directory.path() / "model.far";
  Progress silent(false);
  const Result<BuildResult> built = buildPack({&mesh, 1}, pack, options, silent);
  if (!built) {
    ADD_FAILURE() << format.name << ": " << built.error().message;
    return {};
  }
  const Directory read = PackFile::open(pack).value().directory();
  const PageRecord& last = read.pages.back();
  const std::string bytes = readTextFile(pack, uint64_t{1} << 30).value();
  return {read, bytes.substr(0, last.offsetBytes + last.storedBytes)};
}

bool same(const CellRecord& a, const CellRecord& b) {
  return a.key == b.key && a.parent == b.parent && a.firstChild == b.firstChild && a.childCount == b.childCount &&
         a.content == b.content && a.triangles == b.triangles && a.firstGeometryPage == b.firstGeometryPage &&
         a.firstViewPage == b.firstViewPage && a.viewPageCount == b.viewPageCount;
}

bool same(const PageRecord& a, const PageRecord& b) {
  return a.kind == b.kind && a.cell == b.cell && a.group == b.group && a.offsetBytes == b.offsetBytes &&
         a.storedBytes == b.storedBytes && a.decodedBytes == b.decodedBytes && a.checksum == b.checksum;
}

template <class Record>
void expectSame(const std::vector<Record>& a, const std::vector<Record>& b, const char* what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  for (size_t i = 0; i < a.size(); ++i) ASSERT_TRUE(same(a[i], b[i])) << what << " " << i;
}

void expectSamePacks(const IndexedModel& model, const BuildOptions& options) {
  const TempDirectory directory;
  const Built first = build(directory, kFormats[0], model, options);
  ASSERT_FALSE(first.directory.pages.empty());
  for (const Format& format : kFormats) {
    SCOPED_TRACE(format.name);
    Built other = build(directory, format, model, options);
    ASSERT_EQ(other.directory.sourceName, format.name);
    EXPECT_TRUE(other.directory.model == first.directory.model);
    other.directory.report.inputVertices = first.directory.report.inputVertices;
    EXPECT_TRUE(other.directory.report == first.directory.report);
    expectSame(other.directory.cells, first.directory.cells, "cell");
    expectSame(other.directory.pages, first.directory.pages, "page");
    EXPECT_TRUE(other.beforeDirectory == first.beforeDirectory);
  }
}

TEST(Formats, GiveTheSamePackOfABumpyTorus) {
  BuildOptions options;
  options.settings.leafTriangles = 600;
  options.settings.form.views = 12;
  options.settings.form.imageSize = 32;
  options.settings.samples = 1;
  expectSamePacks(bumpyTorus(), options);
}

TEST(Formats, GiveTheSamePackOfAScan) {
  if (kSanitized) GTEST_SKIP() << "too long with sanitizers";
  const std::filesystem::path path = std::filesystem::path(FARCELL_SOURCE_DIR) / "../shared/datasets/nefertiti.obj";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  BuildOptions options;
  options.settings.form.views = 12;
  options.settings.form.imageSize = 32;
  options.settings.samples = 1;
  const IndexedModel model = modelOf(path);
  ASSERT_EQ(model.triangles.size(), 99938u);
  expectSamePacks(model, options);
}

}  // namespace
}  // namespace farcell::test
