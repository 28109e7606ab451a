#include "preprocess/partition/split_rule.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "cache/schema/view_frame.h"
#include "preprocess/partition/partition.h"

namespace farcell {
namespace {

double areaOf(GridPoint a, GridPoint b, GridPoint c) {
  return 0.5 * glm::length(glm::cross(glm::dvec3(b - a), glm::dvec3(c - a)));
}

}  // namespace

SplitRule::Choice SplitRule::choice(uint32_t level, uint64_t triangles) const {
  const int depth = static_cast<int>(level);
  if (settings_.fixedLevel >= 0) return depth < settings_.fixedLevel ? Choice::split : Choice::leaf;
  if (depth >= settings_.maxLevel) return Choice::leaf;
  const auto leafTriangles = static_cast<uint64_t>(settings_.leafTriangles);
  if (triangles > leafTriangles) return Choice::split;
  return triangles > leafTriangles / kFinenessShare ? Choice::byArea : Choice::leaf;
}

bool SplitRule::finerThanTexels(uint32_t level, uint64_t triangles, double areaSteps2) const {
  const double texelSteps = texelSize(settings_.form.imageSize) * 0.5 *
                            static_cast<double>(int64_t{1} << (gridBits_ - static_cast<int>(level)));
  // Texels that a view of the cell would cover: a surface shows a quarter of its area on average (Cauchy).
  const double coveredTexels = std::max(1.0, areaSteps2 / (4 * texelSteps * texelSteps));
  return static_cast<double>(triangles) > kTrianglesPerTexel * coveredTexels;
}

bool SplitRule::multiplies(uint64_t before, uint64_t after) const {
  return settings_.fixedLevel < 0 && static_cast<double>(after) > kMaxGrowth * static_cast<double>(before);
}

double areaOf(const Corners& corners) { return areaOf(corners[0], corners[1], corners[2]); }

double areaOf(const GridPolygon& polygon) {
  double sum = 0;
  for (int i = 2; i < polygon.count; ++i)
    sum += areaOf(polygon.corners[0].position, polygon.corners[i - 1].position, polygon.corners[i].position);
  return sum;
}

GridPoint middleOf(int gridBits, const CellKey& key) {
  const int shift = gridBits - static_cast<int>(key.level);
  const auto middle = [&](uint32_t cell) {
    return static_cast<int32_t>((cell << shift) + (uint32_t{1} << shift >> 1));
  };
  return GridPoint(middle(key.x), middle(key.y), middle(key.z));
}

void cutToOctants(const GridPolygon& polygon, GridPoint middle, OctantPolygons& octants) {
  const CutPolygon byX = cutAt(polygon, 0, middle.x);
  for (size_t x = 0; x < 2; ++x) {
    const CutPolygon byY = cutAt(x == 0 ? byX.low : byX.high, 1, middle.y);
    for (size_t y = 0; y < 2; ++y) {
      const CutPolygon byZ = cutAt(y == 0 ? byY.low : byY.high, 2, middle.z);
      octants[x | y << 1] = byZ.low;
      octants[x | y << 1 | 4] = byZ.high;
    }
  }
}

}  // namespace farcell
