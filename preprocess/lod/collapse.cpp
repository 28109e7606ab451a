#include "preprocess/lod/collapse.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace farcell::lod {
namespace {

// An open border is worth as much as a wall of this many times its square.
constexpr double kBorderWeight = 10;
// So is an edge at which colours or normals break, worth less than the surface's shape.
constexpr double kBreakWeight = 1;
// Prefers short edges where all errors are alike, as in a plane.
constexpr double kLengthWeight = 1e-6;
// A triangle may turn by about 80 degrees at most.
constexpr double kLeastTurn = 0.17;
// A pass takes edges of up to this many times the cost at which it would just reach its target.
constexpr float kPassSlack = 1.5f;
// But it takes at least one in so many of what has to go, and of all triangles: else the last few would need many
// passes.
constexpr size_t kLeastShareOfGoal = 8;
constexpr size_t kLeastShareOfAll = 64;

glm::dvec3 crossOf(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) { return glm::cross(b - a, c - a); }

bool turns(glm::dvec3 before, glm::dvec3 after) {
  const double cosine = glm::dot(before, after);
  const double lengths = glm::dot(before, before) * glm::dot(after, after);
  return lengths == 0 ? glm::dot(before, before) > 0
                      : cosine <= 0 || cosine * cosine < kLeastTurn * kLeastTurn * lengths;
}

}  // namespace

Collapser::Collapser(const WeldedMesh& mesh)
    : mesh_(mesh),
      scale_(2.0 / (mesh.box.max.x - mesh.box.min.x)),
      quadrics_(mesh.places.size()),
      open_(mesh.places.size()),
      breaks_(mesh.places.size()),
      triangles_(mesh.triangles),
      target_(mesh.places.size()) {
  const glm::dvec3 centre = 0.5 * (glm::dvec3(mesh.box.min) + glm::dvec3(mesh.box.max));
  positions_.reserve(mesh.places.size());
  for (const GridPoint& place : mesh.places) positions_.push_back((glm::dvec3(place) - centre) * scale_);
  for (uint32_t i = 0; i < target_.size(); ++i) target_[i] = i;
  for (uint32_t i = 0; i < triangles_.size(); ++i) origins_.push_back(i);
  rings_.build(triangles_, mesh.places.size());
  addSurfaceQuadrics();
  addEdgeQuadrics();
}

void Collapser::addSurfaceQuadrics() {
  for (const Triangle& t : triangles_) {
    const glm::dvec3 cross = crossOf(positions_[t[0]], positions_[t[1]], positions_[t[2]]);
    const double area = glm::length(cross);
    if (!(area > 0)) continue;
    const Quadric quadric = planeQuadric(cross / area, positions_[t[0]], area);
    for (const uint32_t place : t) quadrics_[place].add(quadric);
  }
}

// A plane at right angles to the triangle through each of its edges where the surface ends, or its colour or normal
// breaks.
void Collapser::addEdgeQuadrics() {
  std::vector<uint32_t> vertices(mesh_.places.size());
  for (const uint32_t place : mesh_.placeOfVertex) ++vertices[place];
  for (size_t place = 0; place < vertices.size(); ++place) breaks_[place] = vertices[place] > 1;
  for (uint32_t t = 0; t < triangles_.size(); ++t) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = triangles_[t][k], b = triangles_[t][(k + 1) % 3];
      if ((mesh_.faces[a] & mesh_.faces[b]) != 0) continue;
      const RingEdge* opposite = edgeFrom(b, a);
      if (opposite == nullptr) open_[a] = open_[b] = true;
      if (opposite == nullptr)
        addEdgeQuadric(triangles_[t], k, kBorderWeight);
      else if (breaks_[a] && breaks_[b] && breaksBetween(t, opposite->triangle, a, b))
        addEdgeQuadric(triangles_[t], k, kBreakWeight);
    }
  }
}

const RingEdge* Collapser::edgeFrom(uint32_t from, uint32_t to) const {
  for (const RingEdge& edge : rings_.of(from))
    if (edge.next == to) return &edge;
  return nullptr;
}

bool Collapser::breaksBetween(uint32_t one, uint32_t other, uint32_t a, uint32_t b) const {
  const auto vertexAt = [&](uint32_t triangle, uint32_t place) {
    const Triangle& t = mesh_.triangles[triangle];
    return mesh_.corners[triangle][t[0] == place ? 0 : t[1] == place ? 1 : 2];
  };
  return vertexAt(one, a) != vertexAt(other, a) || vertexAt(one, b) != vertexAt(other, b);
}

void Collapser::addEdgeQuadric(const Triangle& t, size_t k, double weight) {
  const uint32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
  const glm::dvec3 along = positions_[b] - positions_[a];
  const double square = glm::dot(along, along);
  const glm::dvec3 across = positions_[c] - positions_[a];
  const glm::dvec3 normal = across - along * (glm::dot(across, along) / square);
  const double length = glm::length(normal);
  if (!(length > 0)) return;
  const Quadric quadric = planeQuadric(normal / length, positions_[a], square * weight);
  quadrics_[a].add(quadric);
  quadrics_[b].add(quadric);
}

double Collapser::errorSteps() const { return std::sqrt(worst_) / scale_; }

