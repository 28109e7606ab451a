#include "tests/bench/wscg2010/scene/cells.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "cache/base/check.h"
#include "tests/bench/wscg2010/scene/polygon.h"

namespace farcell::wscg {
namespace {

constexpr double kCubeRadius = 1.7320508075688772;  // of the bounding sphere of [-1, 1]^3

Triangle moved(const Triangle& triangle, glm::dvec3 centre, double scale) {
  Triangle result = triangle;
  for (glm::vec3& corner : result.corners) corner = glm::vec3((glm::dvec3(corner) - centre) * scale);
  return result;
}

// Ericson, Real-Time Collision Detection, 2005, 5.1.5: the point of a triangle nearest to the origin.
glm::dvec3 nearestToOrigin(const Triangle& triangle) {
  const glm::dvec3 a(triangle.corners[0]), b(triangle.corners[1]), c(triangle.corners[2]);
  const glm::dvec3 ab = b - a, ac = c - a;
  const double d1 = -glm::dot(ab, a), d2 = -glm::dot(ac, a);
  if (d1 <= 0 && d2 <= 0) return a;
  const double d3 = -glm::dot(ab, b), d4 = -glm::dot(ac, b);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
  const double d5 = -glm::dot(ab, c), d6 = -glm::dot(ac, c);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  const double sum = va + vb + vc;
  return a + ab * (vb / sum) + ac * (vc / sum);
}

bool within(const Triangle& triangle, double radius) {
  return std::all_of(triangle.corners.begin(), triangle.corners.end(),
                     [&](glm::vec3 corner) { return glm::length(glm::dvec3(corner)) <= radius; });
}

CellSoup soupOf(std::span<const Triangle> triangles) {
  CellSoup soup;
  for (const Triangle& triangle : triangles) {
    for (size_t k = 0; k < 3; ++k) {
      soup.x[k].push_back(triangle.corners[k].x);
      soup.y[k].push_back(triangle.corners[k].y);
      soup.z[k].push_back(triangle.corners[k].z);
      soup.colours[k].push_back(triangle.colours[k]);
    }
  }
  return soup;
}

}  // namespace

glm::dvec3 cellCentre(const CellKey& key) {
  return (glm::dvec3(key.x, key.y, key.z) * 2.0 + 1.0) * cellHalfSide(static_cast<int>(key.level)) - 1.0;
}

double imageRadius(int depth, Content content) {
  return kCubeRadius * cellHalfSide(depth) * (content == Content::grown ? kCellGrowth : 1.0);
}

CellIndex::CellIndex(const Scene& scene, int depth) : scene_(scene), depth_(depth), side_(1u << depth) {
  FARCELL_CHECK(depth >= 0 && depth <= kMaxDepth);
  lists_.resize(size_t{side_} * side_ * side_);
  const auto cellOf = [&](float position) {
    const double cell = std::floor((static_cast<double>(position) + 1) * 0.5 * side_);
    return static_cast<uint32_t>(std::clamp(cell, 0.0, static_cast<double>(side_ - 1)));
  };
  for (uint32_t i = 0; i < scene.triangles.size(); ++i) {
    const auto& c = scene.triangles[i].corners;
    const glm::vec3 low = glm::min(c[0], glm::min(c[1], c[2])), high = glm::max(c[0], glm::max(c[1], c[2]));
    for (uint32_t z = cellOf(low.z); z <= cellOf(high.z); ++z)
      for (uint32_t y = cellOf(low.y); y <= cellOf(high.y); ++y)
        for (uint32_t x = cellOf(low.x); x <= cellOf(high.x); ++x) lists_[at(x, y, z)].push_back(i);
  }
  for (uint32_t z = 0; z < side_; ++z)
    for (uint32_t y = 0; y < side_; ++y)
      for (uint32_t x = 0; x < side_; ++x)
        if (const CellKey key{static_cast<uint32_t>(depth), x, y, z}; !cut(key).empty()) occupied_.push_back(key);
}

size_t CellIndex::at(uint32_t x, uint32_t y, uint32_t z) const { return (size_t{z} * side_ + y) * side_ + x; }

std::vector<uint32_t> CellIndex::candidates(const CellKey& key, bool withNeighbours) const {
  if (!withNeighbours) return lists_[at(key.x, key.y, key.z)];
  const auto first = [](uint32_t i) { return i > 0 ? i - 1 : 0; };
  const auto last = [&](uint32_t i) { return std::min(i + 1, side_ - 1); };
  std::vector<uint32_t> found;
  for (uint32_t z = first(key.z); z <= last(key.z); ++z)
    for (uint32_t y = first(key.y); y <= last(key.y); ++y)
      for (uint32_t x = first(key.x); x <= last(key.x); ++x)
        found.insert(found.end(), lists_[at(x, y, z)].begin(), lists_[at(x, y, z)].end());
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

CellContent CellIndex::content(const CellKey& key, Content content) const {
  const double scale = kViewHalfExtent / imageRadius(depth_, content);
  const double half = kViewHalfExtent / kCubeRadius;  // of the cube that is cut to, whether grown or not
  const auto planes = cubePlanes(half);
  CellContent result;
  for (const uint32_t index : candidates(key, content != Content::cube)) {
    const Triangle local = moved(scene_.triangles[index], cellCentre(key), scale);
    if (content != Content::sphere) {
      appendClipped(local, planes, result.triangles);
    } else if (glm::length(nearestToOrigin(local)) <= kViewHalfExtent) {
      result.triangles.push_back(local);
    }
  }
  const auto crossing = std::stable_partition(result.triangles.begin(), result.triangles.end(),
                                              [](const Triangle& t) { return within(t, kViewHalfExtent); });
  result.insideCount = static_cast<size_t>(crossing - result.triangles.begin());
  result.soup = soupOf({result.triangles.data(), result.insideCount});
  return result;
}

std::vector<Triangle> CellIndex::cut(const CellKey& key) const {
  const auto planes = cubePlanes(cellHalfSide(depth_));
  std::vector<Triangle> parts;
  const glm::dvec3 centre = cellCentre(key);
  for (const uint32_t index : candidates(key, false))
    appendClipped(moved(scene_.triangles[index], centre, 1), planes, parts);
  for (Triangle& part : parts) part = moved(part, -centre, 1);
  return parts;
}

}  // namespace farcell::wscg
