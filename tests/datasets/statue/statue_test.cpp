#include "datasets/statue/statue.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <set>
#include <sstream>

#include "cache/base/process.h"
#include "datasets/statue/subdivision.h"
#include "preprocess/read/open_mesh.h"
#include "tests/support/sanitized.h"

namespace farcell {
namespace {

using Corners = std::array<glm::dvec3, 3>;

constexpr uint64_t kManyTriangles = kSanitized ? 30'000 : 60'000;

BaseMesh meshOf(const std::vector<Corners>& triangles, double scale = 1, glm::dvec3 offset = glm::dvec3(0)) {
  BaseMeshBuilder builder;
  constexpr std::array<uint8_t, 3> kGrey = {160, 160, 160};
  for (Corners corners : triangles) {
    for (glm::dvec3& corner : corners) corner = offset + scale * corner;
    if (!builder.add(corners, {kGrey, kGrey, kGrey})) throw std::runtime_error("add");
  }
  auto mesh = std::move(builder).finish();
  if (!mesh) throw std::runtime_error(mesh.error().message);
  return std::move(*mesh);
}

// Corner bits x, y, z; counter-clockwise seen from outside.
std::vector<Corners> box() {
  constexpr int kCorners[12][3] = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                                   {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  std::vector<Corners> triangles;
  for (const auto& corners : kCorners) {
    Corners triangle;
    for (size_t i = 0; i < 3; ++i) triangle[i] = glm::dvec3(corners[i] & 1, corners[i] >> 1 & 1, corners[i] >> 2);
    triangles.push_back(triangle);
  }
  return triangles;
}

// An octahedron, subdivided and pushed to the unit sphere.
std::vector<Corners> sphere(int level) {
  std::vector<Corners> triangles;
  for (int octant = 0; octant < 8; ++octant) {
    const glm::dvec3 x(octant & 1 ? -1 : 1, 0, 0), y(0, octant & 2 ? -1 : 1, 0), z(0, 0, octant & 4 ? -1 : 1);
    const bool turned = ((octant & 1) + (octant >> 1 & 1) + (octant >> 2)) % 2 == 1;
    triangles.push_back(turned ? Corners{x, z, y} : Corners{x, y, z});
  }
  for (int i = 0; i < level; ++i) {
    std::vector<Corners> finer;
    for (const auto& [a, b, c] : triangles) {
      const glm::dvec3 ab = glm::normalize(a + b), bc = glm::normalize(b + c), ca = glm::normalize(c + a);
      for (const Corners& part : {Corners{a, ab, ca}, Corners{ab, b, bc}, Corners{ca, bc, c}, Corners{ab, bc, ca}})
        finer.push_back(part);
    }
    triangles = finer;
  }
  return triangles;
}

StatueSettings sized(uint64_t triangles, int threads = 0) {
  StatueSettings settings;
  settings.triangles = triangles;
  settings.threads = threads;
  return settings;
}

// A statue read back, its corners joined by place.
struct Surface {
  std::vector<glm::dvec3> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;
  std::set<uint32_t> colours;
  glm::dvec3 min{INFINITY};
  glm::dvec3 max{-INFINITY};
  uint64_t skipped = 0;
  uint64_t declaredVertices = 0;
};

// Edges that are not passed once each way; 0: closed, and oriented all over.
size_t openEdges(const std::vector<std::array<uint32_t, 3>>& triangles) {
  std::map<std::pair<uint32_t, uint32_t>, std::array<int, 2>> passes;
  for (const auto& triangle : triangles)
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t from = triangle[i], to = triangle[(i + 1) % 3];
      ++passes[std::minmax(from, to)][from < to ? 0 : 1];
    }
  return static_cast<size_t>(std::count_if(passes.begin(), passes.end(), [](const auto& pass) {
    return pass.second != std::array<int, 2>{1, 1};
  }));
}

class StatueTest : public testing::Test {
 protected:
  StatueTest() {
    std::string name = (std::filesystem::temp_directory_path() / "farcell-statue.XXXXXX").string();
    directory_ = ::mkdtemp(name.data());
  }
  ~StatueTest() override { std::filesystem::remove_all(directory_); }

