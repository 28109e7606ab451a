#include "runtime/occlusion/occluders.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

namespace farcell {
namespace {

struct Side {
  std::array<int, 6> ends;  // of an edge, by order
  size_t occluder;
  size_t edge;
};

Side sideOf(const Occluder& occluder, size_t index, size_t edge) {
  const GridPoint &a = occluder.corners[edge], &b = occluder.corners[(edge + 1) % 3];
  std::array<int, 3> low = {a.x, a.y, a.z}, high = {b.x, b.y, b.z};
  if (high < low) std::swap(low, high);
  return {{low[0], low[1], low[2], high[0], high[1], high[2]}, index, edge};
}

}  // namespace

void findAcross(std::vector<Occluder>& occluders) {
  std::vector<Side> sides;
  sides.reserve(3 * occluders.size());
  const auto third = [&](const Side& side) { return occluders[side.occluder].corners[(side.edge + 2) % 3]; };
  const auto across = [&](const Side& side) -> GridPoint& { return occluders[side.occluder].across[side.edge]; };
  for (size_t i = 0; i < occluders.size(); ++i)
    for (size_t edge = 0; edge < 3; ++edge) {
      sides.push_back(sideOf(occluders[i], i, edge));
      across(sides.back()) = third(sides.back());
    }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.ends < b.ends; });
  for (size_t first = 0, next = 0; first < sides.size(); first = next) {
    while (next < sides.size() && sides[next].ends == sides[first].ends) ++next;
    if (next - first != 2) continue;
    across(sides[first]) = third(sides[first + 1]);
    across(sides[first + 1]) = third(sides[first]);
  }
}

Result<std::vector<Occluder>> readOccluders(const PackFile& pack, uint32_t leaf) {
  const CellRecord& cell = pack.directory().cells[leaf];
  const GridPoint low = cellBox(pack.directory().model.grid, cell.key).min;
  std::vector<Occluder> all;
  for (uint32_t part = 0; part < cell.geometryPageCount; ++part) {
    FARCELL_ASSIGN(const GeometryPage page, pack.readGeometry(cell.firstGeometryPage + part));
    for (size_t i = 0; i + 2 < page.indices.size(); i += 3) {
      if (!page.colours.empty() && (page.colours[page.indices[i]] & kSeenFromFront) != 0)
        continue;  // hides one side only
      Occluder occluder;
      for (size_t k = 0; k < 3; ++k) occluder.corners[k] = low + GridPoint(page.positions[page.indices[i + k]]);
      const glm::dvec3 u(occluder.corners[1] - occluder.corners[0]), v(occluder.corners[2] - occluder.corners[0]);
      occluder.area = static_cast<float>(glm::length(glm::cross(u, v)) / 2);
      all.push_back(occluder);
    }
  }
  findAcross(all);
  std::stable_sort(all.begin(), all.end(), [](const Occluder& a, const Occluder& b) { return a.area > b.area; });
  all.resize(std::min(all.size(), kMostOccluders));
  all.shrink_to_fit();
  return all;
}

}  // namespace farcell
