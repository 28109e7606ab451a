#include "preprocess/choose/visitable.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <numbers>
#include <utility>

namespace farcell {
namespace {

constexpr double kSlackRad = 1e-6;        // above the rounding of arc cosines
constexpr double kMaxEyeSteps = 1e30;     // as the runtime clamps the eye
constexpr int kMaxVisits = 20'000;        // boxes of one look; then all is seen
constexpr double kFinestShare = 1.0 / 8;  // of the angle between neighbouring views
constexpr double kFinestLimitRad = 0.02;
constexpr double kRadPerDeg = std::numbers::pi / 180;

double arcCosine(double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)); }

struct Cone {
  glm::dvec3 axis{0};  // unit
  double halfAngleRad = 0;
};

// Calls `candidate` for each view that may be among the nearest two of a direction in the cone.
template <class Candidate>
void forViewsNear(const Viewpoints& viewpoints, const Cone& cone, const Candidate& candidate) {
  const std::span<const glm::dvec3> directions = viewpoints.directions();
  double first = -2, second = -2;
  for (const glm::dvec3& direction : directions) {
    const double cosine = glm::dot(direction, cone.axis);
    if (cosine > first)
      second = std::exchange(first, cosine);
    else
      second = std::max(second, cosine);
  }
  const double reach = arcCosine(second) + 2 * cone.halfAngleRad + kSlackRad;
  const double least = reach >= std::numbers::pi ? -2 : std::cos(reach);
  for (size_t view = 0; view < directions.size(); ++view)
    if (glm::dot(directions[view], cone.axis) >= least) candidate(view);
}

glm::dvec3 stepsOf(const Grid& grid, glm::dvec3 point) {
  return glm::clamp((point - grid.origin) / grid.step(), glm::dvec3(-kMaxEyeSteps), glm::dvec3(kMaxEyeSteps));
}

}  // namespace

// One cell's look around.
class Visitable::Look {
 public:
  Look(const Visitable& visitable, const CellRecord& cell)
      : all_(visitable),
        standing_(standingAround(visitable.grid_, cell)),
        seen_(static_cast<size_t>(visitable.viewpoints_.count())) {}

  ViewMask run() {
    if (!all_.nodes_.empty()) visitNode(0);
    return std::move(seen_);
  }

 private:
  // Whether the runtime draws no views for an eye anywhere in the box.
  bool neverDrawn(glm::dvec3 min, glm::dvec3 max) const {
    if (standing_.leaf) {
      const glm::dvec3 low = standing_.centre - standing_.halfExtent, high = standing_.centre + standing_.halfExtent;
      return glm::all(glm::greaterThanEqual(min, low)) && glm::all(glm::lessThanEqual(max, high));
    }
    const glm::dvec3 farthest =
        glm::max(glm::abs(min - standing_.sphereCentre), glm::abs(max - standing_.sphereCentre));
    return glm::length(farthest) <= standing_.sphereRadius * (1 - 1e-12);
  }

  // The directions to points of the box; nothing where they may be any.
  static bool coneTo(glm::dvec3 centre, glm::dvec3 min, glm::dvec3 max, Cone& cone) {
    const glm::dvec3 towards = (min * 0.5 + max * 0.5) - centre;
    const double distance = glm::length(towards);
    const double radius = glm::length(max * 0.5 - min * 0.5);
    if (!(distance > radius * (1 + 1e-9))) return false;
    cone = {towards / distance, std::asin(radius / distance) + kSlackRad};
    return true;
  }

  bool nothingNew(const Cone& cone) const {
    bool found = false;
    forViewsNear(all_.viewpoints_, cone, [&](size_t view) { found = found || !seen_[view]; });
    return !found;
  }

  // Whether there is nothing more to look for.
  bool done() {
    if (++visits_ > kMaxVisits) seen_.assign(seen_.size(), true);
    return visits_ > kMaxVisits;
  }

  void visitNode(uint32_t index) {
    if (done()) return;
    const Box& node = all_.nodes_[index];
    if (node.first == 0) return visitBox(node.min, node.max);
    Cone cone;
    if (neverDrawn(node.min, node.max)) return;
    if (coneTo(standing_.centre, node.min, node.max, cone)) {
      if (nothingNew(cone)) return;
      if (cone.halfAngleRad <= all_.finestRad_) return mark(cone);
    } else if (std::find(seen_.begin(), seen_.end(), false) == seen_.end()) {
      return;
    }
    visitNode(node.first);
    visitNode(node.second);
  }

  // Directions in which a box that holds the content's centre is left are those in which it is left near the cell.
  void visitBox(glm::dvec3 min, glm::dvec3 max) {
    if (glm::all(glm::lessThanEqual(min, standing_.centre)) && glm::all(glm::lessThanEqual(standing_.centre, max))) {
      const glm::dvec3 centre = standing_.leaf ? standing_.centre : standing_.sphereCentre;
      const double extent = std::max({standing_.halfExtent.x, standing_.halfExtent.y, standing_.halfExtent.z});
      const glm::dvec3 reach =
          standing_.leaf ? standing_.halfExtent + (extent * 0.02 + 1) : glm::dvec3(standing_.sphereRadius * 1.02 + 1);
      min = glm::max(min, centre - reach);
      max = glm::min(max, centre + reach);
    }
    split(min, max);
  }

