#include "preprocess/lod/seams.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <tuple>

namespace farcell::lod {
namespace {

// A corner that was rounded to the grid is this near to the edge it was cut from, in steps: half of one along each
// axis, and as much again for the ends of the edge.
constexpr double kRoundingSteps = 1.75;

struct HalfEdge {
  uint32_t from, to;
  uint32_t fromVertex, toVertex;
  auto key() const { return std::tuple(std::min(from, to), std::max(from, to), from); }
};

std::vector<HalfEdge> edgesBetweenChildren(const WeldedMesh& mesh) {
  const GridPoint middle = (mesh.box.min + mesh.box.max) / 2;
  std::vector<uint8_t> planes(mesh.places.size());
  for (size_t i = 0; i < planes.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      planes[i] = static_cast<uint8_t>(planes[i] | (mesh.places[i][axis] == middle[axis] ? 1 << axis : 0));
  std::vector<HalfEdge> edges;
  for (size_t t = 0; t < mesh.triangles.size(); ++t)
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t from = mesh.triangles[t][k], to = mesh.triangles[t][(k + 1) % 3];
      if ((planes[from] & planes[to]) != 0 && (mesh.faces[from] & mesh.faces[to]) == 0)
        edges.push_back({from, to, mesh.corners[t][k], mesh.corners[t][(k + 1) % 3]});
    }
  return edges;
}

// Those without an opposite, by their first place.
std::vector<HalfEdge> openOnes(std::vector<HalfEdge> edges) {
  std::stable_sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) { return a.key() < b.key(); });
  std::vector<HalfEdge> open;
  const auto same = [](const HalfEdge& a, const HalfEdge& b) {
    return std::minmax(a.from, a.to) == std::minmax(b.from, b.to);
  };
  for (size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    int64_t sum = 0;  // of those that run upwards less those that run downwards
    for (end = begin; end < edges.size() && same(edges[begin], edges[end]); ++end)
      sum += edges[end].from < edges[end].to ? 1 : -1;
    for (size_t i = begin; i < end && sum != 0; ++i) {
      const int direction = edges[i].from < edges[i].to ? 1 : -1;
      if (direction * sum <= 0) continue;
      open.push_back(edges[i]);
      sum -= direction;
    }
  }
  std::stable_sort(open.begin(), open.end(), [](const HalfEdge& a, const HalfEdge& b) { return a.from < b.from; });
  return open;
}

class SlitCloser {
 public:
  explicit SlitCloser(WeldedMesh& mesh)
      : mesh_(mesh), open_(openOnes(edgesBetweenChildren(mesh))), used_(open_.size()) {}

  void close() {
    std::vector<size_t> longestFirst(open_.size());
    for (size_t i = 0; i < open_.size(); ++i) longestFirst[i] = i;
    std::stable_sort(longestFirst.begin(), longestFirst.end(),
                     [&](size_t a, size_t b) { return length(open_[a]) > length(open_[b]); });
    for (const size_t edge : longestFirst) {
      if (used_[edge]) continue;
      const std::vector<size_t> chain = chainBack(open_[edge]);
      if (!chain.empty()) fill(edge, chain);
    }
  }

 private:
  glm::dvec3 at(uint32_t place) const { return glm::dvec3(mesh_.places[place]); }
  double length(const HalfEdge& edge) const { return glm::distance(at(edge.from), at(edge.to)); }

  // Shorter edges that lead from the end of `edge` back to its start along it; empty when there are none.
  std::vector<size_t> chainBack(const HalfEdge& edge) const {
    const glm::dvec3 start = at(edge.from);
    const double whole = length(edge);
    const glm::dvec3 along = (at(edge.to) - start) / whole;
    std::vector<size_t> chain;
    double reached = whole;
    for (uint32_t place = edge.to; place != edge.from;) {
      const size_t next = nextAlong(place, start, along, reached);
      if (next == open_.size()) return {};
      chain.push_back(next);
      place = open_[next].to;
      reached = glm::dot(at(place) - start, along);
    }
    return chain;
  }

  size_t nextAlong(uint32_t place, glm::dvec3 start, glm::dvec3 along, double reached) const {
    auto at0 = std::lower_bound(open_.begin(), open_.end(), place,
                                [](const HalfEdge& edge, uint32_t from) { return edge.from < from; });
    for (; at0 != open_.end() && at0->from == place; ++at0) {
      const size_t index = static_cast<size_t>(at0 - open_.begin());
      const glm::dvec3 from = at(at0->to) - start;
      const double position = glm::dot(from, along);
      if (used_[index] || position >= reached || position < -kRoundingSteps) continue;
      if (glm::distance(from, position * along) <= kRoundingSteps) return index;
    }
    return open_.size();
  }

  // A fan about the start of the edge; each of its outer edges is the opposite of an open one.
  void fill(size_t edge, const std::vector<size_t>& chain) {
    used_[edge] = true;
    for (const size_t link : chain) used_[link] = true;
    const HalfEdge& whole = open_[edge];
    for (size_t i = 0; i + 1 < chain.size(); ++i) {
      const HalfEdge& link = open_[chain[i]];
      mesh_.triangles.push_back({whole.from, link.to, link.from});
      mesh_.corners.push_back({whole.fromVertex, link.toVertex, link.fromVertex});
      mesh_.shown.push_back(kAsCorners);
    }
  }

  WeldedMesh& mesh_;
  const std::vector<HalfEdge> open_;  // by their first place
  std::vector<bool> used_;
};

}  // namespace

void closeSeams(WeldedMesh& mesh) { SlitCloser(mesh).close(); }

}  // namespace farcell::lod
