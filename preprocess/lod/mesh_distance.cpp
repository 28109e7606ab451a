#include "preprocess/lod/mesh_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "preprocess/lod/rings.h"
#include "preprocess/lod/triangle_tree.h"

namespace farcell::lod {
namespace {

constexpr uint32_t kNone = UINT32_MAX;
// Of the greatest distance, squared: triangles with a sample this far are looked at more closely.
constexpr double kCandidateShare = 0.8;
constexpr size_t kMostCandidates = 128;
constexpr int kFineDivisions = 8;
// A first look at every n-th triangle finds most of the greatest distance; then nearly every sample is known to be
// nearer by the first triangle tried.
constexpr size_t kFirstStride = 61;

// A triangle prepared to bound distances from it.
class Facet {
 public:
  Facet(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) : a_(a), ab_(b - a), ac_(c - a), perB_(0), perC_(0) {
    const glm::dvec3 normal = glm::cross(ab_, ac_);
    const double square = glm::dot(normal, normal);
    if (!(square > 0)) return;
    const double inverse = 1 / square;
    perB_ = glm::cross(ac_, normal) * inverse;
    perC_ = glm::cross(normal, ab_) * inverse;
  }
  // The squared distance of a point of the triangle: the nearest one where it lies above or below.
  double squareBound(glm::dvec3 point) const {
    const glm::dvec3 apart = point - a_;
    double b = std::max(0.0, glm::dot(apart, perB_)), c = std::max(0.0, glm::dot(apart, perC_));
    const double sum = std::max(1.0, b + c);
    const double inverse = 1 / sum;
    const glm::dvec3 left = apart - ab_ * (b * inverse) - ac_ * (c * inverse);
    return glm::dot(left, left);
  }

 private:
  glm::dvec3 a_, ab_, ac_;
  glm::dvec3 perB_, perC_;  // by how much the shares of b and c grow along a vector
};

class OneSided {
 public:
  // Both have triangles.
  OneSided(const Surface& from, const Surface& to, std::span<const uint32_t> nearby, double known)
      : from_(from), to_(to), nearby_(nearby), seen_(from.places.size()), last_(facet(0)), greatest_(known * known) {
    rings_.build(to.triangles, to.places.size());
  }

  double greatest() {
    for (size_t t = 0; t < from_.triangles.size(); t += kFirstStride) sampleTriangle(t);
    for (size_t t = 0; t < from_.triangles.size(); ++t)
      if (t % kFirstStride != 0 && !near(from_.triangles[t])) sampleTriangle(t);
    refine();
    return std::sqrt(greatest_);
  }

 private:
  struct Candidate {
    double distance;
    size_t triangle;
  };

  glm::dvec3 at(uint32_t place) const { return glm::dvec3(from_.places[place]); }
  Facet facet(uint32_t index) const {
    const Triangle& t = to_.triangles[index];
    return {glm::dvec3(to_.places[t[0]]), glm::dvec3(to_.places[t[1]]), glm::dvec3(to_.places[t[2]])};
  }
  double enough() const { return kCandidateShare * greatest_; }

  // Whether all of a triangle is near enough: both meshes have it, or its corners are near one and the same triangle. A
  // distance from what is convex is convex, so no point between the corners is farther than they are.
  bool near(const Triangle& t) {
    if (const uint32_t image = imageOf(t); image != kNone) {
      last_ = facet(image);
      if (isItsOwnImage(t)) return true;
    }
    return last_.squareBound(at(t[0])) <= enough() && last_.squareBound(at(t[1])) <= enough() &&
           last_.squareBound(at(t[2])) <= enough();
  }

  // The triangle between the places that are likely near.
  uint32_t imageOf(const Triangle& t) const {
    const uint32_t a = nearby_[t[0]], b = nearby_[t[1]], c = nearby_[t[2]];
    if (a == b || b == c || c == a) return kNone;
    for (const RingEdge& edge : rings_.of(a))
      if (edge.next == b && edge.previous == c) return edge.triangle;
    return kNone;
  }

  bool isItsOwnImage(const Triangle& t) const {
    for (const uint32_t place : t)
      if (to_.places[nearby_[place]] != from_.places[place]) return false;
    return true;
  }

