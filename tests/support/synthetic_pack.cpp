#include "tests/support/synthetic_pack.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <tuple>

#include "cache/pack/pack_file.h"
#include "cache/schema/viewpoints.h"
#include "shaders/shared/shading.h"
#include "tests/support/synthetic_bake.h"

namespace farcell {
namespace {

using Polygon = std::vector<GridPoint>;

struct CutCell {
  CellRecord record;
  GeometryPage page;
};

bool before(GridPoint a, GridPoint b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

// Where an edge meets a plane of the grid: the same point from both ends and for both triangles at the edge.
GridPoint crossing(GridPoint a, GridPoint b, int axis, int plane) {
  if (before(b, a)) std::swap(a, b);
  const double t = (static_cast<double>(plane) - a[axis]) / (static_cast<double>(b[axis]) - a[axis]);
  GridPoint point;
  for (int i = 0; i < 3; ++i) point[i] = static_cast<int>(std::lround(a[i] + t * (static_cast<double>(b[i]) - a[i])));
  point[axis] = plane;
  return point;
}

Polygon half(const Polygon& polygon, int axis, int plane, bool low) {
  Polygon result;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const GridPoint a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const bool keep = low ? a[axis] <= plane : a[axis] >= plane;
    if (keep) result.push_back(a);
    if ((a[axis] < plane && b[axis] > plane) || (a[axis] > plane && b[axis] < plane))
      result.push_back(crossing(a, b, axis, plane));
  }
  return result.size() < 3 ? Polygon() : result;
}

bool inPlane(const Polygon& polygon, int axis, int plane) {
  return std::all_of(polygon.begin(), polygon.end(), [&](GridPoint p) { return p[axis] == plane; });
}

// Cuts at every cell plane, lowest first, one axis after the other; a polygon within a plane goes to the upper cell.
void scatter(Polygon polygon, int axis, CellKey key, int shift, uint32_t colour, std::map<CellKey, CutCell>& cells) {
  if (polygon.size() < 3) return;
  if (axis == 3) {
    CutCell& cell = cells[key];
    const GridPoint origin(static_cast<int>(key.x << shift), static_cast<int>(key.y << shift),
                           static_cast<int>(key.z << shift));
    const auto first = static_cast<uint32_t>(cell.page.positions.size());
    for (const GridPoint point : polygon) {
      cell.record.content.include(point);
      cell.page.positions.push_back(glm::uvec3(point - origin));
      cell.page.colours.push_back(colour);
    }
    for (uint32_t i = 2; i < polygon.size(); ++i)
      cell.page.indices.insert(cell.page.indices.end(), {first, first + i - 1, first + i});
    cell.record.triangles += polygon.size() - 2;
    return;
  }
  for (uint32_t slab = 0; slab < (1u << key.level) && !polygon.empty(); ++slab) {
    const int plane = static_cast<int>((slab + 1) << shift);
    CellKey inside = key;
    (axis == 0 ? inside.x : axis == 1 ? inside.y : inside.z) = slab;
    if (!inPlane(polygon, axis, plane)) {
      scatter(half(polygon, axis, plane, true), axis + 1, inside, shift, colour, cells);
      polygon = half(polygon, axis, plane, false);
    }
  }
}

// Leaves, then their ancestors: all cells by level and Morton code, linked.
std::vector<CutCell> makeTree(std::map<CellKey, CutCell> cells, int level) {
  for (auto& [key, cell] : cells) cell.record.key = key;
  for (int l = level; l > 0; --l) {
    std::map<CellKey, CutCell> parents;
    for (const auto& [key, cell] : cells) {
      if (static_cast<int>(key.level) != l) continue;
      CutCell& parent = parents[key.parent()];
      parent.record.key = key.parent();
      parent.record.content.include(cell.record.content);
      parent.record.triangles += cell.record.triangles;
    }
    cells.merge(parents);
  }
  std::vector<CutCell> result;
  for (auto& [key, cell] : cells) result.push_back(std::move(cell));
  std::sort(result.begin(), result.end(), [](const CutCell& l, const CutCell& r) {
    return std::pair(l.record.key.level, mortonCode(l.record.key)) <
           std::pair(r.record.key.level, mortonCode(r.record.key));
  });
  std::map<CellKey, uint32_t> index;
  for (uint32_t i = 0; i < result.size(); ++i) {
    CellRecord& record = result[i].record;
    index[record.key] = i;
    if (i == 0) continue;
    record.parent = index.at(record.key.parent());
    CellRecord& parent = result[record.parent].record;
    if (parent.childCount++ == 0) parent.firstChild = i;
  }
  return result;
}

// Albedo where there is no sun.
glm::dvec3 lit(uint32_t colour, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c, const std::optional<glm::vec3>& sun) {
  const glm::vec3 albedo = glm::vec3(colour & 255, colour >> 8 & 255, colour >> 16 & 255) / 255.0f;
  if (!sun) return glm::dvec3(albedo);
  return glm::dvec3(shared::shade(albedo, glm::vec3(glm::normalize(glm::cross(b - a, c - a))), *sun));
}

std::vector<LocalTriangle> localTriangles(const std::vector<CutCell>& cells, const Grid& grid, const CellKey& key,
                                          const std::optional<glm::vec3>& sun) {
  const GridBox cube = cellBox(grid, key);
  const glm::dvec3 centre = glm::dvec3(cube.min + cube.max) * 0.5;
  const double halfSide = (cube.max.x - cube.min.x) * 0.5;
  std::vector<LocalTriangle> result;
  for (const CutCell& cell : cells) {
    const glm::dvec3 origin(cellBox(grid, cell.record.key).min);
    for (size_t i = 0; i < cell.page.indices.size(); i += 3) {
      LocalTriangle triangle;
      for (size_t k = 0; k < 3; ++k)
        triangle.corners[k] = (glm::dvec3(cell.page.positions[cell.page.indices[i + k]]) + origin - centre) / halfSide;
      triangle.colour = lit(cell.page.colours[cell.page.indices[i]], triangle.corners[0], triangle.corners[1],
                            triangle.corners[2], sun);
      result.push_back(triangle);
    }
  }
  return result;
}

Result<> addViews(PackWriter& writer, uint32_t index, CellRecord& record, const std::vector<LocalTriangle>& triangles,
                  const Viewpoints& viewpoints, const SyntheticPack& settings) {
  std::map<uint32_t, ViewPage> groups;
  for (int view = 0; view < viewpoints.count(); ++view)
    if (std::find(settings.leftOut.begin(), settings.leftOut.end(), view) == settings.leftOut.end())
      groups[static_cast<uint32_t>(viewpoints.group(view))].views.push_back(
          bakeSynthetic(triangles, viewpoints.directions()[static_cast<size_t>(view)],
                        {static_cast<uint32_t>(view), settings.imageSize, settings.samplesPerEdge,
                         settings.lighting == Lighting::relightable}));
  for (const auto& [group, page] : groups) {
    FARCELL_ASSIGN(const uint32_t added,
                   writer.add(PageKind::views, index, group, decodedSizeBytes(page), encodeViewPage(page)));
    if (record.viewPageCount++ == 0) record.firstViewPage = added;
  }
  return {};
}

}  // namespace

Result<> writeSyntheticPack(const std::filesystem::path& path, const std::vector<SyntheticTriangle>& triangles,
                            const SyntheticPack& settings) {
  FARCELL_ASSIGN(const Viewpoints viewpoints, Viewpoints::create(settings.views));
  Directory directory;
  glm::dvec3 low(INFINITY), high(-INFINITY);
  for (const auto& triangle : triangles)
    for (const glm::dvec3 corner : triangle.corners)
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], corner[axis]);
        high[axis] = std::max(high[axis], corner[axis]);
      }
  Model& model = directory.model;
  model.grid = gridAround(low, high);
  model.settings.form = {settings.views, settings.imageSize};
  model.settings.lighting = settings.lighting;
  model.settings.sun = settings.sun;
  model.settings.up = settings.up;
  model.hasColours = true;
  std::map<CellKey, CutCell> leaves;
  const CellKey start{static_cast<uint32_t>(settings.level), 0, 0, 0};
  for (const auto& triangle : triangles)
    scatter({model.grid.gridFromWorld(triangle.corners[0]), model.grid.gridFromWorld(triangle.corners[1]),
             model.grid.gridFromWorld(triangle.corners[2])},
            0, start, model.grid.bits - settings.level, triangle.colour, leaves);
  std::optional<glm::vec3> sun;
  if (settings.lighting == Lighting::baked) sun = sunDirection(settings.up, settings.sun);
  std::vector<CutCell> cells = makeTree(std::move(leaves), settings.level);
  model.bounds = cells[0].record.content;
  FARCELL_ASSIGN(PackWriter writer, PackWriter::create(path));
  for (uint32_t i = 0; i < cells.size(); ++i) {
    CellRecord& record = cells[i].record;
    record.form = model.settings.form;
    if (record.childCount == 0) {
      FARCELL_ASSIGN(record.firstGeometryPage, writer.add(PageKind::geometry, i, 0, decodedSizeBytes(cells[i].page),
                                                          encodeGeometryPage(cells[i].page)));
      record.meshTriangles = record.triangles;
      record.geometryPageCount = 1;
    }
    if (settings.withViews && (record.childCount == 0 || settings.withInnerViews))
      FARCELL_TRY(
          addViews(writer, i, record, localTriangles(cells, model.grid, record.key, sun), viewpoints, settings));
    directory.cells.push_back(record);
  }
  FARCELL_TRY(writer.finish(std::move(directory)));
  return {};
}

