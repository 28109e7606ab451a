// What quadrics alone lose: parts, and with them what a picture shows.
#include <gtest/gtest.h>

#include "cache/schema/view_frame.h"
#include "cache/schema/viewpoints.h"
#include "preprocess/bake/view_baker.h"
#include "tests/preprocess/lod/lod_models.h"

namespace farcell {
namespace {

using test::Levels;

CellSoup soupOf(const GridBox& box, const LodMesh& mesh) {
  const glm::dvec3 centre = 0.5 * (glm::dvec3(box.min) + glm::dvec3(box.max));
  CellSoup soup;
  for (size_t i = 0; i < mesh.indices.size(); ++i) {
    const glm::vec3 p((glm::dvec3(mesh.positions[mesh.indices[i]]) - centre) / (0.5 * (box.max.x - box.min.x)));
    soup.x[i % 3].push_back(p.x);
    soup.y[i % 3].push_back(p.y);
    soup.z[i % 3].push_back(p.z);
    soup.colours[i % 3].push_back(0xffffff);
  }
  return soup;
}

// Mean projected area over the directions of 42 views.
double coverage(const GridBox& box, const LodMesh& mesh) {
  const CellSoup soup = soupOf(box, mesh);
  const Viewpoints viewpoints = Viewpoints::create(42).value();
  ViewBaker baker({.imageSize = 128, .samples = 16});
  double sum = 0;
  for (int view = 0; view < viewpoints.count(); ++view) {
    if (view > viewpoints.antipode(view)) continue;
    BakedView front, back;
    baker.begin(viewFrame(viewpoints.directions()[static_cast<size_t>(view)]));
    baker.add(soup);
    baker.finish(front, back);
    for (size_t i = 3; i < front.rgba.size(); i += 4) sum += front.rgba[i];
  }
  return sum;
}

double coverageKept(const std::vector<InputTriangle>& model, uint64_t target) {
  BuildSettings settings;
  settings.fixedLevel = 2;
  const Levels levels = test::levelsOf(model, settings, {.targetTriangles = target});
  const SimplifiedCell& root = levels.cells.at({});
  EXPECT_LE(root.mesh.triangles(), target);
  EXPECT_GT(root.figures.partsTaken, 0u);
  const GridBox box = cellBox(levels.grid, {});
  return coverage(box, root.mesh) / coverage(box, test::fullMesh(levels, {}));
}

TEST(LodCoverage, ACityKeepsItsBuildings) {
  const double kept = coverageKept(test::city(1, 40), 2400);  // of 19,200
  EXPECT_GT(kept, 0.9);
  EXPECT_LT(kept, 1.1);
}

TEST(LodCoverage, LooseTrianglesKeepTheirArea) {
  const double kept = coverageKept(test::looseTriangles(2, 20000, 0.02, 1), 2500);
  EXPECT_GT(kept, 0.9);
  EXPECT_LT(kept, 1.1);
}

TEST(LodCoverage, SliversKeepTheirArea) {
  const double kept = coverageKept(test::looseTriangles(3, 20000, 0.04, 0.02), 2500);
  EXPECT_GT(kept, 0.9);
  EXPECT_LT(kept, 1.1);
}

}  // namespace
}  // namespace farcell
