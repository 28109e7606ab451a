#include "cache/schema/viewpoints.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include "cache/base/check.h"

namespace farcell {
namespace {

constexpr std::array<int, 8> kCounts = {12, 42, 162, 642, 20, 80, 320, 1280};

struct Icosphere {
  std::vector<glm::dvec3> vertices;
  std::vector<std::array<int, 3>> faces;
};

// The three golden rectangles. The axes x, y and z are two-fold symmetry axes, which keeps the set invariant under
// every sign change of the coordinates: antipodes are exact.
Icosphere icosahedron() {
  const double golden = (1.0 + std::sqrt(5.0)) / 2.0;
  const double length = std::sqrt(1.0 + golden * golden);
  const double a = 1.0 / length;
  const double b = golden / length;
  return {{{-a, b, 0},
           {a, b, 0},
           {-a, -b, 0},
           {a, -b, 0},
           {0, -a, b},
           {0, a, b},
           {0, -a, -b},
           {0, a, -b},
           {b, 0, -a},
           {b, 0, a},
           {-b, 0, -a},
           {-b, 0, a}},
          {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
           {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
           {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
}

// Sums and norms that do not depend on the order of the corners or of the axes, so that mirrored and turned faces give
// mirrored and turned points, bit for bit.
glm::dvec3 normalisedSum(std::array<glm::dvec3, 3> corners, int count) {
  glm::dvec3 sum(0);
  for (int axis = 0; axis < 3; ++axis) {
    std::array<double, 3> values{};
    for (int i = 0; i < count; ++i) values[i] = corners[i][axis];
    std::sort(values.begin(), values.begin() + count,
              [](double l, double r) { return std::abs(l) != std::abs(r) ? std::abs(l) < std::abs(r) : l < r; });
    for (int i = 0; i < count; ++i) sum[axis] += values[i];
  }
  std::array<double, 3> squares = {sum.x * sum.x, sum.y * sum.y, sum.z * sum.z};
  std::sort(squares.begin(), squares.end());
  return sum / std::sqrt(squares[0] + squares[1] + squares[2]);
}

Icosphere subdivided(const Icosphere& sphere) {
  Icosphere result{sphere.vertices, {}};
  std::map<std::pair<int, int>, int> midpoints;
  const auto midpoint = [&](int i, int j) {
    const auto [entry, added] = midpoints.try_emplace(std::minmax(i, j), static_cast<int>(result.vertices.size()));
    if (added) result.vertices.push_back(normalisedSum({sphere.vertices[i], sphere.vertices[j], {}}, 2));
    return entry->second;
  };
  for (const auto& [a, b, c] : sphere.faces) {
    const int ab = midpoint(a, b), bc = midpoint(b, c), ca = midpoint(c, a);
    result.faces.push_back({a, ab, ca});
    result.faces.push_back({ab, b, bc});
    result.faces.push_back({ca, bc, c});
    result.faces.push_back({ab, bc, ca});
  }
  return result;
}

std::vector<glm::dvec3> faceCentres(const Icosphere& sphere) {
  std::vector<glm::dvec3> centres;
  for (const auto& [a, b, c] : sphere.faces)
    centres.push_back(normalisedSum({sphere.vertices[a], sphere.vertices[b], sphere.vertices[c]}, 3));
  return centres;
}

// `direction` times a power of two, hence exact, its largest component in [0.5, 1): no product over- or underflows.
glm::dvec3 nearUnitLength(glm::dvec3 direction) {
  int exponent = 0;
  std::frexp(std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)}), &exponent);
  return {std::ldexp(direction.x, -exponent), std::ldexp(direction.y, -exponent), std::ldexp(direction.z, -exponent)};
}

// Lowest index whose dot product with `direction` (near unit length) is the largest. What lies within the rounding of
// a dot product is a tie: on the set's many symmetry planes the answer must not depend on the order of additions.
int largestDot(std::span<const glm::dvec3> directions, glm::dvec3 direction, int leftOut = -1) {
  constexpr double kTie = 2e-15;
  double largest = -INFINITY;
  const auto dotOf = [&](size_t i) {
    return static_cast<int>(i) == leftOut ? -INFINITY : glm::dot(directions[i], direction);
  };
  for (size_t i = 0; i < directions.size(); ++i) largest = std::max(largest, dotOf(i));
  size_t best = 0;
  while (best + 1 < directions.size() && dotOf(best) < largest - kTie) ++best;
  return static_cast<int>(best);
}

}  // namespace

Result<Viewpoints> Viewpoints::create(int count) {
  Icosphere sphere = icosahedron();
  std::vector<std::vector<std::array<int, 3>>> levels;
  for (int level = 0; level < 4; ++level) {
    Viewpoints set;
    levels.push_back(sphere.faces);
    if (static_cast<int>(sphere.vertices.size()) == count) {
      set.directions_ = sphere.vertices;
      set.levels_ = levels;
    } else if (static_cast<int>(sphere.faces.size()) == count) {
      set.directions_ = faceCentres(sphere);
    }
    if (!set.directions_.empty()) {
      set.pairAntipodes();
      set.groupViews();
      return set;
    }
    sphere = subdivided(sphere);
  }
  return fail(ErrorKind::invalidArgument,
              "views: expected one of 12, 42, 162, 642 (vertices) or 20, 80, 320, 1280 (face centres), found {}",
              count);
}

bool Viewpoints::exists(int count) { return std::find(kCounts.begin(), kCounts.end(), count) != kCounts.end(); }

const Viewpoints& Viewpoints::of(int count) {
  static std::array<std::once_flag, kCounts.size()> made;
  static std::array<std::optional<Viewpoints>, kCounts.size()> sets;
  const auto set = static_cast<size_t>(std::find(kCounts.begin(), kCounts.end(), count) - kCounts.begin());
  FARCELL_CHECK(set < kCounts.size());
  std::call_once(made[set], [&] { sets[set] = create(count).value(); });
  return *sets[set];
}

void Viewpoints::pairAntipodes() {
  antipodes_.resize(directions_.size());
  for (size_t i = 0; i < directions_.size(); ++i) {
    const auto opposite = std::find(directions_.begin(), directions_.end(), -directions_[i]);
    FARCELL_CHECK(opposite != directions_.end());
    antipodes_[i] = static_cast<int>(opposite - directions_.begin());
  }
}

// A group is what lies nearest to one vertex of the icosahedron; a vertex to which nothing is nearest (of 20 face
// centres, each as near to three) makes none.
void Viewpoints::groupViews() {
  const Icosphere base = icosahedron();
  std::vector<int> nearestVertex;
  std::vector<int> groupOfVertex(base.vertices.size(), -1);
  for (const glm::dvec3& direction : directions_) {
    nearestVertex.push_back(largestDot(base.vertices, direction));
    groupOfVertex[nearestVertex.back()] = 0;
  }
  groupCount_ = 0;
  for (int& group : groupOfVertex)
    if (group == 0) group = groupCount_++;
  for (const int vertex : nearestVertex) groups_.push_back(groupOfVertex[vertex]);
}

int Viewpoints::nearest(glm::dvec3 direction) const { return largestDot(directions_, nearUnitLength(direction)); }

std::array<int, 2> Viewpoints::nearestTwo(glm::dvec3 direction) const {
  const int first = nearest(direction);
  return {first, largestDot(directions_, nearUnitLength(direction), first)};
}

Viewpoints::Triple Viewpoints::nearestThree(glm::dvec3 direction) const {
  FARCELL_CHECK(hasTriangles());
  const glm::dvec3 unit = glm::normalize(nearUnitLength(direction));
  Triple best{};
  size_t first = 0, end = levels_[0].size();
  for (const auto& faces : levels_) {
    size_t hit = first;
    double bestInside = -INFINITY;
    for (size_t face = first; face < end; ++face) {
      const glm::dvec3 &a = directions_[faces[face][0]], &b = directions_[faces[face][1]],
                       &c = directions_[faces[face][2]];
      // Solve direction = wa a + wb b + wc c; the face hit is the one whose smallest weight is largest.
      const double volume = glm::dot(a, glm::cross(b, c));
      const std::array<double, 3> weights = {glm::dot(unit, glm::cross(b, c)) / volume,
                                             glm::dot(unit, glm::cross(c, a)) / volume,
                                             glm::dot(unit, glm::cross(a, b)) / volume};
      const double inside = std::min({weights[0], weights[1], weights[2]});
      if (inside > bestInside) {
        bestInside = inside;
        best = {faces[face], weights};
        hit = face;
      }
    }
    first = 4 * hit;
    end = first + 4;
  }
  double sum = 0;
  for (double& weight : best.weights) sum += weight = std::max(0.0, weight);
  for (double& weight : best.weights) weight /= sum;
  const auto before = [&](int i, int j) {
    return best.weights[i] != best.weights[j] ? best.weights[i] > best.weights[j] : best.views[i] < best.views[j];
  };
  for (const auto& [i, j] : {std::pair{0, 1}, std::pair{1, 2}, std::pair{0, 1}}) {
    if (before(j, i)) {
      std::swap(best.views[i], best.views[j]);
      std::swap(best.weights[i], best.weights[j]);
    }
  }
  return best;
}

}  // namespace farcell
