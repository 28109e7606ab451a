// A cell's mesh for rays: what benchmarks find surfaces with, apart from any renderer.
#pragma once

#include <cmath>
#include <utility>

#include "cache/pack/pack_file.h"
#include "tools/evaluate/reference/traced_geometry.h"

namespace farcell {

// In the cell's local frame, half a side to 1.
inline Result<TracedGeometry> traceCell(const PackFile& pack, uint32_t index, RTCDevice device) {
  const Grid& grid = pack.directory().model.grid;
  const CellRecord& cell = pack.directory().cells[index];
  LocalTriangles local;
  local.origin = cellCentre(grid, cell.key);
  local.unit = cellHalfSide(grid, cell.key);
  const float steps = std::ldexp(1.0f, grid.bits - static_cast<int>(cell.key.level));
  for (uint32_t part = 0; part < cell.geometryPageCount; ++part) {
    FARCELL_ASSIGN(const GeometryPage page, pack.readGeometry(cell.firstGeometryPage + part));
    const auto first = static_cast<uint32_t>(local.positions.size());
    for (const glm::uvec3& p : page.positions) local.positions.push_back(glm::vec3(p) * (2 / steps) - glm::vec3(1));
    for (size_t i = 0; i + 2 < page.indices.size(); i += 3)
      local.triangles.push_back(glm::uvec3(page.indices[i], page.indices[i + 1], page.indices[i + 2]) + first);
  }
  return buildTracedGeometry(device, std::move(local));
}

}  // namespace farcell
