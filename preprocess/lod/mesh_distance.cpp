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

class OneSided {
 public:
  OneSided(const Surface& from, const Surface& to, std::span<const uint32_t> nearby)
      : from_(from), to_(to), nearby_(nearby), seen_(from.places.size()) {
    rings_.build(to.triangles, to.places.size());
  }

  double greatest() {
    for (size_t t = 0; t < from_.triangles.size(); t += kFirstStride) sampleTriangle(t);
    for (size_t t = 0; t < from_.triangles.size(); ++t)
      if (t % kFirstStride != 0) sampleTriangle(t);
    refine();
    return std::sqrt(greatest_);
  }

 private:
  struct Candidate {
    double distance;
    size_t triangle;
  };

  glm::dvec3 at(uint32_t place) const { return glm::dvec3(from_.places[place]); }

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
    double known = std::numeric_limits<double>::infinity();
    const Triangle& triangle = from_.triangles[index];
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t near = nearby_[triangle[(corner + k) % 3]];
      const std::span<const RingEdge> ring = rings_.of(near);
      if (ring.empty()) continue;
      const glm::dvec3 apart = point - glm::dvec3(to_.places[near]);
      known = std::min(known, glm::dot(apart, apart));
      for (size_t i = 0; i < ring.size() && known > enough; ++i) known = std::min(known, heightAbove(point, ring[i]));
      if (known <= enough) return;
    }
    const double exact = tree().squareDistance(point, known, enough);
    if (exact <= enough) return;
    candidates_.push_back({exact, index});
    greatest_ = std::max(greatest_, exact);
  }

  double heightAbove(glm::dvec3 point, const RingEdge& edge) const {
    const Triangle& t = to_.triangles[edge.triangle];
    return squareHeightAbove(point, glm::dvec3(to_.places[t[0]]), glm::dvec3(to_.places[t[1]]),
                             glm::dvec3(to_.places[t[2]]));
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
  std::optional<TriangleTree> tree_;
  std::vector<Candidate> candidates_;
  double greatest_ = 0;
};

}  // namespace

double greatestDistanceSteps(const Surface& from, const Surface& to, std::span<const uint32_t> nearby) {
  return OneSided(from, to, nearby).greatest();
}

}  // namespace farcell::lod
