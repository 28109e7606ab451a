// Textured models, from OBJ file and image to the pages of a pack.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <glm/vec2.hpp>

#include "cache/base/file.h"
#include "cache/pack/pack_file.h"
#include "cache/schema/view_frame.h"
#include "cache/schema/viewpoints.h"
#include "preprocess/build/build.h"
#include "tests/support/images/encode_image.h"

namespace farcell {
namespace {

using test::encodeImage;

// The square [-1, 1]^2 in the plane z = 0, pieces x pieces x 2 triangles, u and v from 0 to `repeats`.
std::string squareObj(int pieces, double repeats = 1) {
  std::string text = "mtllib square.mtl\nusemtl wall\n";
  for (int j = 0; j <= pieces; ++j)
    for (int i = 0; i <= pieces; ++i)
      text += fmt::format("v {} {} 0\nvt {} {}\n", 2.0 * i / pieces - 1, 2.0 * j / pieces - 1, repeats * i / pieces,
                          repeats * j / pieces);
  for (int j = 0; j < pieces; ++j) {
    for (int i = 0; i < pieces; ++i) {
      const int a = j * (pieces + 1) + i + 1, b = a + 1, c = b + pieces + 1, d = c - 1;
      text += fmt::format("f {0}/{0} {1}/{1} {2}/{2} {3}/{3}\n", a, b, c, d);
    }
  }
  return text;
}

// Black left half; of the right half the upper part is white, the lower one red.
int quarters(int x, int y, int channel, int edge) {
  if (x < edge / 2) return 0;
  return y < edge / 2 || channel == 0 ? 255 : 0;
}

class TexturedBuild : public testing::Test {
 protected:
  void SetUp() override {
    directory_ = std::filesystem::path(testing::TempDir()) / fmt::format("farcell-textured-{}", ::getpid());
    std::filesystem::create_directories(directory_);
    write("square.mtl", "newmtl wall\nmap_Kd -clamp on wall.png\n");
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(directory_ / name, std::ios::binary) << bytes;
    return directory_ / name;
  }
  BuildResult build(const std::string& obj, const std::string& pack, int threads = 2) const {
    const std::filesystem::path mesh = write("square.obj", obj);
    BuildOptions options;
    options.threads = threads;
    options.settings.form.imageSize = 64;
    options.settings.leafTriangles = 600;
    options.settings.up = UpAxis::z;
    Progress silent(false);
    return buildPack({&mesh, 1}, directory_ / pack, options, silent).value();
  }
  PackFile open(const std::string& pack) const { return PackFile::open(directory_ / pack).value(); }