void Collapser::findCandidates(const std::vector<float>& limitSteps) {
  candidates_.clear();
  candidates_.reserve(2 * triangles_.size());
  const auto limit = [&](uint32_t place) {
    const double inHalfSides = limitSteps[place] * scale_;
    return inHalfSides * inHalfSides;
  };
  for (const Triangle& t : triangles_) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = t[k], b = t[(k + 1) % 3];
      // The opposite edge stands for both, where there is one.
      if (a > b && !(open_[a] && open_[b])) continue;
      // A break moves along itself only.
      const bool aMoves = mesh_.faces[a] == 0 && breaks_[a] <= breaks_[b];
      const bool bMoves = mesh_.faces[b] == 0 && breaks_[b] <= breaks_[a];
      if (!aMoves && !bMoves) continue;
      const double costA = aMoves ? quadrics_[a].meanSquare(positions_[b]) : INFINITY;
      const double costB = bMoves ? quadrics_[b].meanSquare(positions_[a]) : INFINITY;
      const bool moveA = costA <= costB;
      const double cost = moveA ? costA : costB;
      if (cost > limit(a)) continue;
      const glm::dvec3 along = positions_[b] - positions_[a];
      const auto total = static_cast<float>(cost + kLengthWeight * glm::dot(along, along));
      candidates_.push_back(moveA ? Candidate{a, b, total} : Candidate{b, a, total});
    }
  }
}

// By the exponent and the first bits of the cost; equal ones stay in order.
void Collapser::sortCandidates() {
  constexpr int kDroppedBits = 19;
  std::array<uint32_t, (1u << (31 - kDroppedBits)) + 1> starts{};
  const auto key = [](const Candidate& candidate) { return std::bit_cast<uint32_t>(candidate.cost) >> kDroppedBits; };
  for (const Candidate& candidate : candidates_) ++starts[key(candidate) + 1];
  for (size_t i = 1; i < starts.size(); ++i) starts[i] += starts[i - 1];
  order_.resize(candidates_.size());
  for (uint32_t i = 0; i < candidates_.size(); ++i) order_[starts[key(candidates_[i])]++] = i;
}

bool Collapser::allowed(uint32_t from, uint32_t to, size_t& removes) const {
  removes = 0;
  bool someLeft = false;
  for (const RingEdge& edge : rings_.of(from)) {
    const uint32_t a = target_[edge.next], b = target_[edge.previous];
    if (a == b) continue;  // collapsed in this pass
    if (a == to || b == to) {
      if ((mesh_.faces[a] & mesh_.faces[b]) != 0 || (mesh_.faces[to] & mesh_.faces[a == to ? b : a]) != 0) return false;
      ++removes;
    } else if (turns(crossOf(positions_[from], positions_[a], positions_[b]),
                     crossOf(positions_[to], positions_[a], positions_[b]))) {
      return false;
    } else {
      someLeft = true;
    }
  }
  return removes > 0 && (someLeft || trianglesAt(to) > removes);
}

// That are left in this pass.
size_t Collapser::trianglesAt(uint32_t place) const {
  size_t count = 0;
  for (const RingEdge& edge : rings_.of(place)) count += target_[edge.next] != target_[edge.previous];
  return count;
}

size_t Collapser::collapseCheapest(size_t target) {
  const size_t goal = triangles_.size() - target;
  const size_t edgeGoal = goal / 2;
  const float limit = edgeGoal < order_.size() ? candidates_[order_[edgeGoal]].cost * kPassSlack
                                               : std::numeric_limits<float>::infinity();
  const size_t least = std::max(goal / kLeastShareOfGoal, triangles_.size() / kLeastShareOfAll);
  size_t removed = 0;
  for (const uint32_t index : order_) {
    const Candidate& candidate = candidates_[index];
    if (removed >= goal || (candidate.cost > limit && removed > least)) break;
    if (touched_[candidate.from] || touched_[candidate.to]) continue;
    size_t removes = 0;
    if (!allowed(candidate.from, candidate.to, removes)) continue;
    worst_ = std::max(worst_, quadrics_[candidate.from].meanSquare(positions_[candidate.to]));
    target_[candidate.from] = candidate.to;
    quadrics_[candidate.to].add(quadrics_[candidate.from]);
    if (open_[candidate.from]) open_[candidate.to] = true;
    touched_[candidate.from] = touched_[candidate.to] = true;
    removed += removes;
  }
  return removed;
}

void Collapser::removeCollapsed() {
  size_t kept = 0;
  for (size_t i = 0; i < triangles_.size(); ++i) {
    const Triangle t = {target_[triangles_[i][0]], target_[triangles_[i][1]], target_[triangles_[i][2]]};
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    triangles_[kept] = t;
    origins_[kept++] = origins_[i];
  }
  triangles_.resize(kept);
  origins_.resize(kept);
}

bool Collapser::pass(size_t target, const std::vector<float>& limitSteps) {
  if (triangles_.size() <= target) return false;
  rings_.build(triangles_, mesh_.places.size());
  findCandidates(limitSteps);
  sortCandidates();
  touched_.assign(mesh_.places.size(), false);
  if (collapseCheapest(target) == 0) return false;
  removeCollapsed();
  return true;
}

void Collapser::filter(const std::vector<bool>& keep) {
  size_t kept = 0;
  for (size_t i = 0; i < triangles_.size(); ++i) {
    if (!keep[i]) continue;
    triangles_[kept] = triangles_[i];
    origins_[kept++] = origins_[i];
  }
  triangles_.resize(kept);
  origins_.resize(kept);
}

std::vector<uint32_t> Collapser::targets() const {
  std::vector<uint32_t> last = target_;
  for (uint32_t& place : last)
    while (place != target_[place]) place = target_[place];
  return last;
}

}  // namespace farcell::lod