  void split(glm::dvec3 min, glm::dvec3 max) {
    if (done() || neverDrawn(min, max)) return;
    Cone cone;
    const bool isCone = coneTo(standing_.centre, min, max, cone);
    if (!isCone) cone = {glm::dvec3(0, 0, 1), std::numbers::pi};
    if (nothingNew(cone)) return;
    const glm::dvec3 extent = max - min;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const double middle = min[axis] * 0.5 + max[axis] * 0.5;
    if (cone.halfAngleRad <= all_.finestRad_ || middle == min[axis] || middle == max[axis]) return mark(cone);
    glm::dvec3 firstMax = max, secondMin = min;
    firstMax[axis] = middle;
    secondMin[axis] = middle;
    split(min, firstMax);
    split(secondMin, max);
  }

  void mark(const Cone& cone) {
    forViewsNear(all_.viewpoints_, cone, [&](size_t view) { seen_[view] = true; });
  }

  const Visitable& all_;
  const Standing standing_;
  ViewMask seen_;
  int visits_ = 0;
};

Visitable::Visitable(const Region& region, const Model& model, std::span<const CellRecord> cells,
                     const Viewpoints& viewpoints)
    : kind_(region.kind), grid_(model.grid), viewpoints_(viewpoints), ground_(model, cells) {
  double nearest = -1;  // neighbours' cosine
  for (int view = 1; view < viewpoints.count(); ++view)
    nearest = std::max(nearest, glm::dot(viewpoints.directions()[0], viewpoints.directions()[view]));
  finestRad_ = std::max(kFinestShare * arcCosine(nearest), kFinestLimitRad);
  if (kind_ == Region::Kind::aboveGround) findHighest(static_cast<int>(model.settings.up));
  std::vector<Box> boxes;
  for (const WorldBox& box : region.boxes) boxes.push_back({stepsOf(grid_, box.min), stepsOf(grid_, box.max), 0, 0});
  if (!boxes.empty()) addNode(boxes);
}

// Halves by the centres along the longest axis; of equal ones in order.
uint32_t Visitable::addNode(std::span<Box> boxes) {
  const auto index = static_cast<uint32_t>(nodes_.size());
  nodes_.push_back(boxes[0]);
  for (const Box& box : boxes) {
    nodes_[index].min = glm::min(nodes_[index].min, box.min);
    nodes_[index].max = glm::max(nodes_[index].max, box.max);
  }
  if (boxes.size() == 1) return index;
  const glm::dvec3 extent = nodes_[index].max - nodes_[index].min;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  std::stable_sort(boxes.begin(), boxes.end(), [&](const Box& l, const Box& r) {
    return l.min[axis] * 0.5 + l.max[axis] * 0.5 < r.min[axis] * 0.5 + r.max[axis] * 0.5;
  });
  const size_t half = boxes.size() / 2;
  const uint32_t first = addNode(boxes.first(half));
  const uint32_t second = addNode(boxes.subspan(half));
  nodes_[index].first = first;
  nodes_[index].second = second;
  return index;
}

// All directions in patches of a degree of elevation and of azimuth.
void Visitable::findHighest(int up) {
  highestSine_.assign(static_cast<size_t>(viewpoints_.count()), -1);
  const double halfDiagonal = std::numbers::sqrt2 * 0.5 * kRadPerDeg;
  for (int elevation = -90; elevation < 90; ++elevation) {
    const double middle = (elevation + 0.5) * kRadPerDeg;
    const double highest = std::sin((elevation + 1) * kRadPerDeg);
    for (int azimuth = 0; azimuth < 360; ++azimuth) {
      const double angle = (azimuth + 0.5) * kRadPerDeg;
      Cone cone{glm::dvec3(0), halfDiagonal};
      cone.axis[up] = std::sin(middle);
      cone.axis[(up + 1) % 3] = std::cos(middle) * std::cos(angle);
      cone.axis[(up + 2) % 3] = std::cos(middle) * std::sin(angle);
      forViewsNear(viewpoints_, cone, [&](size_t view) { highestSine_[view] = std::max(highestSine_[view], highest); });
    }
  }
}

ViewMask Visitable::seen(const CellRecord& cell) const {
  const auto views = static_cast<size_t>(viewpoints_.count());
  if (cell.content.empty()) return ViewMask(views, false);
  if (kind_ == Region::Kind::everywhere) return ViewMask(views, true);
  if (kind_ == Region::Kind::boxes) return Look(*this, cell).run();
  const double lowest = ground_.lowestSine(standingAround(grid_, cell));
  ViewMask seen(views);
  for (size_t view = 0; view < views; ++view) seen[view] = highestSine_[view] >= lowest - kSlackRad;
  return seen;
}

}  // namespace farcell
