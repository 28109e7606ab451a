#include "preprocess/choose/ground.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace farcell {
namespace {

constexpr double kNoContent = std::numeric_limits<double>::infinity();
constexpr int kColumns = 1 << kGroundLevel;

// From a value to the nearest of [low, high].
double distanceTo(double low, double high, double value) { return std::max({low - value, value - high, 0.0}); }

// The lowest sine at which somebody is seen who is at or above `ground` and at least `aside` away on the level.
double sineDown(const Standing& standing, int up, double ground, double aside) {
  const double drop = standing.centre[up] - ground;
  if (drop <= 0) return 0;
  if (!standing.leaf) {
    // Outside the sphere is at least this far from any point inside it.
    const glm::dvec3 offset = standing.centre - standing.sphereCentre;
    const double least =
        standing.sphereRadius - std::sqrt(offset.x * offset.x + offset.y * offset.y + offset.z * offset.z);
    return -drop / std::max(std::hypot(drop, aside), least);
  }
  // Not below the content: then beside or above it.
  const int east = (up + 1) % 3, north = (up + 2) % 3;
  if (drop <= standing.halfExtent[up])
    aside = std::max(aside, std::min(standing.halfExtent[east], standing.halfExtent[north]));
  return -drop / std::hypot(drop, aside);
}

}  // namespace

Ground::Ground(const Model& model, std::span<const CellRecord> cells)
    : bits_(model.grid.bits),
      up_(static_cast<int>(model.settings.up)),
      east_((up_ + 1) % 3),
      north_((up_ + 2) % 3),
      lowest_(model.bounds.empty() ? 0 : model.bounds.min[up_]) {
  for (int level = 0; level <= kGroundLevel; ++level) heights_.emplace_back(size_t{1} << 2 * level, kNoContent);
  for (const CellRecord& cell : cells)
    if (cell.childCount == 0 && !cell.content.empty()) addContent(cell.content);
  flatten();
  buildPyramid();
}

void Ground::addContent(const GridBox& content) {
  const double low = content.min[up_];
  lowest_ = std::min(lowest_, low);
  const auto columnOf = [&](int steps) { return std::clamp(steps >> (bits_ - kGroundLevel), 0, kColumns - 1); };
  for (int north = columnOf(content.min[north_]); north <= columnOf(content.max[north_]); ++north)
    for (int east = columnOf(content.min[east_]); east <= columnOf(content.max[east_]); ++east)
      at(kGroundLevel, east, north) = std::min(at(kGroundLevel, east, north), low);
}

// Each column away the surface may rise by a width's slope: two sweeps carry that everywhere (Rosenfeld and Pfaltz,
// Sequential Operations in Digital Picture Processing, 1966).
void Ground::flatten() {
  const double rise = kGroundSlope * std::ldexp(1.0, bits_ - kGroundLevel);
  const auto lower = [&](int east, int north, int eastFrom, int northFrom) {
    if (eastFrom < 0 || northFrom < 0 || eastFrom >= kColumns || northFrom >= kColumns) return;
    double& height = at(kGroundLevel, east, north);
    height = std::min(height, at(kGroundLevel, eastFrom, northFrom) + rise);
  };
  for (const int step : {1, -1})
    for (int row = 0; row < kColumns; ++row)
      for (int column = 0; column < kColumns; ++column) {
        const int east = step > 0 ? column : kColumns - 1 - column, north = step > 0 ? row : kColumns - 1 - row;
        for (int i = -1; i <= 1; ++i) lower(east, north, east + i, north - step);
        lower(east, north, east - step, north);
      }
}

void Ground::buildPyramid() {
  for (int level = kGroundLevel; level > 0; --level)
    for (int north = 0; north < 1 << level; ++north)
      for (int east = 0; east < 1 << level; ++east) {
        double& above = at(level - 1, east / 2, north / 2);
        above = std::min(above, at(level, east, north));
      }
}

double Ground::heightAt(glm::dvec3 point) const {
  const double width = std::ldexp(1.0, bits_ - kGroundLevel);
  const double east = std::floor(point[east_] / width), north = std::floor(point[north_] / width);
  if (!(east >= 0 && north >= 0 && east < kColumns && north < kColumns)) return lowest_;
  return at(kGroundLevel, static_cast<int>(east), static_cast<int>(north));
}

double Ground::lowestSine(const Standing& standing) const {
  const double side = std::ldexp(1.0, bits_);
  const double east = standing.centre[east_], north = standing.centre[north_];
  double lowest = sineDown(standing, up_, lowest_, std::min({east, side - east, north, side - north}));
  visit(standing, 0, 0, 0, lowest);
  return lowest;
}

void Ground::visit(const Standing& standing, int level, int east, int north, double& lowest) const {
  const double width = std::ldexp(1.0, bits_ - level);
  const double aside = std::hypot(distanceTo(east * width, (east + 1) * width, standing.centre[east_]),
                                  distanceTo(north * width, (north + 1) * width, standing.centre[north_]));
  const double sine = sineDown(standing, up_, at(level, east, north), aside);
  if (sine >= lowest) return;
  if (level == kGroundLevel) {
    lowest = sine;
    return;
  }
  for (int i = 0; i < 4; ++i) visit(standing, level + 1, 2 * east + (i & 1), 2 * north + (i >> 1), lowest);
}

}  // namespace farcell
