#include "preprocess/lod/simplify_cell.h"

#include <gtest/gtest.h>

#include <limits>

#include "cache/base/parallel.h"
#include "tests/preprocess/lod/lod_models.h"

namespace farcell {
namespace {

using test::Levels;

const Grid kGrid;
const CellKey kCell{4, 1, 2, 3};

GridPoint inCell(int32_t x, int32_t y, int32_t z) { return cellBox(kGrid, kCell).min + GridPoint(x, y, z); }

// A square of n x n squares in the middle of the cell, not at its faces.
LodMesh sheet(int n, uint32_t colour = 0xffffff, int32_t height = 5000) {
  LodMesh mesh;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) {
      mesh.positions.push_back(inCell(1000 + 100 * x, 1000 + 100 * y, height));
      mesh.colours.push_back(colour);
    }
  const auto at = [&](int x, int y) { return static_cast<uint32_t>(y * (n + 1) + x); };
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x)
      for (const uint32_t index : {at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y), at(x + 1, y + 1), at(x, y + 1)})
        mesh.indices.push_back(index);
  return mesh;
}

std::vector<GridPoint> cornersOf(const LodMesh& mesh) {
  std::vector<GridPoint> corners;
  for (const uint32_t index : mesh.indices) corners.push_back(mesh.positions[index]);
  return corners;
}

Result<SimplifiedCell> simplify(const std::vector<LodMesh>& children, uint64_t target,
                                Simplifier simplifier = Simplifier::collapse) {
  return simplifyCell(kGrid, kCell, children, 0, {.targetTriangles = target, .simplifier = simplifier});
}

TEST(SimplifyCell, APlaneBecomesTwoTrianglesWithoutError) {
  for (const Simplifier simplifier : {Simplifier::collapse, Simplifier::openmesh}) {
    const SimplifiedCell result = simplify({sheet(20)}, 2, simplifier).value();
    EXPECT_EQ(result.mesh.triangles(), 2u);
    EXPECT_LT(result.errorSteps, 1);
    EXPECT_NEAR(result.figures.areaKept, 1, 1e-3);
    EXPECT_FALSE(result.figures.aboveTarget);
  }
}

TEST(SimplifyCell, OfNothingIsNothing) {
  for (const std::vector<LodMesh>& children : {std::vector<LodMesh>{}, std::vector<LodMesh>(8)}) {
    const SimplifiedCell result = simplify(children, 100).value();
    EXPECT_EQ(result.mesh, LodMesh{});
    EXPECT_EQ(result.errorSteps, 0);
  }
}

TEST(SimplifyCell, WhatIsBelowTheTargetStays) {
  const LodMesh mesh = sheet(3);
  const SimplifiedCell result = simplify({mesh}, 18).value();
  EXPECT_EQ(cornersOf(result.mesh), cornersOf(mesh));
  EXPECT_EQ(result.errorSteps, 0);
}

TEST(SimplifyCell, ATriangleIsNeverSimplifiedAway) {
  LodMesh mesh;
  mesh.positions = {inCell(10, 10, 10), inCell(20, 10, 10), inCell(10, 20, 10)};
  mesh.indices = {0, 1, 2};
  EXPECT_EQ(simplify({mesh}, 0).value().mesh.triangles(), 1u);
}

TEST(SimplifyCell, WhatLiesOnTheCellsFacesStaysAndIsToldOf) {
  LodMesh mesh = sheet(10);
  for (GridPoint& p : mesh.positions) p.z = cellBox(kGrid, kCell).max.z;
  const SimplifiedCell result = simplify({mesh}, 2).value();
  EXPECT_EQ(cornersOf(result.mesh), cornersOf(mesh));
  EXPECT_TRUE(result.figures.aboveTarget);
  EXPECT_EQ(result.figures.lockedTriangles, 200u);
}

TEST(SimplifyCell, SharedFacesOfChildrenAreWeldedAndFree) {
  LodMesh left = sheet(10), right = sheet(10);
  for (GridPoint& p : right.positions) p.x += 1000;
  const SimplifiedCell result = simplify({left, right}, 2).value();
  EXPECT_EQ(result.mesh.triangles(), 2u);
  EXPECT_EQ(result.figures.parts, 1u);
  EXPECT_LT(result.errorSteps, 1);
}