  void sampleTriangle(size_t index) {
    const Triangle& t = from_.triangles[index];
    for (size_t k = 0; k < 3; ++k) {
      if (!seen_[t[k]]) sample(at(t[k]), index, k);
      seen_[t[k]] = true;
    }
    for (size_t k = 0; k < 3; ++k)
      if (t[k] < t[(k + 1) % 3]) sample(0.5 * (at(t[k]) + at(t[(k + 1) % 3])), index, k);
    sample((at(t[0]) + at(t[1]) + at(t[2])) / 3.0, index, 0);
  }

  void sample(glm::dvec3 point, size_t index, size_t corner) {
    const double exact = squareDistance(point, index, corner, enough());
    if (exact <= enough()) return;
    candidates_.push_back({exact, index});
    greatest_ = std::max(greatest_, exact);
  }

  // Of a point near a corner of a triangle; any that is at most `enough` will do. First tried is the triangle that was
  // near the last one, then those about places that are near.
  double squareDistance(glm::dvec3 point, size_t index, size_t corner, double enough) {
    double known = last_.squareBound(point);
    const Triangle& t = from_.triangles[index];
    if (known > enough) lookAbout(nearestPlace(point, nearby_[t[corner]]), point, enough, known);
    for (size_t k = 0; k < 3 && known > enough; ++k) lookAbout(nearby_[t[(corner + k) % 3]], point, enough, known);
    if (known <= enough) return known;
    const Nearest nearest = tree().nearest(point, known, enough);
    if (nearest.square < known) last_ = facet(nearest.triangle);
    return std::min(known, nearest.square);
  }

  void lookAbout(uint32_t place, glm::dvec3 point, double enough, double& known) {
    for (const RingEdge& edge : rings_.of(place)) {
      const Facet tried = facet(edge.triangle);
      const double bound = tried.squareBound(point);
      if (bound >= known) continue;
      known = bound;
      last_ = tried;
      if (bound <= enough) return;
    }
  }

  // From neighbour to neighbour while they are nearer.
  uint32_t nearestPlace(glm::dvec3 point, uint32_t place) const {
    double least = apartSquare(point, place);
    for (uint32_t last = kNone; last != place;) {
      last = place;
      for (const RingEdge& edge : rings_.of(last)) {
        const double square = apartSquare(point, edge.next);
        if (square < least) least = square, place = edge.next;
      }
    }
    return place;
  }
  double apartSquare(glm::dvec3 point, uint32_t place) const {
    const glm::dvec3 apart = point - glm::dvec3(to_.places[place]);
    return glm::dot(apart, apart);
  }

  // Between the samples of the triangles that are farthest.
  void refine() {
    std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
      return a.distance != b.distance ? a.distance > b.distance : a.triangle < b.triangle;
    });
    if (candidates_.size() > kMostCandidates) candidates_.resize(kMostCandidates);
    std::vector<size_t> triangles;
    for (const Candidate& candidate : candidates_)
      if (candidate.distance >= enough()) triangles.push_back(candidate.triangle);
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    for (const size_t triangle : triangles) sampleFinely(triangle);
  }

  void sampleFinely(size_t index) {
    const Triangle& t = from_.triangles[index];
    for (int i = 0; i <= kFineDivisions; ++i)
      for (int j = 0; i + j <= kFineDivisions; ++j) {
        const double u = static_cast<double>(i) / kFineDivisions, v = static_cast<double>(j) / kFineDivisions;
        const glm::dvec3 point = at(t[0]) * (1 - u - v) + at(t[1]) * u + at(t[2]) * v;
        greatest_ = std::max(greatest_, squareDistance(point, index, 0, greatest_));
      }
  }

  const TriangleTree& tree() {
    if (!tree_) tree_.emplace(to_.places, to_.triangles);
    return *tree_;
  }

  const Surface& from_;
  const Surface& to_;
  const std::span<const uint32_t> nearby_;
  std::vector<bool> seen_;  // of a place
  Rings rings_;
  Facet last_;  // near the last sample
  std::optional<TriangleTree> tree_;
  std::vector<Candidate> candidates_;
  double greatest_;
};

}  // namespace

double greatestDistanceSteps(const Surface& from, const Surface& to, std::span<const uint32_t> nearby,
                             double knownSteps) {
  if (from.triangles.empty()) return knownSteps;
  if (to.triangles.empty()) return std::numeric_limits<double>::infinity();
  return OneSided(from, to, nearby, knownSteps).greatest();
}

}  // namespace farcell::lod
