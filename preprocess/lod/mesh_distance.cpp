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
    perB_ = glm::cross(ac_, normal) / square;
    perC_ = glm::cross(normal, ab_) / square;
  }
  // The squared distance of a point of the triangle: the nearest one where it lies above or below.
  double squareBound(glm::dvec3 point) const {
    const glm::dvec3 apart = point - a_;
    double b = std::max(0.0, glm::dot(apart, perB_)), c = std::max(0.0, glm::dot(apart, perC_));
    if (const double sum = b + c; sum > 1) b /= sum, c /= sum;
    const glm::dvec3 left = apart - ab_ * b - ac_ * c;
    return glm::dot(left, left);
  }

 private:
  glm::dvec3 a_, ab_, ac_;
  glm::dvec3 perB_, perC_;  // by how much the shares of b and c grow along a vector
};

class OneSided {
 public:
  OneSided(const Surface& from, const Surface& to, std::span<const uint32_t> nearby)
      : from_(from), to_(to), nearby_(nearby), seen_(from.places.size()) {
    rings_.build(to.triangles, to.places.size());
    facets_.reserve(to.triangles.size());
    for (const Triangle& t : to.triangles)
      facets_.emplace_back(glm::dvec3(to.places[t[0]]), glm::dvec3(to.places[t[1]]), glm::dvec3(to.places[t[2]]));
  }

  double greatest() {
    for (size_t t = 0; t < from_.triangles.size(); t += kFirstStride) lookAt(t);
    for (size_t t = 0; t < from_.triangles.size(); ++t)
      if (t % kFirstStride != 0) lookAt(t);
    refine();
    return std::sqrt(greatest_);
  }

 private:
  struct Candidate {
    double distance;
    size_t triangle;
  };

  glm::dvec3 at(uint32_t place) const { return glm::dvec3(from_.places[place]); }

  void lookAt(size_t index) {
    const Triangle& t = from_.triangles[index];
    const uint32_t a = nearby_[t[0]], b = nearby_[t[1]], c = nearby_[t[2]];
    for (const RingEdge& edge : rings_.of(a)) {
      if (edge.next != b || edge.previous != c) continue;
      last_ = edge.triangle;
      if (to_.places[a] == from_.places[t[0]] && to_.places[b] == from_.places[t[1]] &&
          to_.places[c] == from_.places[t[2]])
        return;  // both have it
      break;
    }
    sampleTriangle(index);
  }

  void sampleTriangle(size_t index) {
    const Triangle& t = from_.triangles[index];
    for (size_t k = 0; k < 3; ++k) {
      if (!seen_[t[k]]) sample(at(t[k]), index, k);
      seen_[t[k]] = true;
      if (t[k] < t[(k + 1) % 3]) sample(0.5 * (at(t[k]) + at(t[(k + 1) % 3])), index, k);
    }
    sample((at(t[0]) + at(t[1]) + at(t[2])) / 3.0, index, 0);
  }

  void sample(glm::dvec3 point, size_t index, size_t corner) {
    const double enough = kCandidateShare * greatest_;
    const double known = boundNearby(point, index, corner, enough);
    if (known <= enough) return;
    const double exact = tree().squareDistance(point, known, enough);
    if (exact <= enough) return;
    candidates_.push_back({exact, index});
    greatest_ = std::max(greatest_, exact);
  }

  // From the triangle that was near the last sample, and from those about the places that are likely near.
  double boundNearby(glm::dvec3 point, size_t index, size_t corner, double enough) {
    double known = facets_.empty() ? std::numeric_limits<double>::infinity() : facets_[last_].squareBound(point);
    const Triangle& triangle = from_.triangles[index];
    for (size_t k = 0; k < 3 && known > enough; ++k) {
      for (const RingEdge& edge : rings_.of(nearby_[triangle[(corner + k) % 3]])) {
        const double bound = facets_[edge.triangle].squareBound(point);
        if (bound >= known) continue;
        known = bound;
        last_ = edge.triangle;
        if (known <= enough) break;
      }
    }
    return known;
  }

  // Between the samples of the triangles that are farthest.
  void refine() {
    std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
      return a.distance != b.distance ? a.distance > b.distance : a.triangle < b.triangle;
    });
    if (candidates_.size() > kMostCandidates) candidates_.resize(kMostCandidates);
    for (const Candidate& candidate : candidates_)
      if (candidate.distance >= kCandidateShare * greatest_) sampleFinely(from_.triangles[candidate.triangle]);
  }

  void sampleFinely(const Triangle& t) {
    for (int i = 0; i <= kFineDivisions; ++i)
      for (int j = 0; i + j <= kFineDivisions; ++j) {
        const double u = static_cast<double>(i) / kFineDivisions, v = static_cast<double>(j) / kFineDivisions;
        const glm::dvec3 point = at(t[0]) * (1 - u - v) + at(t[1]) * u + at(t[2]) * v;
        greatest_ =
            std::max(greatest_, tree().squareDistance(point, std::numeric_limits<double>::infinity(), greatest_));
      }
  }

  const TriangleTree& tree() {
    if (!tree_) tree_.emplace(to_.places, to_.triangles);
    return *tree_;
  }

  const Surface& from_;
  const Surface& to_;
  const std::span<const uint32_t> nearby_;
  std::vector<bool> seen_;
  Rings rings_;
  std::vector<Facet> facets_;
  size_t last_ = 0;
  std::optional<TriangleTree> tree_;
  std::vector<Candidate> candidates_;
  double greatest_ = 0;
};

}  // namespace

double greatestDistanceSteps(const Surface& from, const Surface& to, std::span<const uint32_t> nearby) {
  return OneSided(from, to, nearby).greatest();
}

}  // namespace farcell::lod