  StatueCounts write(const BaseMesh& base, const StatueSettings& settings, const std::string& name = "statue.ply") {
    Progress silent(false);
    const auto counts = writeStatue(base, settings, directory_ / name, silent);
    if (counts) return *counts;
    ADD_FAILURE() << counts.error().message;
    return {};
  }
  std::string bytes(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(directory_ / name, std::ios::binary).rdbuf();
    return text.str();
  }
  Surface read(const std::string& name = "statue.ply") const {
    Surface surface;
    const auto reader = openMesh(directory_ / name);
    if (!reader) throw std::runtime_error(reader.error().message);
    surface.declaredVertices = (*reader)->info().vertices;
    std::map<std::array<double, 3>, uint32_t> places;
    const auto counts = (*reader)->forEachTriangle([&](std::span<const InputTriangle> batch) -> Result<> {
      for (const InputTriangle& input : batch) {
        std::array<uint32_t, 3> triangle{};
        for (size_t i = 0; i < 3; ++i) {
          const glm::dvec3 p = input.positions[i];
          const auto [place, isNew] = places.try_emplace({p.x, p.y, p.z}, static_cast<uint32_t>(places.size()));
          if (isNew) surface.vertices.push_back(p);
          triangle[i] = place->second;
          surface.min = glm::min(surface.min, p);
          surface.max = glm::max(surface.max, p);
          surface.colours.insert(input.colours[i]);
        }
        surface.triangles.push_back(triangle);
      }
      return {};
    });
    if (!counts) throw std::runtime_error(counts.error().message);
    for (const auto& [reason, count] : counts->skipped) surface.skipped += count;
    return surface;
  }

