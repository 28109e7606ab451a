#include "tools/evaluate/path/street.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/evaluate/path/height_map.h"
#include "tools/evaluate/path/random.h"

namespace farcell {
namespace {

constexpr int kCandidates = 4096;
constexpr int kBeside = 6;  // columns
constexpr double kStreetFovYRad = std::numbers::pi / 3;

// A line on the map, walked from its start.
struct Line {
  HeightMap::Place start;
  double dx = 1, dy = 0;  // unit
  double columns = 1;     // length

  HeightMap::Place at(double along, double aside) const {
    return {start.x + dx * along - dy * aside, start.y + dy * along + dx * aside};
  }
};

Line candidate(const HeightMap& map, double columns, std::mt19937& random) {
  const HeightMap::Place far = map.placeOf(map.model().max);
  const double angle = drawn(random, 0, 2 * std::numbers::pi), x = drawn(random, 0, far.x), y = drawn(random, 0, far.y);
  return {{x, y}, std::cos(angle), std::sin(angle), columns};
}

// Above all ground along the line; infinite where it leaves the model.
double eyeHeight(const HeightMap& map, const Line& line, double aboveGround) {
  double ground = -std::numeric_limits<double>::infinity();
  for (double along = 0; along <= line.columns; along += 0.5)
    ground = std::max(ground, map.groundAt(line.at(along, 0)));
  return ground + aboveGround;
}

// The less the better: what stands in the way weighs more than all that may stand beside it.
double cost(const HeightMap& map, const Line& line, double aboveGround) {
  const double eye = eyeHeight(map, line, aboveGround);
  if (!std::isfinite(eye)) return std::numeric_limits<double>::infinity();
  double total = 0;
  for (double along = 0; along <= line.columns; along += 0.5)
    for (int aside = -kBeside; aside <= kBeside; ++aside) {
      const bool stands = map.topAt(line.at(along, aside)) > eye;
      if (stands) total += aside == 0 ? 2 * kBeside + 1 : -1;
    }
  return total;
}

Line bestLine(const HeightMap& map, double columns, double aboveGround, std::mt19937& random) {
  Line best = candidate(map, columns, random);
  double least = cost(map, best, aboveGround);
  for (int i = 1; i < kCandidates; ++i) {
    const Line line = candidate(map, columns, random);
    const double own = cost(map, line, aboveGround);
    if (own < least) {
      least = own;
      best = line;
    }
  }
  return best;
}

}  // namespace

Result<std::vector<Camera>> streetPath(const PackFile& pack, int count, std::mt19937& random) {
  FARCELL_ASSIGN(const HeightMap map, HeightMap::create(pack));
  const ModelFrame& model = map.model();
  const glm::dvec3 extent = model.max - model.min;
  const double diagonal = std::max(glm::length(extent - model.up * glm::dot(extent, model.up)), model.radius / 100);
  const double columns = (count - 1) * kStreetStep * diagonal / map.columnSize();
  const Line line = bestLine(map, columns, kStreetEyeHeight * diagonal, random);
  double height = eyeHeight(map, line, kStreetEyeHeight * diagonal);
  if (!std::isfinite(height)) height = glm::dot(model.centre, model.up);
  std::vector<Camera> frames;
  for (int frame = 0; frame < count; ++frame) {
    const double along = columns * frame / (count - 1);
    frames.push_back({fmt::format("frame {}", frame), map.pointAt(line.at(along, 0), height),
                      map.pointAt(line.at(along + columns, 0), height), model.up, kStreetFovYRad});
  }
  return frames;
}

}  // namespace farcell