TEST(SimplifyCell, NonManifoldFansDuplicatesAndFlatTrianglesAreTaken) {
  LodMesh mesh = sheet(8);
  const uint32_t a = mesh.indices[0], b = mesh.indices[1];
  for (int i = 0; i < 40; ++i) {  // a fan of 40 triangles about one edge
    mesh.indices.insert(mesh.indices.end(), {a, b, static_cast<uint32_t>(mesh.positions.size())});
    mesh.positions.push_back(inCell(1050, 1000 + 37 * i, 9000 - 91 * i));
    mesh.colours.push_back(0xff);
  }
  for (int i = 0; i < 10; ++i) mesh.indices.insert(mesh.indices.end(), {3, 4, 13, 3, 13, 4, 5, 5, 6, 0, 1, 2});
  for (const Simplifier simplifier : {Simplifier::collapse, Simplifier::openmesh}) {
    const SimplifiedCell result = simplify({mesh}, 20, simplifier).value();
    EXPECT_LE(result.mesh.triangles(), 60u);
    EXPECT_GT(result.mesh.triangles(), 0u);
    EXPECT_EQ(result.figures.fellBack, simplifier == Simplifier::openmesh);
  }
}

TEST(SimplifyCell, AColourKeepsItsSide) {
  LodMesh left = sheet(10, 0x0000ff), right = sheet(10, 0xff0000);
  for (GridPoint& p : right.positions) p.x += 1000;
  const SimplifiedCell result = simplify({left, right}, 20).value();
  const int32_t seam = inCell(2000, 0, 0).x;
  double red = 0;
  for (size_t i = 0; i < result.mesh.indices.size(); i += 3) {
    const uint32_t* t = &result.mesh.indices[i];
    const uint32_t colour = result.mesh.colours[t[0]];
    EXPECT_EQ(colour, result.mesh.colours[t[1]]);
    EXPECT_EQ(colour, result.mesh.colours[t[2]]);
    for (size_t k = 0; k < 3; ++k) {
      const int32_t x = result.mesh.positions[t[k]].x;
      EXPECT_TRUE(colour == 0xff ? x <= seam : x >= seam);
    }
    red += colour == 0xff;
  }
  EXPECT_GT(red, 0);
}

double areaOf(const LodMesh& mesh, size_t t) {
  const glm::dvec3 a(mesh.positions[mesh.indices[3 * t]]), b(mesh.positions[mesh.indices[3 * t + 1]]),
      c(mesh.positions[mesh.indices[3 * t + 2]]);
  return 0.5 * glm::length(glm::cross(b - a, c - a));
}

// Lit by hand: ambient light of a quarter and three quarters of |n.l|.
double litGrey(const LodMesh& mesh, size_t t, glm::dvec3 sun) {
  const glm::dvec3 a(mesh.positions[mesh.indices[3 * t]]), b(mesh.positions[mesh.indices[3 * t + 1]]),
      c(mesh.positions[mesh.indices[3 * t + 2]]);
  const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
  return 200 * (0.25 + 0.75 * std::abs(glm::dot(normal, sun)));
}

// A sheet of grey 200 with ripples much smaller than its triangles will be.
LodMesh rippled(uint32_t seed) {
  LodMesh mesh = sheet(60, 0xc8c8c8);
  test::Random random(seed);
  for (GridPoint& p : mesh.positions) p.z += static_cast<int32_t>(random.uniform(-40, 40));
  return mesh;
}

TEST(SimplifyCell, ATriangleShowsTheMeanOfWhatItStandsFor) {
  const uint32_t seed = 5;
  SCOPED_TRACE(seed);
  const glm::vec3 sun = glm::normalize(glm::vec3(0.8f, 0.2f, 0.6f));
  const std::vector<LodMesh> children = {rippled(seed)};
  const LodMesh mesh = simplifyCell(kGrid, kCell, children, 0, {.targetTriangles = 400, .sun = sun}).value().mesh;
  ASSERT_EQ(mesh.shown.size(), mesh.triangles());
  double full = 0, fullArea = 0, shown = 0, area = 0, byNormals = 0;
  for (size_t t = 0; t < children[0].triangles(); ++t) {
    full += areaOf(children[0], t) * litGrey(children[0], t, glm::dvec3(sun));
    fullArea += areaOf(children[0], t);
  }
  for (size_t t = 0; t < mesh.triangles(); ++t) {
    EXPECT_EQ(mesh.shown[t] & 0xff, mesh.shown[t] >> 8 & 0xff);
    EXPECT_EQ(mesh.shown[t] & 0xff, mesh.shown[t] >> 16);
    shown += areaOf(mesh, t) * (mesh.shown[t] & 0xff);
    byNormals += areaOf(mesh, t) * litGrey(mesh, t, glm::dvec3(sun));
    area += areaOf(mesh, t);
  }
  EXPECT_NEAR(shown / area, full / fullArea, 0.5);
  EXPECT_GT(std::abs(byNormals / area - full / fullArea), 2);  // what the triangles' own normals would show
}