std::vector<SyntheticTriangle> boxTriangles(glm::dvec3 min, glm::dvec3 max, uint32_t colour) {
  std::vector<SyntheticTriangle> result;
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      std::array<glm::dvec3, 4> corners;
      for (int i = 0; i < 4; ++i) {
        glm::dvec3 p;
        p[axis] = side ? max[axis] : min[axis];
        p[(axis + 1) % 3] = i == 1 || i == 2 ? max[(axis + 1) % 3] : min[(axis + 1) % 3];
        p[(axis + 2) % 3] = i >= 2 ? max[(axis + 2) % 3] : min[(axis + 2) % 3];
        corners[static_cast<size_t>(i)] = p;
      }
      result.push_back({{corners[0], corners[1], corners[2]}, colour});
      result.push_back({{corners[0], corners[2], corners[3]}, colour});
    }
  return result;
}

std::vector<SyntheticTriangle> sphereTriangles(glm::dvec3 centre, double radius, int subdivisions, uint32_t colour) {
  std::vector<std::array<glm::dvec3, 3>> faces;
  for (int octant = 0; octant < 8; ++octant)
    faces.push_back({glm::dvec3(octant & 1 ? 1 : -1, 0, 0), glm::dvec3(0, octant & 2 ? 1 : -1, 0),
                     glm::dvec3(0, 0, octant & 4 ? 1 : -1)});
  for (int i = 0; i < subdivisions; ++i) {
    std::vector<std::array<glm::dvec3, 3>> finer;
    for (const auto& [a, b, c] : faces) {
      const glm::dvec3 ab = glm::normalize(a + b), bc = glm::normalize(b + c), ca = glm::normalize(c + a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    faces = std::move(finer);
  }
  std::vector<SyntheticTriangle> result;
  for (const auto& [a, b, c] : faces)
    result.push_back({{centre + radius * a, centre + radius * b, centre + radius * c}, colour});
  return result;
}

}  // namespace farcell
