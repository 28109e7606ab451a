// Simplifies by moving places onto neighbours (half-edge collapses), the cheapest by its quadric first, in passes: each
// sorts all edges once and collapses those that do not touch one another. Every place that is left is one that was
// there.
//
// Places on the cube's faces stay, and so does every triangle with an edge in a face: the cell goes on fitting its
// neighbours. The last triangles of a part stay too: parts.h decides on whole parts.
//
// The mesh may be anything: a collapse maps the surface's boundary onto itself whatever the topology, so
// that a closed surface stays closed.
#pragma once

#include <cstdint>
#include <vector>

#include "preprocess/lod/quadric.h"
#include "preprocess/lod/rings.h"
#include "preprocess/lod/welded_mesh.h"

namespace farcell::lod {

class Collapser {
 public:
  // The mesh must outlive this.
  explicit Collapser(const WeldedMesh& mesh);

  const std::vector<Triangle>& triangles() const { return triangles_; }
  // The triangle of the mesh that each was.
  const std::vector<uint32_t>& origins() const { return origins_; }
  // The largest error of a collapse so far, steps: root of the quadric's mean square.
  double errorSteps() const;
  // One pass towards `target` triangles. limitSteps: of a place, what error its collapse may have. False if it changed
  // nothing.
  bool pass(size_t target, const std::vector<float>& limitSteps);
  // Takes away the triangles for which keep is false.
  void filter(const std::vector<bool>& keep);
  // Of a place of the mesh: the place that it was moved to, at last.
  std::vector<uint32_t> targets() const;

 private:
  struct Candidate {
    uint32_t from, to;
    float cost;
  };
  void addSurfaceQuadrics();
  void addEdgeQuadrics();
  const RingEdge* edgeFrom(uint32_t from, uint32_t to) const;
  bool breaksBetween(uint32_t one, uint32_t other, uint32_t a, uint32_t b) const;
  void addEdgeQuadric(const Triangle& t, size_t k, double weight);
  void findCandidates(const std::vector<float>& limitSteps);
  void sortCandidates();
  bool allowed(uint32_t from, uint32_t to, size_t& removes) const;
  size_t trianglesAt(uint32_t place) const;
  size_t collapseCheapest(size_t target);
  void removeCollapsed();

  const WeldedMesh& mesh_;
  double scale_;                       // half sides of the cell in a step
  std::vector<glm::dvec3> positions_;  // [-1, 1]^3
  std::vector<Quadric> quadrics_;
  std::vector<bool> open_;    // on an edge that lacks its opposite
  std::vector<bool> breaks_;  // several vertices at one place
  std::vector<Triangle> triangles_;
  std::vector<uint32_t> origins_;
  std::vector<uint32_t> target_;
  double worst_ = 0;
  // of the current pass
  Rings rings_;
  std::vector<Candidate> candidates_;
  std::vector<uint32_t> order_;
  std::vector<bool> touched_;
};

}  // namespace farcell::lod
