#include "preprocess/lod/triangle_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace farcell::lod {
namespace {

constexpr size_t kFan = 4;

double square(glm::dvec3 v) { return glm::dot(v, v); }

double squareFromSegment(glm::dvec3 p, glm::dvec3 a, glm::dvec3 b) {
  const glm::dvec3 along = b - a;
  const double length = square(along);
  const double t = length > 0 ? std::clamp(glm::dot(p - a, along) / length, 0.0, 1.0) : 0;
  return square(p - (a + along * t));
}

// The triangles along the Morton curve of their middles, of 2^kCodeBits divisions of the widest side of their box.
constexpr int kCodeBits = 10;
std::vector<uint32_t> mortonOrder(std::span<const GridPoint> places, std::span<const Triangle> triangles) {
  if (triangles.empty()) return {};
  GridBox box;
  for (const Triangle& t : triangles)
    for (const uint32_t place : t) box.include(places[place]);
  const GridPoint size = box.max - box.min;
  const int bits = std::bit_width(3 * static_cast<uint32_t>(std::max({size.x, size.y, size.z})));
  const int dropped = std::max(0, bits - kCodeBits);
  std::vector<uint64_t> sorted, buckets(triangles.size());  // code, then number
  sorted.reserve(triangles.size());
  for (const Triangle& t : triangles) {
    const glm::uvec3 sum(places[t[0]] + places[t[1]] + places[t[2]] - 3 * box.min);
    const CellKey middle{0, sum.x >> dropped, sum.y >> dropped, sum.z >> dropped};
    sorted.push_back(mortonCode(middle) << 32 | sorted.size());
  }
  for (int shift = 32; shift < 32 + 3 * kCodeBits; shift += kCodeBits) {
    std::array<uint32_t, (1 << kCodeBits) + 1> starts{};
    const auto digit = [shift](uint64_t entry) { return entry >> shift & ((1 << kCodeBits) - 1); };
    for (const uint64_t entry : sorted) ++starts[digit(entry) + 1];
    for (size_t i = 1; i < starts.size(); ++i) starts[i] += starts[i - 1];
    for (const uint64_t entry : sorted) buckets[starts[digit(entry)]++] = entry;
    std::swap(sorted, buckets);
  }
  std::vector<uint32_t> order;
  order.reserve(sorted.size());
  for (const uint64_t entry : sorted) order.push_back(static_cast<uint32_t>(entry));
  return order;
}

// Infinity where the point is beside the triangle.
double squareHeightAbove(glm::dvec3 p, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
  const glm::dvec3 ab = b - a, ac = c - a, ap = p - a;
  const glm::dvec3 normal = glm::cross(ab, ac);
  const double v = glm::dot(glm::cross(ap, ac), normal), w = glm::dot(glm::cross(ab, ap), normal);
  const double area = square(normal);
  if (!(v >= 0 && w >= 0 && v + w <= area && area > 0)) return INFINITY;
  const double height = glm::dot(ap, normal);
  return height * height / area;
}

}  // namespace

double squareDistance(glm::dvec3 p, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
  const double height = squareHeightAbove(p, a, b, c);
  if (height < INFINITY) return height;
  return std::min({squareFromSegment(p, a, b), squareFromSegment(p, b, c), squareFromSegment(p, c, a)});
}

double TriangleTree::Box::squareDistance(glm::dvec3 p) const {
  const glm::dvec3 outside = glm::max(glm::max(glm::dvec3(min) - p, p - glm::dvec3(max)), glm::dvec3(0));
  return glm::dot(outside, outside);
}

TriangleTree::TriangleTree(std::span<const GridPoint> places, std::span<const Triangle> triangles)
    : places_(places), triangles_(triangles), order_(mortonOrder(places, triangles)) {
  if (triangles_.empty()) return;
  levels_.emplace_back((triangles_.size() + kFan - 1) / kFan);
  for (size_t i = 0; i < triangles_.size(); ++i)
    for (const uint32_t place : triangles_[order_[i]]) {
      Box& box = levels_[0][i / kFan];
      box.min = glm::min(box.min, places[place]);
      box.max = glm::max(box.max, places[place]);
    }
  while (levels_.back().size() > 1) {
    const std::vector<Box>& below = levels_.back();
    std::vector<Box> above((below.size() + kFan - 1) / kFan);
    for (size_t i = 0; i < below.size(); ++i) {
      above[i / kFan].min = glm::min(above[i / kFan].min, below[i].min);
      above[i / kFan].max = glm::max(above[i / kFan].max, below[i].max);
    }
    levels_.push_back(std::move(above));
  }
}

Nearest TriangleTree::nearest(glm::dvec3 point, double known, double enough) const {
  struct Entry {
    double distance;
    uint32_t level, index;
  };
  std::array<Entry, 64> stack;  // at most kFan - 1 entries a level and the last one's
  size_t size = 0;
  Nearest best{known, 0};
  if (!levels_.empty()) stack[size++] = {0, static_cast<uint32_t>(levels_.size() - 1), 0};
  while (size > 0 && best.square > enough) {
    const Entry entry = stack[--size];
    if (entry.distance >= best.square) continue;
    const size_t begin = kFan * entry.index;
    if (entry.level == 0) {
      for (size_t i = begin; i < std::min(begin + kFan, triangles_.size()); ++i) {
        const Triangle& t = triangles_[order_[i]];
        const double square =
            squareDistance(point, glm::dvec3(places_[t[0]]), glm::dvec3(places_[t[1]]), glm::dvec3(places_[t[2]]));
        if (square < best.square) best = {square, order_[i]};
      }
      continue;
    }
    const std::vector<Box>& boxes = levels_[entry.level - 1];
    const size_t first = size;
    for (size_t i = begin; i < std::min(begin + kFan, boxes.size()); ++i) {
      const double distance = boxes[i].squareDistance(point);
      if (distance < best.square) stack[size++] = {distance, entry.level - 1, static_cast<uint32_t>(i)};
    }
    // The nearest on top.
    std::sort(stack.begin() + static_cast<ptrdiff_t>(first), stack.begin() + static_cast<ptrdiff_t>(size),
              [](const Entry& a, const Entry& b) { return a.distance > b.distance; });
  }
  return best;
}

}  // namespace farcell::lod
