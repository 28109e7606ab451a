// The CPU's impostors beside the renderer's: one look-up, two compilers.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "cache/schema/view_frame.h"
#include "preprocess/measure/impostor_picture.h"
#include "tests/runtime/renderer_fixture.h"

namespace farcell {
namespace {

constexpr double kFar = 1000;  // half sides: rays differ from parallel ones by less than a tenth of a texel

const Viewpoints& viewpoints() {
  static const Viewpoints set = *Viewpoints::create(42);
  return set;
}

// Curved and flat surfaces, an edge between them, and one that hides another.
std::vector<SyntheticTriangle> scene() {
  auto triangles = sphereTriangles({0.2, 0, 0.5}, 0.8, 4, 0x0040c0ff);
  for (const auto& triangle : boxTriangles({-1.6, -1.6, -1.3}, {1.6, 1.6, -0.5}, 0x0030a040))
    triangles.push_back(triangle);
  for (const auto& triangle : boxTriangles({-1.4, 0.9, -0.5}, {-1.2, 1.3, 1.2}, 0x00e04020))
    triangles.push_back(triangle);
  return triangles;
}

FrameImage drawnFromAfar(DrawnPack& drawn, glm::dvec3 toward, int edge, ImpostorKind kind) {
  const Grid& grid = drawn.pack->directory().model.grid;
  const glm::dvec3 centre = cellCentre(grid, {});
  const double half = cellHalfSide(grid, {});
  Camera camera{"far", centre + toward * (kFar * half), centre, viewFrame(toward).up,
                2 * std::atan(kViewHalfExtent / kFar)};
  FrameImage image;
  RenderSettings settings = sized(edge, edge, RenderMode::impostors, 4, kind);
  settings.handOver = false;  // the same views for all samples
  drawn.draw(camera, settings, image);
  return image;
}

class CpuViews {
 public:
  CpuViews(const PackFile& pack, glm::vec3 light) : light_(light) {
    const Directory& directory = pack.directory();
    const CellRecord& cell = directory.cells[0];
    for (uint32_t page = cell.firstViewPage; page < cell.firstViewPage + cell.viewPageCount; ++page) {
      const ViewPage content = pack.readViews(page).value();
      for (const ViewImage& view : content.views)
        texels_.emplace(view.view, ViewTexels(view, viewpoints().directions()[view.view], cell.form.imageSize));
    }
    const GridBox cube = cellBox(directory.model.grid, cell.key);
    const glm::vec3 centre = glm::vec3(cube.min + cube.max) * 0.5f;
    const float half = static_cast<float>(cube.max.x - cube.min.x) * 0.5f;
    content_ = {(glm::vec3(cell.content.min) - centre) / half, (glm::vec3(cell.content.max) - centre) / half};
  }

  Picture from(glm::dvec3 toward, int edge, ImpostorKind kind) const {
    if (kind == ImpostorKind::depthCorrected) {
      const auto [first, second] = viewpoints().nearestTwo(toward);
      const std::array<WeightedView, 2> two = {WeightedView{&at(first), 0}, WeightedView{&at(second), 0}};
      return impostorPicture(content_, two, toward, light_, edge);
    }
    const auto triple = viewpoints().nearestThree(toward);
    std::array<WeightedView, 3> three;
    for (size_t i = 0; i < 3; ++i) three[i] = {&at(triple.views[i]), triple.weights[i]};
    return impostorPicture(content_, three, toward, light_, edge);
  }

 private:
  const ViewTexels& at(int view) const { return texels_.at(static_cast<uint32_t>(view)); }
  const glm::vec3 light_;
  std::map<uint32_t, ViewTexels> texels_;
  LocalBox content_;
};

struct Apart {
  double mean = 0;   // of all channels, 255ths
  double shown = 0;  // mean of the renderer's own
};

Apart apart(const FrameImage& gl, const Picture& cpu) {
  Apart result;
  for (int y = 0; y < cpu.edge; ++y)
    for (int x = 0; x < cpu.edge; ++x)
      for (int channel = 0; channel < 4; ++channel) {
        const double shown = gl.rgba[static_cast<size_t>(((cpu.edge - 1 - y) * cpu.edge + x) * 4 + channel)];
        const double own = 255 * cpu.rgba[static_cast<size_t>(y * cpu.edge + x)][channel];
        result.mean += std::abs(shown - own);
        result.shown += shown;
      }
  result.mean /= 4.0 * cpu.edge * cpu.edge;
  result.shown /= 4.0 * cpu.edge * cpu.edge;
  return result;
}

class Look : public testing::TestWithParam<Lighting> {};

TEST_P(Look, showsTheSameOnTheCpuAsInTheRenderer) {
  DrawnPack drawn = openDrawn(scene(), {.level = 0, .imageSize = 64, .lighting = GetParam()});
  const CpuViews views(*drawn.pack, sunDirection(UpAxis::z, Sun{}));
  for (const glm::dvec3 direction :
       {glm::dvec3(0.3, 0.5, 0.8), glm::dvec3(-0.7, 0.2, 0.3), glm::dvec3(0.1, -0.9, -0.4)}) {
    const glm::dvec3 toward = glm::normalize(direction);
    for (const int edge : {16, 32, 64, 128}) {
      for (const ImpostorKind kind : {ImpostorKind::depthCorrected, ImpostorKind::blended}) {
        const FrameImage gl = drawnFromAfar(drawn, toward, edge, kind);
        const Apart same = apart(gl, views.from(toward, edge, kind));
        EXPECT_GT(same.shown, 20);
        // Where texels are a quarter of a pixel, eighths of a level of detail and of a texel show.
        EXPECT_LT(same.mean, edge < 32 ? 0.9 : 0.3) << edge << " pixels";
        // A picture from elsewhere is far off: the bound means something.
        const glm::dvec3 beside = glm::normalize(toward + 0.05 * viewFrame(toward).right);
        EXPECT_GT(apart(gl, views.from(beside, edge, kind)).mean, 3 * same.mean);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Packs, Look, testing::Values(Lighting::baked, Lighting::relightable));

}  // namespace
}  // namespace farcell
