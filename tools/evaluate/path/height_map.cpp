#include "tools/evaluate/path/height_map.h"

#include <algorithm>
#include <cmath>

#include "cache/base/interrupt.h"

namespace farcell {
namespace {

constexpr int kMostSteps = 16;  // along a triangle's edge
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr size_t kCount = size_t{HeightMap::kColumns} * HeightMap::kColumns;

// Least of each value and its neighbours along rows (stride 1) or columns (stride kColumns).
std::vector<double> leastAlong(const std::vector<double>& values, int stride) {
  std::vector<double> least(values.size(), kInfinity);
  for (int i = 0; i < static_cast<int>(kCount); ++i) {
    const int at = stride == 1 ? i % HeightMap::kColumns : i / HeightMap::kColumns;
    const int from = std::max(-HeightMap::kGroundReach, -at);
    const int to = std::min(HeightMap::kGroundReach, HeightMap::kColumns - 1 - at);
    for (int step = from; step <= to; ++step)
      least[static_cast<size_t>(i)] =
          std::min(least[static_cast<size_t>(i)], values[static_cast<size_t>(i + step * stride)]);
  }
  return least;
}

}  // namespace

HeightMap::HeightMap(const ModelFrame& model)
    : model_(model), low_(kCount, kInfinity), high_(kCount, -kInfinity), ground_(kCount, kInfinity) {
  const glm::dvec3 extent = model.max - model.min;
  const double longest = std::max(glm::dot(extent, model.east), glm::dot(extent, model.north));
  size_ = (longest > 0 ? longest : model.radius) / kColumns;
}

HeightMap::Place HeightMap::placeOf(glm::dvec3 point) const {
  const glm::dvec3 from = point - model_.min;
  return {glm::dot(from, model_.east) / size_, glm::dot(from, model_.north) / size_};
}

glm::dvec3 HeightMap::pointAt(const Place& place, double height) const {
  const glm::dvec3 floor = model_.min - model_.up * glm::dot(model_.min, model_.up);
  return floor + (model_.east * place.x + model_.north * place.y) * size_ + model_.up * height;
}

double HeightMap::valueAt(const std::vector<double>& values, const Place& place, double otherwise) const {
  if (!(place.x >= 0 && place.y >= 0 && place.x < kColumns && place.y < kColumns)) return otherwise;
  return values[static_cast<size_t>(place.y) * kColumns + static_cast<size_t>(place.x)];
}

void HeightMap::add(glm::dvec3 point) {
  const Place place = placeOf(point);
  const auto column = [](double at) { return static_cast<size_t>(std::clamp(at, 0.0, kColumns - 1.0)); };
  const size_t index = column(place.y) * kColumns + column(place.x);
  const double height = glm::dot(point, model_.up);
  low_[index] = std::min(low_[index], height);
  high_[index] = std::max(high_[index], height);
}

void HeightMap::addTriangle(const glm::dvec3 (&corners)[3]) {
  const glm::dvec3 u = corners[1] - corners[0], v = corners[2] - corners[0];
  const double reach = std::max(glm::length(u), glm::length(v));
  const int steps = std::clamp(static_cast<int>(std::ceil(reach / size_)), 1, kMostSteps);
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; i + j <= steps; ++j) add(corners[0] + (u * double(i) + v * double(j)) / double(steps));
}

void HeightMap::findGround() { ground_ = leastAlong(leastAlong(low_, 1), kColumns); }

Result<HeightMap> HeightMap::create(const PackFile& pack) {
  const Directory& directory = pack.directory();
  const Grid& grid = directory.model.grid;
  HeightMap map(modelFrame(directory.model));
  for (const CellRecord& cell : directory.cells) {
    if (cell.childCount > 0) continue;
    FARCELL_TRY(checkInterrupt());
    const GridPoint origin = cellBox(grid, cell.key).min;
    for (uint32_t part = 0; part < cell.geometryPageCount; ++part) {
      FARCELL_ASSIGN(const GeometryPage page, pack.readGeometry(cell.firstGeometryPage + part));
      const auto corner = [&](size_t i) {
        return grid.worldFromGrid(origin + GridPoint(page.positions[page.indices[i]]));
      };
      for (size_t i = 0; i + 2 < page.indices.size(); i += 3)
        map.addTriangle({corner(i), corner(i + 1), corner(i + 2)});
    }
  }
  map.findGround();
  return map;
}

}  // namespace farcell