  std::filesystem::path directory_;
};

TEST_F(StatueTest, IsTheSameForTheSameSettingsAtAnyThreadCount) {
  const auto figure = makeFigure(sized(kManyTriangles));
  ASSERT_TRUE(figure);
  write(*figure, sized(kManyTriangles, 1), "one.ply");
  const auto again = makeFigure(sized(kManyTriangles, 3));
  ASSERT_TRUE(again);
  write(*again, sized(kManyTriangles, 3), "three.ply");
  StatueSettings other = sized(kManyTriangles);
  other.seed = 2;
  write(*figure, other, "other.ply");
  EXPECT_TRUE(bytes("one.ply") == bytes("three.ply"));
  EXPECT_FALSE(bytes("one.ply") == bytes("other.ply"));
}

TEST_F(StatueTest, TheFigureIsClosedWhateverItsFace) {
  for (const uint64_t seed : {1, 2, 3}) {
    if (kSanitized && seed > 1) break;
    for (const uint64_t triangles : {kMinStatueTriangles, uint64_t{30'000}}) {
      SCOPED_TRACE(fmt::format("seed {} triangles {}", seed, triangles));
      StatueSettings settings = sized(triangles);
      settings.seed = seed;
      const auto figure = makeFigure(settings);
      ASSERT_TRUE(figure);
      EXPECT_LE(figure->triangles.size(), triangles);
      EXPECT_EQ(openEdges(figure->triangles), 0u);
    }
  }
}

TEST_F(StatueTest, IsReadBackWholeClosedAndInItsPlace) {
  const auto figure = makeFigure(sized(kManyTriangles));
  ASSERT_TRUE(figure);
  const StatueCounts counts = write(*figure, sized(kManyTriangles));
  EXPECT_EQ(std::filesystem::file_size(directory_ / "statue.ply"), counts.bytes);
  const Surface surface = read();
  EXPECT_EQ(surface.declaredVertices, counts.vertices);
  EXPECT_EQ(surface.vertices.size(), counts.vertices);
  EXPECT_EQ(surface.triangles.size(), counts.triangles);
  EXPECT_EQ(surface.skipped, 0u);
  EXPECT_EQ(openEdges(surface.triangles), 0u);
  EXPECT_GT(surface.colours.size(), 500u);
  // A figure taller than wide, on the ground that it was modelled on.
  EXPECT_NEAR(surface.max.z - surface.min.z, 5.5, 0.3);
  EXPECT_LT(surface.max.x - surface.min.x, 4.0);
}

TEST_F(StatueTest, HasAboutAsManyTrianglesAsAskedFor) {
  const auto figure = makeFigure(sized(20'000));
  ASSERT_TRUE(figure);
  const BaseMesh cube = meshOf(box());
  const BaseMesh ball = meshOf(sphere(3));
  for (const BaseMesh* base : {&*figure, &cube, &ball})
    for (const uint64_t wished : {1'000, 20'000, 33'333, 150'000, 1'000'000}) {
      if (wished < base->triangles.size()) continue;
      const auto subdivision = Subdivision::create(*base, wished, 1);
      ASSERT_TRUE(subdivision);
      EXPECT_NEAR(static_cast<double>(subdivision->faceCount()) / static_cast<double>(wished), 1, 0.05);
    }
}

TEST_F(StatueTest, EdgesAreCutAlikeFromBothSidesWhateverTheirLengths) {
  // Long, short, needle-like: the box is stretched; its faces are named triangle by triangle, as separate ones are.
  std::vector<Corners> triangles = box();
  for (Corners& corners : triangles)
    for (glm::dvec3& corner : corners) corner *= glm::dvec3(37, 1, 0.04);
  const BaseMesh base = meshOf(triangles);
  EXPECT_EQ(base.positions.size(), 8u);
  for (const uint64_t wished : {12, 40, 300, 5'000, 60'000}) {
    SCOPED_TRACE(wished);
    const auto subdivision = Subdivision::create(base, wished, 5);
    ASSERT_TRUE(subdivision);
    std::vector<std::array<uint32_t, 3>> faces(subdivision->faceCount());
    subdivision->faces(0, faces);
    EXPECT_EQ(openEdges(faces), 0u);
    std::set<uint32_t> used;
    for (const auto& face : faces) used.insert(face.begin(), face.end());
    EXPECT_EQ(used.size(), subdivision->vertexCount());
    EXPECT_EQ(*used.rbegin() + 1, subdivision->vertexCount());
    // V - E + F of a closed surface without holes.
    EXPECT_EQ(subdivision->vertexCount(), 2 + subdivision->faceCount() / 2);
  }
}

TEST_F(StatueTest, AnyPartIsMadeWithoutTheRest) {
  const BaseMesh base = meshOf(sphere(1));
  const auto subdivision = Subdivision::create(base, 7'000, 3);
  ASSERT_TRUE(subdivision);
  std::vector<std::array<uint32_t, 3>> faces(subdivision->faceCount());
  std::vector<SurfacePoint> points(subdivision->vertexCount());
  subdivision->faces(0, faces);
  subdivision->points(0, points);
  for (uint64_t i = 0; i < faces.size(); ++i) {
    std::array<std::array<uint32_t, 3>, 1> face;
    subdivision->faces(i, face);
    ASSERT_EQ(face[0], faces[i]) << i;
  }
  for (uint64_t i = 0; i < points.size(); ++i) {
    std::array<SurfacePoint, 1> point;
    subdivision->points(i, point);
    ASSERT_EQ(point[0].corners, points[i].corners) << i;
    ASSERT_EQ(point[0].weights, points[i].weights) << i;
    ASSERT_NEAR(points[i].weights[0] + points[i].weights[1] + points[i].weights[2], 1, 1e-12);
  }
}

TEST_F(StatueTest, FacesKeepTheWindingAndTheAreaOfTheirTriangle) {
  const BaseMesh base = meshOf(box());
  for (const uint64_t wished : {12, 30, 60, 100, 2'000}) {
    const auto subdivision = Subdivision::create(base, wished, 7);
    ASSERT_TRUE(subdivision);
    std::vector<std::array<uint32_t, 3>> faces(subdivision->faceCount());
    std::vector<SurfacePoint> points(subdivision->vertexCount());
    subdivision->faces(0, faces);
    subdivision->points(0, points);
    const auto place = [&](uint32_t vertex) {
      glm::dvec3 sum(0);
      for (size_t i = 0; i < 3; ++i) sum += points[vertex].weights[i] * base.positions[points[vertex].corners[i]];
      return sum;
    };
    double area = 0;
    for (const auto& face : faces) {
      const glm::dvec3 a = place(face[0]);
      const glm::dvec3 twice = glm::cross(place(face[1]) - a, place(face[2]) - a);
      EXPECT_GT(glm::dot(twice, a), 0) << "turned inside";
      area += glm::length(twice) / 2;
    }
    EXPECT_NEAR(area, 6 / 3.0, 1e-9);  // of a cube whose diagonal is 1
  }
}

TEST_F(StatueTest, ReliefStaysWithinItsAmplitude) {
  const BaseMesh base = meshOf(sphere(5));
  StatueSettings settings = sized(100'000);
  settings.amplitude = 0.01;
  write(base, settings);
  const double amplitude = 0.01 * base.diagonal;
  double lowest = 1e9, highest = 0, sum = 0;
  const Surface surface = read();
  for (const glm::dvec3& vertex : surface.vertices) {
    lowest = std::min(lowest, glm::length(vertex));
    highest = std::max(highest, glm::length(vertex));
    sum += glm::length(vertex);
  }
  EXPECT_GE(lowest, 1 - amplitude - 1e-3);
  EXPECT_LE(highest, 1 + amplitude + 1e-3);
  EXPECT_GT(highest - lowest, 0.3 * amplitude);
  // Without relief: the flat triangles are up to 9e-4 from the sphere, the rounded ones 2e-6 where normals are exact.
  // The mesh's normals, weighted by areas, lean by up to 0.012 where its triangles are uneven, which leaves 2e-4.
  settings.amplitude = 0;
  write(base, settings);
  for (const glm::dvec3& vertex : read().vertices) EXPECT_NEAR(glm::length(vertex), 1, 2e-4);
}

TEST_F(StatueTest, IsTheSameShapeAtAnyScaleAndOffset) {
  write(meshOf(sphere(3)), sized(20'000), "unit.ply");
  const Surface unit = read("unit.ply");
  for (const auto& [scale, offset] : {std::pair{1.0, 1e6}, {1e-6, 0.0}, {1e-6, 1.0}, {1e6, -1e7}}) {
    SCOPED_TRACE(fmt::format("scale {} offset {}", scale, offset));
    const glm::dvec3 shift(offset, -offset, offset / 2);
    write(meshOf(sphere(3), scale, shift), sized(20'000), "moved.ply");
    const Surface moved = read("moved.ply");
    EXPECT_EQ(moved.skipped, 0u);
    EXPECT_EQ(openEdges(moved.triangles), 0u);
    ASSERT_EQ(moved.vertices.size(), unit.vertices.size());
    for (size_t i = 0; i < unit.vertices.size(); ++i)
      ASSERT_LT(glm::length((moved.vertices[i] - shift) / scale - unit.vertices[i]), 3e-3) << i;
  }
}

TEST_F(StatueTest, NeedsNoMoreMemoryWhenItIsLarger) {
  if (kSanitized) GTEST_SKIP() << "sanitizers keep freed memory";
  const BaseMesh base = meshOf(box());
  write(base, sized(200'000));
  const uint64_t before = peakRssBytes();
  write(base, sized(4'000'000));
  // Held in memory it would be 80 MB more.
  EXPECT_LT(peakRssBytes() - before, uint64_t{60} << 20);
}

TEST_F(StatueTest, RefusesWhatMakesNoSense) {
  Progress silent(false);
  const BaseMesh base = meshOf(sphere(2));
  const auto kind = [&](const StatueSettings& settings) {
    const auto counts = writeStatue(base, settings, directory_ / "none.ply", silent);
    return counts ? ErrorKind::cancelled : counts.error().kind;
  };
  EXPECT_EQ(kind(sized(100)), ErrorKind::invalidArgument);
  EXPECT_EQ(kind(sized(9'000'000'000)), ErrorKind::unsupported);
  EXPECT_EQ(kind(sized(uint64_t{1} << 60)), ErrorKind::unsupported);
  StatueSettings loud = sized(1'000);
  loud.amplitude = 2;
  EXPECT_EQ(kind(loud), ErrorKind::invalidArgument);
  StatueSettings rough = sized(1'000);
  rough.roughness = NAN;
  EXPECT_EQ(kind(rough), ErrorKind::invalidArgument);
  EXPECT_FALSE(makeFigure(sized(kMinStatueTriangles - 1)));
  EXPECT_FALSE(writeStatue(base, sized(1'000), directory_ / "missing" / "statue.ply", silent));
  EXPECT_FALSE(BaseMeshBuilder().finish());
  EXPECT_TRUE(std::filesystem::is_empty(directory_));
}

TEST_F(StatueTest, HostileMeshesGiveFiniteStatues) {
  // Opposite faces, a needle, three triangles at one edge: normals that cancel, no inside.
  const glm::dvec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0), d(0, 0, 1), e(1e-9, 1, 0);
  const BaseMesh base = meshOf({{a, b, c}, {a, c, b}, {a, b, d}, {a, c, e}, {b, b, d}});
  EXPECT_EQ(base.triangles.size(), 4u);
  write(base, sized(3'000));
  const Surface surface = read();
  EXPECT_GT(surface.triangles.size(), 2'800u);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_GT(surface.min[axis], -0.2);
    EXPECT_LT(surface.max[axis], 1.2);
  }
}

}  // namespace
}  // namespace farcell
