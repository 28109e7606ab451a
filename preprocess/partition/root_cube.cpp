#include "preprocess/partition/root_cube.h"

#include <algorithm>
#include <array>
#include <span>

namespace farcell {
namespace {

// Powers of the eighth root of 2.
constexpr std::array<double, 7> kSizes{1.0905, 1.1892, 1.2968, 1.4142, 1.5422, 1.6818, 1.834};

Grid enlarged(const Grid& grid, double factor) {
  Grid result = grid;
  result.side *= factor;
  result.origin -= glm::dvec3(0.5 * (result.side - grid.side));
  return result;
}

// The deepest cells that the points lie in, sorted.
std::vector<uint64_t> deepestCells(const Grid& grid, std::span<const glm::dvec3> points) {
  constexpr auto kCells = static_cast<double>(uint32_t{1} << kMaxLevel);
  std::vector<uint64_t> codes;
  codes.reserve(points.size());
  for (const glm::dvec3& point : points) {
    std::array<uint32_t, 3> cell;
    for (int axis = 0; axis < 3; ++axis)
      cell[axis] =
          static_cast<uint32_t>(std::clamp((point[axis] - grid.origin[axis]) / grid.side * kCells, 0.0, kCells - 1));
    codes.push_back(mortonCode({kMaxLevel, cell[0], cell[1], cell[2]}));
  }
  std::sort(codes.begin(), codes.end());
  return codes;
}

// Cells of a subtree whose points are these: leaves of at most mostPoints, and the cells above them.
size_t countCells(std::span<const uint64_t> codes, int level, int maxLevel, uint64_t mostPoints) {
  if (codes.empty()) return 0;
  if (codes.size() <= mostPoints || level >= maxLevel) return 1;
  const int shift = 3 * (kMaxLevel - level - 1);
  size_t cells = 1;
  while (!codes.empty()) {
    const uint64_t octant = codes.front() >> shift;
    const auto end =
        std::partition_point(codes.begin(), codes.end(), [&](uint64_t code) { return code >> shift == octant; });
    const auto size = static_cast<size_t>(end - codes.begin());
    cells += countCells(codes.first(size), level + 1, maxLevel, mostPoints);
    codes = codes.subspan(size);
  }
  return cells;
}

}  // namespace

void TriangleSample::keep(glm::dvec3 point) {
  points_.push_back(point);
  if (points_.size() < kMostPoints) return;
  for (size_t i = 0; i < kMostPoints / 2; ++i) points_[i] = points_[2 * i];
  points_.resize(kMostPoints / 2);
  stride_ *= 2;
}

Grid rootCube(const Grid& smallest, const TriangleSample& sample, const BuildSettings& settings) {
  if (settings.fixedLevel >= 0) return smallest;
  const uint64_t mostPoints = static_cast<uint64_t>(settings.leafTriangles) / sample.stride();
  const auto cells = [&](const Grid& grid) {
    return countCells(deepestCells(grid, sample.points()), 0, settings.maxLevel, mostPoints);
  };
  Grid best = smallest;
  size_t fewest = cells(smallest);
  for (const double size : kSizes) {
    if (fewest <= 1) break;
    const Grid grid = enlarged(smallest, size);
    const size_t count = cells(grid);
    if (count < fewest) best = grid, fewest = count;
  }
  return best;
}

}  // namespace farcell
