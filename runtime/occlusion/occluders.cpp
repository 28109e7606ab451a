#include "runtime/occlusion/occluders.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace farcell {

Result<std::vector<Occluder>> readOccluders(const PackFile& pack, uint32_t leaf) {
  const CellRecord& cell = pack.directory().cells[leaf];
  const GridPoint low = cellBox(pack.directory().model.grid, cell.key).min;
  std::vector<Occluder> all;
  for (uint32_t part = 0; part < cell.geometryPageCount; ++part) {
    FARCELL_ASSIGN(const GeometryPage page, pack.readGeometry(cell.firstGeometryPage + part));
    for (size_t i = 0; i + 2 < page.indices.size(); i += 3) {
      Occluder occluder;
      for (size_t k = 0; k < 3; ++k) occluder.corners[k] = low + GridPoint(page.positions[page.indices[i + k]]);
      const glm::dvec3 u(occluder.corners[1] - occluder.corners[0]), v(occluder.corners[2] - occluder.corners[0]);
      occluder.area = static_cast<float>(glm::length(glm::cross(u, v)) / 2);
      all.push_back(occluder);
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const Occluder& a, const Occluder& b) { return a.area > b.area; });
  all.resize(std::min(all.size(), kMostOccluders));
  all.shrink_to_fit();
  return all;
}

}  // namespace farcell
