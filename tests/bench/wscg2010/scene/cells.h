// The paper's octree: all cells at one depth, those without triangles left out.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "cache/schema/grid.h"
#include "preprocess/bake/view_baker.h"
#include "tests/bench/wscg2010/scene/scene.h"

namespace farcell::wscg {

// What a cell's images show.
enum class Content {
  cube,    // triangles cut to the cell's cube
  grown,   // cut to the cube enlarged by kCellGrowth: farcell's way
  sphere,  // whole triangles that meet the cube's bounding sphere: the paper's way
};

inline double cellHalfSide(int depth) { return 1.0 / static_cast<double>(1 << depth); }
glm::dvec3 cellCentre(const CellKey& key);
// Radius of the sphere that a cell's images enclose: the bounding sphere of its cube, or of the grown one.
double imageRadius(int depth, Content content);

// A cell's triangles around its centre, scaled so that the sphere its images enclose has radius kViewHalfExtent.
struct CellContent {
  std::vector<Triangle> triangles;  // those that lie within the sphere first
  size_t insideCount = 0;
  CellSoup soup;  // the same of those within the sphere, as the baker takes them
};

// Not thread-safe while being made; then const.
class CellIndex {
 public:
  // depth: 0 to kMaxDepth. `scene` must outlive the index.
  static constexpr int kMaxDepth = 6;
  CellIndex(const Scene& scene, int depth);

  const Scene& scene() const { return scene_; }
  int depth() const { return depth_; }
  // Cells whose cube holds a part of a triangle, x fastest.
  const std::vector<CellKey>& occupied() const { return occupied_; }
  CellContent content(const CellKey& key, Content content) const;
  // Triangles cut to the cell's cube, in the scene's coordinates.
  std::vector<Triangle> cut(const CellKey& key) const;

 private:
  size_t at(uint32_t x, uint32_t y, uint32_t z) const;
  // Triangles whose boxes meet the cubes of the cell and, where asked, of its 26 neighbours; each once.
  std::vector<uint32_t> candidates(const CellKey& key, bool withNeighbours) const;

  const Scene& scene_;
  int depth_;
  uint32_t side_;                             // cells along an edge
  std::vector<std::vector<uint32_t>> lists_;  // per cell: triangles whose box meets its cube
  std::vector<CellKey> occupied_;
};

}  // namespace farcell::wscg
