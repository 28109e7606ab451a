// The stored error against brute force over the full geometry.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/preprocess/lod/lod_models.h"

namespace farcell {
namespace {

using test::Levels;

glm::dvec3 cornerOf(const LodMesh& mesh, size_t triangle, size_t k) {
  return glm::dvec3(mesh.positions[mesh.indices[3 * triangle + k]]);
}

// The point of a triangle that is nearest: by its plane where the foot lies inside, else by the edges.
double distance(glm::dvec3 p, const LodMesh& mesh, size_t triangle) {
  double best = INFINITY;
  bool inside = true;
  const glm::dvec3 a = cornerOf(mesh, triangle, 0);
  const glm::dvec3 normal = glm::cross(cornerOf(mesh, triangle, 1) - a, cornerOf(mesh, triangle, 2) - a);
  for (size_t k = 0; k < 3; ++k) {
    const glm::dvec3 from = cornerOf(mesh, triangle, k), to = cornerOf(mesh, triangle, (k + 1) % 3);
    inside &= glm::dot(glm::cross(to - from, p - from), normal) >= 0;
    const double t = std::clamp(glm::dot(p - from, to - from) / glm::dot(to - from, to - from), 0.0, 1.0);
    best = std::min(best, glm::distance(p, from + t * (to - from)));
  }
  return inside && glm::length(normal) > 0 ? std::min(best, std::abs(glm::dot(p - a, normal)) / glm::length(normal))
                                           : best;
}

double distance(glm::dvec3 p, const LodMesh& mesh) {
  double best = INFINITY;
  for (size_t t = 0; t < mesh.triangles(); ++t) best = std::min(best, distance(p, mesh, t));
  return best;
}

double sampledDistance(const LodMesh& from, const LodMesh& to, int samples, test::Random& random) {
  double worst = 0;
  for (int i = 0; i < samples; ++i) {
    const size_t t = random.below(from.triangles());
    double u = random.uniform(0, 1), v = random.uniform(0, 1);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const glm::dvec3 p = cornerOf(from, t, 0) * (1 - u - v) + cornerOf(from, t, 1) * u + cornerOf(from, t, 2) * v;
    worst = std::max(worst, distance(p, to));
  }
  return worst;
}

// tightness: at least this share of the bound is found, so that it says something.
void expectBound(const std::vector<InputTriangle>& model, const LodSettings& lod, double tightness) {
  const uint32_t seed = std::random_device{}();
  SCOPED_TRACE(seed);
  test::Random random(seed);
  BuildSettings settings;
  settings.fixedLevel = 2;
  const Levels levels = test::levelsOf(model, settings, lod);
  for (const CellKey& cell : {CellKey{}, levels.children.rbegin()->first}) {
    const SimplifiedCell& simplified = levels.cells.at(cell);
    ASSERT_GT(simplified.mesh.triangles(), 0u);
    const LodMesh full = test::fullMesh(levels, cell);
    const double there = sampledDistance(full, simplified.mesh, 400, random);
    const double back = sampledDistance(simplified.mesh, full, 400, random);
    EXPECT_GE(simplified.errorSteps, there);
    EXPECT_GE(simplified.errorSteps, back);
    EXPECT_GE(std::max(there, back), tightness * simplified.errorSteps);
  }
}

TEST(LodError, BoundsWhatBruteForceFinds) { expectBound(test::torus(120, 40), {.targetTriangles = 600}, 0.05); }
TEST(LodError, BoundsWhatBruteForceFindsByOpenMesh) {
  expectBound(test::torus(100, 40), {.targetTriangles = 900, .simplifier = Simplifier::openmesh}, 0.05);
}
TEST(LodError, BoundsWhatBruteForceFindsWherePartsAreTaken) {
  // The farthest is one part among many, which few samples find.
  expectBound(test::city(1, 20), {.targetTriangles = 700}, 0);
  expectBound(test::looseTriangles(2, 3000, 0.03, 1), {.targetTriangles = 400}, 0);
}

// A roof in the air above a plane: taken away, it is as far from what is left as it was high.
TEST(LodError, OfWhatIsTakenAwayIsItsDistanceFromWhatIsLeft) {
  const Grid grid;
  LodMesh mesh;
  mesh.positions = {{1000, 1000, 1000}, {900000, 1000, 1000}, {1000, 900000, 1000},
                    {5000, 5000, 3000}, {5100, 5000, 3000},   {5000, 5100, 3000}};
  mesh.indices = {0, 1, 2, 3, 4, 5};
  const SimplifiedCell result = simplifyCell(grid, {}, std::span(&mesh, 1), 7, {.targetTriangles = 1}).value();
  EXPECT_EQ(result.mesh.triangles(), 1u);
  EXPECT_EQ(result.figures.partsTaken, 1u);
  EXPECT_NEAR(result.errorSteps, 2000 + 7, 1);
}

}  // namespace
}  // namespace farcell
