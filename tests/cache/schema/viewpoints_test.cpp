#include "cache/schema/viewpoints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace farcell {
namespace {

constexpr std::array kVertexSets = {12, 42, 162, 642};
constexpr std::array kFaceSets = {20, 80, 320, 1280};
constexpr std::array kAllSets = {12, 42, 162, 642, 20, 80, 320, 1280};

Viewpoints make(int count) { return Viewpoints::create(count).value(); }

// The symmetries that map axes to axes and leave the icosahedron as it is: 8 sign changes x 3 cyclic turns.
struct Symmetry {
  std::array<double, 3> signs;
  int turn;
  glm::dvec3 operator()(glm::dvec3 p) const {
    glm::dvec3 result;
    for (int axis = 0; axis < 3; ++axis) result[(axis + turn) % 3] = signs[axis] * p[axis];
    return result;
  }
};

std::vector<Symmetry> symmetries() {
  std::vector<Symmetry> all;
  for (int turn = 0; turn < 3; ++turn)
    for (int bits = 0; bits < 8; ++bits)
      all.push_back({{bits & 1 ? -1.0 : 1.0, bits & 2 ? -1.0 : 1.0, bits & 4 ? -1.0 : 1.0}, turn});
  return all;
}

long double exactDot(glm::dvec3 a, glm::dvec3 b) {
  return static_cast<long double>(a.x) * b.x + static_cast<long double>(a.y) * b.y +
         static_cast<long double>(a.z) * b.z;
}

glm::dvec3 randomUnit(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const glm::dvec3 p(normal(random), normal(random), normal(random));
  return glm::normalize(p);
}

// Axis-aligned, diagonal, at views, between two neighbours, at the middle of triangles, and random.
std::vector<glm::dvec3> awkwardAndRandomDirections(const Viewpoints& set, std::mt19937& random, int randomCount) {
  std::vector<glm::dvec3> result;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if (x != 0 || y != 0 || z != 0) result.emplace_back(x, y, z);
  for (int i = 0; i < 60; ++i) {
    const glm::dvec3 view = set.directions()[random() % set.directions().size()];
    std::vector<glm::dvec3> sorted(set.directions().begin(), set.directions().end());
    std::partial_sort(sorted.begin(), sorted.begin() + 3, sorted.end(),
                      [&](const glm::dvec3& a, const glm::dvec3& b) { return exactDot(a, view) > exactDot(b, view); });
    result.push_back(view);
    result.push_back(sorted[0] + sorted[1]);
    result.push_back(sorted[0] + sorted[1] + sorted[2]);
  }
  for (int i = 0; i < randomCount; ++i) result.push_back(randomUnit(random));
  return result;
}

TEST(Viewpoints, HaveTheNumberAskedForAndOtherNumbersAreMisuse) {
  for (const int count : kAllSets) EXPECT_EQ(make(count).count(), count);
  for (const int count : {-1, 0, 1, 13, 40, 2562, 5120}) {
    const auto set = Viewpoints::create(count);
    ASSERT_FALSE(set) << count;
    EXPECT_EQ(set.error().kind, ErrorKind::invalidArgument);
    EXPECT_NE(set.error().message.find(fmt::format("found {}", count)), std::string::npos);
  }
}

TEST(Viewpoints, AreDistinctUnitVectors) {
  for (const int count : kAllSets) {
    const Viewpoints set = make(count);
    std::set<std::array<double, 3>> distinct;
    for (const glm::dvec3& d : set.directions()) {
      EXPECT_NEAR(static_cast<double>(exactDot(d, d)), 1.0, 1e-15);
      distinct.insert({d.x, d.y, d.z});
    }
    EXPECT_EQ(distinct.size(), static_cast<size_t>(count));
  }
}

TEST(Viewpoints, AntipodesAreExactAndMutual) {
  for (const int count : kAllSets) {
    const Viewpoints set = make(count);
    for (int view = 0; view < count; ++view) {
      const int other = set.antipode(view);
      ASSERT_GE(other, 0);
      ASSERT_LT(other, count);
      ASSERT_NE(other, view);
      EXPECT_EQ(set.antipode(other), view);
      EXPECT_EQ(set.directions()[other], -set.directions()[view]) << count << " views, view " << view;
    }
  }
}

TEST(Viewpoints, EverySymmetryOfTheAxesMapsASetToItselfBitForBit) {
  for (const int count : kAllSets) {
    const Viewpoints set = make(count);
    for (const Symmetry& symmetry : symmetries())
      for (const glm::dvec3& direction : set.directions())
        ASSERT_NE(std::find(set.directions().begin(), set.directions().end(), symmetry(direction)),
                  set.directions().end())
            << count << " views";
  }
}

TEST(Viewpoints, AreSpreadEvenly) {
  // Angle from each view to its nearest neighbour. 12 and 20 are the icosahedron and the dodecahedron: known in closed
  // form.
  for (const int count : kAllSets) {
    const Viewpoints set = make(count);
    double smallest = 10, largest = 0;
    for (int i = 0; i < count; ++i) {
      double nearest = 10;
      for (int j = 0; j < count; ++j)
        if (j != i) nearest = std::min(nearest, std::acos(glm::dot(set.directions()[i], set.directions()[j])));
      smallest = std::min(smallest, nearest);
      largest = std::max(largest, nearest);
    }
    const double meanSpacing = std::sqrt(4 * M_PI / count);  // edge of a square of a view's share of the sphere
    EXPECT_GT(smallest, 0.6 * meanSpacing) << count;
    EXPECT_LT(largest, 1.2 * meanSpacing) << count;
    EXPECT_LT(largest / smallest, 1.5) << count;
    if (count == 12) {
      EXPECT_NEAR(smallest, std::acos(1 / std::sqrt(5.0)), 1e-14);
      EXPECT_NEAR(largest, smallest, 1e-14);
    }
    if (count == 20) {
      EXPECT_NEAR(smallest, std::acos(std::sqrt(5.0) / 3), 1e-14);
      EXPECT_NEAR(largest, smallest, 1e-14);
    }
  }
}

TEST(Viewpoints, NearestIsTheSmallestAngleUnderEverySymmetryAndLengthAndTheLowestIndexOnATie) {
  const unsigned seed = 4242;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  for (const int count : kAllSets) {
    const Viewpoints set = make(count);
    for (const glm::dvec3& base : awkwardAndRandomDirections(set, random, 6000 / count + 10)) {
      for (const Symmetry& symmetry : symmetries()) {
        const glm::dvec3 direction = symmetry(base);
        long double best = -INFINITY;
        for (const glm::dvec3& candidate : set.directions()) best = std::max(best, exactDot(candidate, direction));
        const int found = set.nearest(direction);
        ASSERT_GE(exactDot(set.directions()[found], direction), best - 1e-14L);
        for (int lower = 0; lower < found; ++lower)
          ASSERT_LT(exactDot(set.directions()[lower], direction), best - 2e-16L) << "a tie, and not the lowest index";
      }
    }
  }
}

TEST(Viewpoints, NearestTwoAreTheSmallestAngleAndTheNextSmallest) {
  const unsigned seed = 515;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  for (const int count : kAllSets) {
    const Viewpoints set = make(count);
    for (const glm::dvec3& direction : awkwardAndRandomDirections(set, random, 200)) {
      const std::array<int, 2> two = set.nearestTwo(direction);
      ASSERT_EQ(two[0], set.nearest(direction));
      ASSERT_NE(two[1], two[0]);
      for (int other = 0; other < count; ++other) {
        if (other != two[0]) {
          ASSERT_GE(exactDot(set.directions()[two[1]], direction),
                    exactDot(set.directions()[other], direction) - 1e-14L);
        }
      }
    }
  }
}

TEST(Viewpoints, NearestDoesNotDependOnTheLengthOfTheDirection) {
  std::mt19937 random(7);
  for (const int count : {42, 320}) {
    const Viewpoints set = make(count);
    for (const glm::dvec3& direction : awkwardAndRandomDirections(set, random, 50))
      for (const double length : {0x1p-1000, 0x1p-300, 0x1p-1, 0x1p40, 0x1p600, 0x1p1022})
        ASSERT_EQ(set.nearest(direction * length), set.nearest(direction)) << length;
  }
}

TEST(Viewpoints, NearestOfAViewIsThatView) {
  for (const int count : kAllSets) {
    const Viewpoints set = make(count);
    for (int view = 0; view < count; ++view) ASSERT_EQ(set.nearest(set.directions()[view] * 3.7), view);
  }
}

// Asserts what holds for every triple: three views, weights that are barycentric and reproduce the direction.
void expectSound(const Viewpoints& set, glm::dvec3 direction, const Viewpoints::Triple& triple) {
  glm::dvec3 sum(0);
  double weights = 0;
  for (int i = 0; i < 3; ++i) {
    ASSERT_GE(triple.views[i], 0);
    ASSERT_LT(triple.views[i], set.count());
    ASSERT_GE(triple.weights[i], 0);
    sum += triple.weights[i] * set.directions()[triple.views[i]];
    weights += triple.weights[i];
  }
  ASSERT_NEAR(weights, 1, 1e-15);
  ASSERT_GE(triple.weights[0], triple.weights[1]);
  ASSERT_GE(triple.weights[1], triple.weights[2]);
  ASSERT_EQ((std::set<int>(triple.views.begin(), triple.views.end()).size()), 3u);
  const glm::dvec3 unit = glm::normalize(direction);
  ASSERT_LT(glm::length(glm::normalize(sum) - unit), 1e-12);
  // The three are neighbours, not some large triangle that also holds the direction.
  const double spacing = std::sqrt(4 * M_PI / set.count());
  for (const int view : triple.views)
    ASSERT_LT(std::acos(std::clamp(glm::dot(set.directions()[view], unit), -1.0, 1.0)), 1.35 * spacing);
}

TEST(Viewpoints, TheNearestThreeReproduceTheDirectionUnderEverySymmetry) {
  const unsigned seed = 777;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  for (const int count : kVertexSets) {
    const Viewpoints set = make(count);
    for (const glm::dvec3& base : awkwardAndRandomDirections(set, random, 2000 / count + 5))
      for (const Symmetry& symmetry : symmetries())
        ASSERT_NO_FATAL_FAILURE(expectSound(set, symmetry(base), set.nearestThree(symmetry(base))));
  }
}

// All triples of views that are mutual neighbours: an icosphere's edges are far shorter than its other distances.
std::vector<std::array<int, 3>> trianglesByDistance(const Viewpoints& set) {
  const auto directions = set.directions();
  long double nearest = -1;
  for (int view = 1; view < set.count(); ++view) nearest = std::max(nearest, exactDot(directions[0], directions[view]));
  const long double longest = std::cos(1.4L * std::acos(nearest));
  const auto neighbours = [&](int i, int j) { return exactDot(directions[i], directions[j]) > longest; };
  std::vector<std::array<int, 3>> result;
  for (int a = 0; a < set.count(); ++a)
    for (int b = a + 1; b < set.count(); ++b)
      for (int c = neighbours(a, b) ? b + 1 : set.count(); c < set.count(); ++c)
        if (neighbours(a, c) && neighbours(b, c)) result.push_back({a, b, c});
  return result;
}

TEST(Viewpoints, TheTriangleOfADirectionIsTheOneOfAllWhoseThreeSidesItLiesWithin) {
  const unsigned seed = 2024;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  for (const int count : kVertexSets) {
    const Viewpoints set = make(count);
    const auto triangles = trianglesByDistance(set);
    ASSERT_EQ(triangles.size(), static_cast<size_t>(2 * count - 4)) << "Euler";
    for (int i = 0; i < 200; ++i) {
      const glm::dvec3 direction = randomUnit(random);
      int holding = 0;
      for (const auto& [a, b, c] : triangles) {
        const auto side = [&](int from, int to, int opposite) {
          const glm::dvec3 normal = glm::cross(set.directions()[from], set.directions()[to]);
          return exactDot(normal, direction) * exactDot(normal, set.directions()[opposite]);
        };
        if (glm::dot(set.directions()[a], direction) < 0 || side(a, b, c) < 0 || side(b, c, a) < 0 || side(c, a, b) < 0)
          continue;
        ++holding;
        auto views = set.nearestThree(direction).views;
        std::sort(views.begin(), views.end());
        EXPECT_EQ(views, (std::array<int, 3>{a, b, c})) << count;
      }
      EXPECT_EQ(holding, 1) << count;
    }
  }
}

TEST(Viewpoints, TheNearestOfTheThreeIsTheNearestView) {
  // Holds exactly for equilateral triangles, the icosahedron's; elsewhere weight and angle may disagree near bisectors.
  std::mt19937 random(5);
  const Viewpoints set = make(12);
  for (int i = 0; i < 3000; ++i) {
    const glm::dvec3 direction = randomUnit(random);
    const auto triple = set.nearestThree(direction);
    if (triple.weights[0] - triple.weights[1] > 1e-12) {
      ASSERT_EQ(triple.views[0], set.nearest(direction));
    }
  }
}

TEST(Viewpoints, AtAViewItsWeightIsOne) {
  for (const int count : kVertexSets) {
    const Viewpoints set = make(count);
    for (int view = 0; view < count; ++view) {
      const auto triple = set.nearestThree(set.directions()[view] * 0.01);
      ASSERT_EQ(triple.views[0], view);
      ASSERT_NEAR(triple.weights[0], 1, 1e-14);
    }
  }
}

TEST(Viewpoints, OnAnEdgeTheThirdWeightIsZero) {
  std::mt19937 random(99);
  std::uniform_real_distribution<double> share(0.01, 0.99);
  for (const int count : kVertexSets) {
    const Viewpoints set = make(count);
    for (int i = 0; i < 300; ++i) {
      // The two heaviest views of any triple are the ends of an edge of its triangle.
      const auto triangle = set.nearestThree(randomUnit(random));
      const double t = share(random);
      const glm::dvec3 onEdge = (1 - t) * set.directions()[triangle.views[0]] + t * set.directions()[triangle.views[1]];
      const auto triple = set.nearestThree(onEdge);
      ASSERT_NEAR(triple.weights[2], 0, 1e-14);
      const std::set<int> ends = {triangle.views[0], triangle.views[1]};
      ASSERT_EQ((std::set<int>{triple.views[0], triple.views[1]}), ends);
      ASSERT_NEAR(triple.weights[triple.views[0] == triangle.views[0] ? 0 : 1], 1 - t, 1e-13);
    }
  }
}

std::map<int, double> weightOfView(const Viewpoints::Triple& triple) {
  std::map<int, double> result;
  for (int i = 0; i < 3; ++i) result[triple.views[i]] += triple.weights[i];
  return result;
}

TEST(Viewpoints, ATinyTurnOfTheDirectionChangesTheWeightsATinyBit) {
  const unsigned seed = 31;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  constexpr double kTurnRad = 1e-9;
  for (const int count : kVertexSets) {
    const Viewpoints set = make(count);
    const double spacing = std::sqrt(4 * M_PI / count);
    for (const glm::dvec3& raw : awkwardAndRandomDirections(set, random, 200)) {
      const glm::dvec3 direction = glm::normalize(raw);
      auto before = weightOfView(set.nearestThree(direction));
      auto after = weightOfView(set.nearestThree(direction + kTurnRad * randomUnit(random)));
      for (const auto& [view, weight] : before) ASSERT_NEAR(after[view], weight, 4 * kTurnRad / spacing);
      for (const auto& [view, weight] : after) ASSERT_NEAR(before[view], weight, 4 * kTurnRad / spacing);
    }
  }
}

TEST(Viewpoints, OnlyVertexSetsHaveTriangles) {
  for (const int count : kVertexSets) EXPECT_TRUE(make(count).hasTriangles());
  for (const int count : kFaceSets) EXPECT_FALSE(make(count).hasTriangles());
}

TEST(ViewpointsDeathTest, AskingAFaceSetForThreeIsABrokenPromise) {
  EXPECT_DEATH(make(20).nearestThree({0, 0, 1}), "hasTriangles");
}

TEST(Viewpoints, EveryGroupHoldsViewsThatLieTogether) {
  for (const int count : kAllSets) {
    const Viewpoints set = make(count);
    std::map<int, std::vector<int>> members;
    for (int view = 0; view < count; ++view) {
      ASSERT_GE(set.group(view), 0);
      ASSERT_LT(set.group(view), set.groupCount());
      members[set.group(view)].push_back(view);
    }
    EXPECT_EQ(members.size(), static_cast<size_t>(set.groupCount())) << count;
    EXPECT_LE(set.groupCount(), 12);
    // Around a vertex of the icosahedron: at most its circumscribed radius, 37.4 degrees, from the vertex.
    for (const auto& [group, views] : members)
      for (const int a : views)
        for (const int b : views)
          ASSERT_GT(glm::dot(set.directions()[a], set.directions()[b]), std::cos(2 * 37.4 * M_PI / 180)) << count;
  }
}

}  // namespace
}  // namespace farcell