TEST(SimplifyCell, WhatATriangleShowsComesFromItsSideOfASeam) {
  const glm::vec3 sun(0, 0, 1);
  LodMesh left = sheet(10, 0x0000ff), right = sheet(10, 0xff0000);
  for (GridPoint& p : right.positions) p.x += 1000;
  const std::vector<LodMesh> children = {left, right};
  const SimplifiedCell first = simplifyCell(kGrid, kCell, children, 0, {.targetTriangles = 20, .sun = sun}).value();
  // What was shown already is what counts above.
  const SimplifiedCell above =
      simplifyCell(kGrid, kCell, std::span(&first.mesh, 1), 0, {.targetTriangles = 4, .sun = sun}).value();
  const int32_t seam = inCell(2000, 0, 0).x;
  for (const LodMesh* mesh : {&first.mesh, &above.mesh})
    for (size_t t = 0; t < mesh->triangles(); ++t) {
      int32_t least = INT32_MAX;
      for (size_t k = 0; k < 3; ++k) least = std::min(least, mesh->positions[mesh->indices[3 * t + k]].x);
      EXPECT_EQ(mesh->shown[t], least < seam ? 0x0000ffu : 0xff0000u);
    }
}

TEST(SimplifyCell, WithoutLightOrWithNormalsNothingIsSaidToBeShown) {
  EXPECT_TRUE(simplify({sheet(10)}, 20).value().mesh.shown.empty());
  LodMesh smooth = sheet(10);
  smooth.normals.assign(smooth.positions.size(), 1);
  const std::vector<LodMesh> children = {smooth};
  EXPECT_TRUE(simplifyCell(kGrid, kCell, children, 0, {.targetTriangles = 20, .sun = glm::vec3(0, 0, 1)})
                  .value()
                  .mesh.shown.empty());
}

TEST(SimplifyCell, NormalsOfASharpEdgeStayOnTheirSides) {
  LodMesh floor = sheet(10), wall = sheet(10);
  floor.normals.assign(floor.positions.size(), 1);
  wall.normals.assign(wall.positions.size(), 0x7fff);
  for (GridPoint& p : wall.positions) p = {inCell(1000, 0, 0).x, p.y, p.z + p.x - inCell(1000, 0, 0).x};
  const SimplifiedCell result = simplify({floor, wall}, 8).value();
  EXPECT_LT(result.errorSteps, 1);
  for (size_t i = 0; i < result.mesh.indices.size(); i += 3) {
    const uint32_t* t = &result.mesh.indices[i];
    EXPECT_EQ(result.mesh.normals[t[0]], result.mesh.normals[t[1]]);
    EXPECT_EQ(result.mesh.normals[t[0]], result.mesh.normals[t[2]]);
  }
}

TEST(SimplifyCell, ContradictionsAreArgumentsThatAreRefused) {
  const auto expectRefused = [](const auto& spoil) {
    std::vector<LodMesh> children = {sheet(3), sheet(3)};
    spoil(children[1]);
    const Result<SimplifiedCell> result = simplify(children, 10);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().kind, ErrorKind::invalidArgument);
    EXPECT_NE(result.error().message.find("child 1: expected"), std::string::npos) << result.error().message;
  };
  expectRefused([](LodMesh& mesh) { mesh.indices[4] = 16; });
  expectRefused([](LodMesh& mesh) { mesh.indices.pop_back(); });
  expectRefused([](LodMesh& mesh) { mesh.colours.pop_back(); });
  expectRefused([](LodMesh& mesh) { mesh.colours.clear(); });
  expectRefused([](LodMesh& mesh) { mesh.normals.assign(mesh.positions.size(), 0); });
  expectRefused([](LodMesh& mesh) { mesh.positions[3].y = cellBox(kGrid, kCell).max.y + 1; });
  expectRefused([](LodMesh& mesh) { mesh = LodMesh{{}, {}, {}, {0, 1, 2}}; });
  for (const double error : {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_FALSE(simplifyCell(kGrid, kCell, {}, error, {}));
  EXPECT_FALSE(simplifyCell(kGrid, CellKey{24}, {}, 0, {}));
}

TEST(SimplifyCell, IsTheSameFromAnyNumberOfThreads) {
  BuildSettings settings;
  settings.fixedLevel = 2;
  for (const auto& model : {test::torus(60, 30), test::city(4, 16)}) {
    const LodSettings lod{.targetTriangles = 200};
    const Levels levels = test::levelsOf(model, settings, lod);
    std::vector<CellKey> cells;
    for (const auto& [cell, children] : levels.children) cells.push_back(cell);
    std::vector<SimplifiedCell> again(cells.size());
    parallelFor(cells.size(), 4, [&](size_t i, int) { again[i] = test::simplified(levels, cells[i], lod); });
    for (size_t i = 0; i < cells.size(); ++i) {
      EXPECT_EQ(again[i].mesh, levels.cells.at(cells[i]).mesh);
      EXPECT_EQ(again[i].errorSteps, levels.cells.at(cells[i]).errorSteps);
    }
  }
}

}  // namespace
}  // namespace farcell
