#include "preprocess/lod/parts.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

namespace farcell::lod {
namespace {

constexpr uint32_t kNone = UINT32_MAX;
// Of the cubes that keep a part each: at most this many times the root of the area that makes a part small.
constexpr double kCubeRoots = 3;
// A part grows by this many times that root on each side at most.
constexpr double kMostGrowthRoots = 1;
// Nor does it stand for more than the square of this, times its own area.
constexpr double kMostFactor = 4;
// Of the area of all parts that may go.
constexpr double kMostLost = 1.0 / 16;
constexpr int kCodeLevel = 20;
constexpr int kBisections = 30;
// Less is not worth moving places for.
constexpr double kLeastEnlargement = 1.01;

class Union {
 public:
  explicit Union(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
  uint32_t root(uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(uint32_t a, uint32_t b) {
    a = root(a), b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<uint32_t> parent_;
};

double areaOf(const WeldedMesh& mesh, const Triangle& t) {
  const glm::dvec3 a(mesh.places[t[0]]);
  return 0.5 * glm::length(glm::cross(glm::dvec3(mesh.places[t[1]]) - a, glm::dvec3(mesh.places[t[2]]) - a));
}

struct Extent {
  glm::dvec3 min{INFINITY}, max{-INFINITY};
  void include(glm::dvec3 point) { min = glm::min(min, point), max = glm::max(max, point); }
  glm::dvec3 middle() const { return 0.5 * (min + max); }
};

// In the cell's cube of 2^kCodeLevel divisions.
uint64_t codeOf(const GridBox& box, glm::dvec3 point) {
  const glm::dvec3 share = (point - glm::dvec3(box.min)) / static_cast<double>(box.max.x - box.min.x);
  const auto part = [](double value) {
    return static_cast<uint32_t>(std::clamp(value, 0.0, 0.999999) * (1 << kCodeLevel));
  };
  return mortonCode(CellKey{kCodeLevel, part(share.x), part(share.y), part(share.z)});
}

// The largest factor of a part that is this large.
double growth(double sizeSteps, double least) { return 1 + 2 * kMostGrowthRoots * std::sqrt(least) / sizeSteps; }

// The least number, of those up to `most`, for which `enough` is true; `most` where it is for none.
template <class Enough>
double leastOf(double most, const Enough& enough) {
  double low = 0, high = most;
  for (int step = 0; step < kBisections && enough(high); ++step) {
    const double middle = 0.5 * (low + high);
    (enough(middle) ? high : low) = middle;
  }
  return high;
}

}  // namespace

Parts::Parts(const WeldedMesh& mesh) : mesh_(mesh), partOf_(mesh.places.size(), kNone) {
  Union joined(mesh.places.size());
  for (const Triangle& t : mesh.triangles) joined.join(t[0], t[1]), joined.join(t[1], t[2]);
  std::vector<uint32_t> partOfRoot(mesh.places.size(), kNone);
  for (const Triangle& t : mesh.triangles) {
    uint32_t& part = partOfRoot[joined.root(t[0])];
    if (part == kNone) {
      part = static_cast<uint32_t>(areas_.size());
      areas_.push_back(0);
    }
    areas_[part] += areaOf(mesh, t);
    for (const uint32_t place : t) partOf_[place] = part;
  }
  std::vector<Extent> extents(areas_.size());
  free_.assign(areas_.size(), true);
  for (size_t place = 0; place < mesh.places.size(); ++place) {
    if (partOf_[place] == kNone) continue;
    extents[partOf_[place]].include(glm::dvec3(mesh.places[place]));
    if (mesh.faces[place] != 0) free_[partOf_[place]] = false;
  }
  for (const Extent& extent : extents) {
    sizesSteps_.push_back(glm::distance(extent.min, extent.max));
    codes_.push_back(codeOf(mesh.box, extent.middle()));
  }
  ownAreas_ = areas_;
  for (size_t part = 0; part < areas_.size(); ++part) freeArea_ += free_[part] ? areas_[part] : 0;
  anyFree_ = std::find(free_.begin(), free_.end(), true) != free_.end();
}

std::vector<float> Parts::limitsSteps(double share) const {
  std::vector<float> limits(partOf_.size());
  for (size_t place = 0; place < limits.size(); ++place)
    if (partOf_[place] != kNone) limits[place] = static_cast<float>(share * std::sqrt(areas_[partOf_[place]]));
  return limits;
}

// The free parts that are left, along the Morton curve.
std::vector<Parts::Member> Parts::freeMembers(const std::vector<Triangle>& triangles) const {
  std::vector<size_t> counts(count());
  for (const Triangle& t : triangles) ++counts[partOf_[t[0]]];
  std::vector<Member> members;
  for (uint32_t part = 0; part < counts.size(); ++part)
    if (free_[part] && counts[part] > 0) members.push_back({part, counts[part]});
  std::sort(members.begin(), members.end(), [&](const Member& a, const Member& b) {
    return std::pair(codes_[a.part], a.part) < std::pair(codes_[b.part], b.part);
  });
  return members;
}

// Visits each member of less than `least`: the member, whether it is kept, and the area that it stands for then.
// Returns the area that none stands for.
template <class Visit>
double Parts::sample(const std::vector<Member>& members, double least, int cubeLevel, const Visit& visit) const {
  const int dropped = 3 * (kCodeLevel - cubeLevel);
  double waiting = 0;  // area that none stands for yet
  for (size_t begin = 0, end = 0; begin < members.size(); begin = end) {
    const auto cubeOf = [&](size_t i) { return codes_[members[i].part] >> dropped; };
    while (end < members.size() && cubeOf(end) == cubeOf(begin)) ++end;
    const std::span<const Member> cube(members.data() + begin, members.data() + end);
    const Member* const lone = loneOf(cube, least, waiting);
    for (const Member& member : cube) {
      const double area = areas_[member.part];
      if (area >= least) continue;
      waiting += area;
      const bool kept = waiting >= least || &member == lone;
      const double factor = std::min(kMostFactor, growth(sizesSteps_[member.part], least));
      const double stands = kept ? std::min(waiting, std::max(area, factor * factor * ownAreas_[member.part])) : 0;
      visit(member, kept, stands);
      waiting -= stands;
    }
  }
  return waiting;
}

int Parts::cubeLevel(double least) const {
  const double side = mesh_.box.max.x - mesh_.box.min.x;
  const double level = std::ceil(std::log2(side / (kCubeRoots * std::sqrt(least))));
  return static_cast<int>(std::clamp(level, 0.0, double{kCodeLevel}));
}

// The largest, where otherwise none would be left.
const Parts::Member* Parts::loneOf(std::span<const Member> cube, double least, double waiting) const {
  const Member* largest = &cube.front();
  for (const Member& member : cube) {
    if (areas_[member.part] >= least) return nullptr;
    waiting += areas_[member.part];
    if (areas_[member.part] > areas_[largest->part]) largest = &member;
  }
  return waiting >= least ? nullptr : largest;
}

bool Parts::thin(Collapser& collapser, double areaSteps2, size_t target) {
  const std::vector<Member> members = freeMembers(collapser.triangles());
  double total = 0;
  for (const Member& member : members) total += areas_[member.part];
  // Whether the target is reached, or more would be lost than what is left can stand for.
  const auto enough = [&](double least, int level) {
    size_t left = collapser.triangles().size();
    const double lost = sample(members, least, level,
                               [&](const Member& member, bool kept, double) { left -= kept ? 0 : member.triangles; });
    return left <= target || lost + freeArea_ - total > kMostLost * freeArea_;
  };
  // First the grid, then, as it has few sizes, the area once more.
  const double side = mesh_.box.max.x - mesh_.box.min.x, most = std::min(areaSteps2, std::max(2 * total, side * side));
  const int level = cubeLevel(leastOf(most, [&](double least) { return enough(least, cubeLevel(least)); }));
  const double least = leastOf(most, [&](double area) { return enough(area, level); });
  std::vector<bool> taken(count());
  std::vector<double> areas = areas_;
  size_t takenNow = 0;
  sample(members, least, level, [&](const Member& member, bool kept, double sum) {
    if (kept) areas[member.part] = sum;
    taken[member.part] = !kept;
    takenNow += kept ? 0 : 1;
  });
  areas_ = std::move(areas);
  taken_ += takenNow;
  if (takenNow == 0) return false;
  leastArea_ = std::max(leastArea_, least);
  std::vector<bool> keep;
  for (const Triangle& t : collapser.triangles()) keep.push_back(!taken[partOf_[t[0]]]);
  collapser.filter(keep);
  return true;
}

std::vector<GridPoint> Parts::enlarged(const std::vector<Triangle>& triangles) const {
  std::vector<GridPoint> places = mesh_.places;
  if (!anyFree_) return places;
  std::vector<double> own(count());
  std::vector<Extent> extents(count());
  std::vector<bool> used(places.size());
  for (const Triangle& t : triangles) {
    own[partOf_[t[0]]] += areaOf(mesh_, t);
    for (const uint32_t place : t) {
      extents[partOf_[t[0]]].include(glm::dvec3(places[place]));
      used[place] = true;
    }
  }
  const glm::dvec3 low = glm::dvec3(mesh_.box.min) + 1.0, high = glm::dvec3(mesh_.box.max) - 1.0;
  for (size_t place = 0; place < places.size(); ++place) {
    if (!used[place] || !free_[partOf_[place]]) continue;
    const Extent& extent = extents[partOf_[place]];
    const glm::dvec3 size = extent.max - extent.min, room = high - low;
    const double fits = std::min({room.x / size.x, room.y / size.y, room.z / size.z});
    const double needed = std::sqrt(areas_[partOf_[place]] / own[partOf_[place]]);
    const double factor = std::min({needed, fits, growth(glm::length(size), leastArea_)});
    if (!(factor >= kLeastEnlargement)) continue;
    const glm::dvec3 middle = glm::clamp(extent.middle(), low + 0.5 * factor * size, high - 0.5 * factor * size);
    const glm::dvec3 moved = middle + (glm::dvec3(places[place]) - extent.middle()) * factor;
    places[place] = GridPoint(glm::clamp(glm::round(moved), low, high));
  }
  return places;
}

}  // namespace farcell::lod
