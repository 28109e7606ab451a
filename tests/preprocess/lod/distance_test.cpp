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

glm::dvec3 pointOf(const LodMesh& mesh, size_t triangle, test::Random& random) {
  double u = random.uniform(0, 1), v = random.uniform(0, 1);
  if (u + v > 1) u = 1 - u, v = 1 - v;
  return cornerOf(mesh, triangle, 0) * (1 - u - v) + cornerOf(mesh, triangle, 1) * u + cornerOf(mesh, triangle, 2) * v;
}

double sampledDistance(const LodMesh& from, const LodMesh& to, int samples, test::Random& random) {
  double worst = 0;
  for (int i = 0; i < samples; ++i)
    worst = std::max(worst, distance(pointOf(from, random.below(from.triangles()), random), to));
  return worst;
}

// At a point of every triangle.
double greatestDistance(const LodMesh& from, const LodMesh& to, test::Random& random) {
  double worst = 0;
  for (size_t t = 0; t < from.triangles(); ++t) worst = std::max(worst, distance(pointOf(from, t, random), to));
  return worst;
}

// tightness: at least this share of the bound is found, so that it says something. slack: by how much of the bound the
// true distance may be larger, as the bound is measured at samples.
void expectBound(const std::vector<InputTriangle>& model, const LodSettings& lod, double tightness, double slack) {
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
    EXPECT_GE((1 + slack) * simplified.errorSteps, there);
    EXPECT_GE((1 + slack) * simplified.errorSteps, back);
    EXPECT_GE(std::max(there, back), tightness * simplified.errorSteps);
  }
}

TEST(LodError, BoundsWhatBruteForceFinds) { expectBound(test::torus(120, 40), {.targetTriangles = 600}, 0.05, 0); }
TEST(LodError, BoundsWhatBruteForceFindsByOpenMesh) {
  expectBound(test::torus(100, 40), {.targetTriangles = 900, .simplifier = Simplifier::openmesh}, 0.05, 0);
}
TEST(LodError, BoundsWhatBruteForceFindsWherePartsAreTaken) {
  // The farthest is one part among many, which few samples find. A triangle is looked at closely if one of its seven
  // samples is farther than the root of 0.8 of the greatest; between them it can be farther by 0.29 of its longest
  // edge, which is no more than a fifth of the greatest here.
  constexpr double kSlack = 0.1;
  expectBound(test::city(1, 20), {.targetTriangles = 700}, 0, kSlack);
  expectBound(test::looseTriangles(2, 3000, 0.03, 1), {.targetTriangles = 400}, 0, kSlack);
}

struct Distances {
  double there = 0, back = 0;  // of the cell's side
};

// One cell, nothing of it locked.
Distances distancesOf(const std::vector<InputTriangle>& model, uint64_t target, uint32_t seed) {
  test::Random random(seed);
  BuildSettings settings;
  settings.fixedLevel = 0;
  const Levels levels = test::leavesOf(model, settings);
  const LodMesh& full = levels.cells.at({}).mesh;
  const LodMesh mesh = simplifyCell(levels.grid, {}, std::span(&full, 1), 0, {.targetTriangles = target}).value().mesh;
  EXPECT_LE(mesh.triangles(), target);
  const GridBox box = cellBox(levels.grid, {});
  const double side = box.max.x - box.min.x;
  return {greatestDistance(full, mesh, random) / side, greatestDistance(mesh, full, random) / side};
}

// Not even with an eighth of the triangles.
TEST(LodError, ALoneBuildingFarFromTheCityStays) {
  for (uint32_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    std::vector<InputTriangle> model = test::city(seed, 10);
    test::addBox(model, {20, 20, 0}, glm::dvec3(0.5));
    const Distances distances = distancesOf(model, model.size() / 8, seed);
    EXPECT_LT(distances.there, 0.25);
    EXPECT_LT(distances.back, 0.25);
  }
}

// Their area shrinks as they lose their thickness: what makes up for it must not make them much longer.
TEST(LodError, FencesDoNotGrowBeyondTheirEnds) {
  for (uint32_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<InputTriangle> model = test::fences(seed, 10);
    EXPECT_LT(distancesOf(model, model.size() / 4, seed).back, 0.005);
  }
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