  std::filesystem::path directory_;
};

// Calls visit(image, frame) for every view of a cell that looks at the square from above, not too flatly.
template <class Visit>
void forEachUpperView(const PackFile& pack, uint32_t cell, const Visit& visit) {
  const Viewpoints viewpoints = Viewpoints::create(pack.directory().model.settings.form.views).value();
  const CellRecord& record = pack.directory().cells[cell];
  for (uint32_t i = 0; i < record.viewPageCount; ++i) {
    const ViewPage page = pack.readViews(record.firstViewPage + i).value();
    for (const ViewImage& image : page.views) {
      const ViewFrame frame = viewFrame(viewpoints.directions()[image.view]);
      if (frame.toward.z > 0.4) visit(image, frame);
    }
  }
}

// Where a texel's middle lies on the plane z = 0, in the model's coordinates.
glm::dvec2 placeOf(const Directory& directory, const CellRecord& cell, const ViewFrame& frame, double x, double y) {
  const double t = texelSize(directory.model.settings.form.imageSize);
  const glm::dvec3 inPlane =
      ((x + .5) * t - kViewHalfExtent) * frame.right + ((y + .5) * t - kViewHalfExtent) * frame.up;
  const double half = cellHalfSide(directory.model.grid, cell.key);
  const glm::dvec3 centre = cellCentre(directory.model.grid, cell.key);
  const double along = (0 - centre.z - half * inPlane.z) / frame.toward.z;
  const glm::dvec3 hit = centre + half * inPlane + along * frame.toward;
  return glm::dvec2(hit.x, hit.y);
}

TEST_F(TexturedBuild, ViewsShowTheImageTheRightWayUpWithItsEdgesInPlace) {
  write("wall.png", encodeImage("png", {256, 256, 3, 8}, [](int x, int y, int c) { return quarters(x, y, c, 256); }));
  for (const int pieces : {2, 30}) {
    ASSERT_EQ(build(squareObj(pieces), "square.far").textures.read, 1u);
    const PackFile pack = open("square.far");
    const Directory& directory = pack.directory();
    int looked = 0;
    for (uint32_t cell = 0; cell < directory.cells.size(); ++cell) {
      forEachUpperView(pack, cell, [&](const ViewImage& image, const ViewFrame& frame) {
        const double texel = texelSize(64) * cellHalfSide(directory.model.grid, directory.cells[cell].key);
        for (uint32_t y = 0; y < image.height; ++y) {
          for (uint32_t x = 0; x < image.width; ++x) {
            const uint8_t* rgba = &image.rgba[4 * (y * image.width + x)];
            const glm::dvec2 at = placeOf(directory, directory.cells[cell], frame, x + image.x0, y + image.y0);
            const double margin = 1.2 * texel / frame.toward.z;
            if (rgba[3] < 255 || std::abs(at.x) < margin || std::abs(at.y) < margin) continue;
            ++looked;
            // Lit, so only which channels are there at all is compared.
            EXPECT_EQ(rgba[0] > 60, at.x > 0) << at.x << " " << at.y;
            EXPECT_EQ(rgba[1] > 60, at.x > 0 && at.y > 0) << at.x << " " << at.y;
          }
        }
      });
    }
    EXPECT_GT(looked, 5000);
  }
}

TEST_F(TexturedBuild, ACheckerboardFarFinerThanATexelIsGrey) {
  write("square.mtl", "newmtl wall\nmap_Kd wall.png\n");
  write("wall.png", encodeImage("png", {64, 64, 3, 8}, [](int x, int y, int) { return (x + y) % 2 * 255; }));
  build(squareObj(3, 50), "checker.far");
  write("wall.png", encodeImage("png", {64, 64, 3, 8}, [](int, int, int) { return 128; }));
  build(squareObj(3, 50), "grey.far");
  const PackFile checker = open("checker.far"), grey = open("grey.far");
  std::vector<ViewImage> expected;
  forEachUpperView(grey, 0, [&](const ViewImage& image, const ViewFrame&) { expected.push_back(image); });
  size_t view = 0;
  forEachUpperView(checker, 0, [&](const ViewImage& image, const ViewFrame&) {
    const ViewImage& flat = expected[view++];
    ASSERT_EQ(image.rgba.size(), flat.rgba.size());
    for (size_t i = 0; i < flat.rgba.size(); ++i) ASSERT_NEAR(image.rgba[i], flat.rgba[i], 2);
  });
  EXPECT_GT(view, 5u);
}

TEST_F(TexturedBuild, LeafPagesHoldTheImageInAnAtlasAndOthersAsVertexColours) {
  write("wall.png", encodeImage("png", {256, 256, 3, 8}, [](int x, int y, int c) { return quarters(x, y, c, 256); }));
  build(squareObj(40), "square.far");
  const PackFile pack = open("square.far");
  const Directory& directory = pack.directory();
  EXPECT_TRUE(directory.model.hasColours);
  int leaves = 0;
  for (uint32_t cell = 0; cell < directory.cells.size(); ++cell) {
    const CellRecord& record = directory.cells[cell];
    if (record.geometryPageCount == 0) continue;
    const GeometryPage page = pack.readGeometry(record.firstGeometryPage).value();
    ASSERT_EQ(page.colours.size(), page.positions.size());
    ASSERT_EQ(page.coordinates.empty(), record.childCount > 0);
    const GridPoint cellMin = cellBox(directory.model.grid, record.key).min;
    TexturePage atlas;
    if (record.childCount == 0) atlas = pack.readAtlas(cell, 0).value();
    leaves += record.childCount == 0;
    for (size_t i = 0; i < page.positions.size(); ++i) {
      const glm::dvec3 at = directory.model.grid.worldFromGrid(cellMin + GridPoint(page.positions[i]));
      if (std::abs(at.x) < 0.06 || std::abs(at.y) < 0.06) continue;
      const uint32_t expected = at.x < 0 ? 0u : at.y > 0 ? 0xffffffu : 0x0000ffu;
      if (record.childCount > 0) {
        EXPECT_EQ(page.colours[i], expected) << at.x << " " << at.y;
        continue;
      }
      EXPECT_EQ(page.colours[i], 0xffffffu);
      const auto texel = [](uint32_t coordinate, uint32_t size) {
        return std::min(static_cast<uint32_t>(coordinate / 65535.0 * size), size - 1);
      };
      const uint32_t x = texel(page.coordinates[i] & 0xffff, atlas.width);
      const uint32_t y = texel(page.coordinates[i] >> 16, atlas.height);
      const uint8_t* rgb = &atlas.levels[0][3 * (size_t{y} * atlas.width + x)];
      EXPECT_EQ(rgb[0] | rgb[1] << 8 | rgb[2] << 16, expected) << at.x << " " << at.y;
    }
  }
  EXPECT_GT(leaves, 0);
}

TEST_F(TexturedBuild, OneThreadAndFourGiveTheSameBytes) {
  write("square.mtl", "newmtl wall\nmap_Kd wall.png\n");
  write("wall.png", encodeImage("png", {200, 120, 3, 8}, [](int x, int y, int c) { return (x * y + 50 * c) % 256; }));
  build(squareObj(40, 3.3), "one.far", 1);
  build(squareObj(40, 3.3), "four.far", 4);
  const auto bytesOf = [&](const char* name) { return readTextFile(directory_ / name, uint64_t{1} << 30).value(); };
  EXPECT_TRUE(bytesOf("one.far") == bytesOf("four.far"));
}

TEST_F(TexturedBuild, WithoutItsImageAModelKeepsItsColoursAndTheReportSaysSo) {
  write("square.mtl", "newmtl wall\nKd 1 0.2 0\nmap_Kd wall.png\n");
  const BuildResult missing = build(squareObj(2), "missing.far");
  ASSERT_EQ(missing.textures.leftOut.size(), 1u);
  EXPECT_EQ(missing.textures.leftOut[0].kind, ErrorKind::notFound);
  write("wall.png", "no image at all");
  const BuildResult broken = build(squareObj(2), "broken.far");
  ASSERT_EQ(broken.textures.leftOut.size(), 1u);
  EXPECT_EQ(broken.textures.read, 0u);
  for (const char* name : {"missing.far", "broken.far"}) {
    const PackFile pack = open(name);
    for (const CellRecord& cell : pack.directory().cells) {
      if (cell.geometryPageCount == 0) continue;
      const GeometryPage page = pack.readGeometry(cell.firstGeometryPage).value();
      for (const uint32_t colour : page.colours) EXPECT_EQ(colour, 0x0033ffu);
    }
  }
}

TEST_F(TexturedBuild, SpotIsACowWithADarkAndALightSide) {
  const std::filesystem::path datasets = std::filesystem::path(FARCELL_SOURCE_DIR) / ".." / "shared" / "datasets";
  if (!std::filesystem::exists(datasets / "spot_texture.png")) GTEST_SKIP() << "no " << datasets;
  std::filesystem::copy_file(datasets / "spot_texture.png", directory_ / "wall.png");
  const std::string spot = readTextFile(datasets / "spot.obj", uint64_t{1} << 24).value();
  ASSERT_EQ(build("mtllib square.mtl\nusemtl wall\n" + spot, "spot.far").textures.read, 1u);
  const PackFile pack = open("spot.far");
  size_t dark = 0, light = 0;
  for (uint32_t cell = 0; cell < pack.directory().cells.size(); ++cell) {
    if (pack.atlasPages(cell, 0).empty()) continue;
    const GeometryPage page = pack.readGeometry(pack.directory().cells[cell].firstGeometryPage).value();
    const TexturePage atlas = pack.readAtlas(cell, 0).value();
    for (const uint32_t packed : page.coordinates) {
      const auto x = static_cast<size_t>((packed & 0xffff) / 65536.0 * atlas.width);
      const auto y = static_cast<size_t>((packed >> 16) / 65536.0 * atlas.height);
      const int green = atlas.levels[0][3 * (y * atlas.width + x) + 1];
      dark += green < 90 ? 1 : 0;
      light += green > 220 ? 1 : 0;
    }
  }
  EXPECT_GT(dark, 300u);
  EXPECT_GT(light, dark);
}

}  // namespace
}  // namespace farcell
