#include "runtime/calibration/ball_pack.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "cache/pack/pack_file.h"
#include "cache/schema/view_frame.h"
#include "cache/schema/viewpoints.h"

namespace farcell {
namespace {

constexpr int kViews = 12;
constexpr int kImageSize = 64;
constexpr uint32_t kEdge = 64;  // triangles along the edge of an octant

glm::dvec3 signs(uint32_t octant) { return {octant & 1 ? 1 : -1, octant & 2 ? 1 : -1, octant & 4 ? 1 : -1}; }

uint32_t colourAt(glm::dvec3 p) {
  const auto channel = [](double x) { return static_cast<uint32_t>(128 + 100 * std::sin(40 * x)); };
  return channel(p.x) | channel(p.y) << 8 | channel(p.z) << 16;
}

// An octant of the sphere as a triangle of kEdge^2 small ones.
GeometryPage octantPage(const Grid& grid, uint32_t octant, GridBox& content) {
  GeometryPage page;
  const GridPoint low = cellBox(grid, CellKey{}.child(octant)).min;
  std::map<std::array<uint32_t, 2>, uint32_t> places;
  for (uint32_t row = 0; row <= kEdge; ++row)
    for (uint32_t column = 0; column + row <= kEdge; ++column) {
      const glm::dvec3 p = glm::normalize(glm::dvec3(row, column, kEdge - row - column)) * signs(octant);
      const GridPoint point = grid.gridFromWorld(p);
      places[{row, column}] = static_cast<uint32_t>(page.positions.size());
      page.positions.push_back(glm::uvec3(point - low));
      page.colours.push_back(colourAt(p));
      content.include(point);
    }
  for (const auto& [place, vertex] : places) {
    const auto [row, column] = place;
    if (row + column == kEdge) continue;
    page.indices.insert(page.indices.end(), {vertex, places.at({row + 1, column}), places.at({row, column + 1})});
    if (row + column + 2 > kEdge) continue;
    page.indices.insert(page.indices.end(),
                        {places.at({row + 1, column}), places.at({row + 1, column + 1}), places.at({row, column + 1})});
  }
  return page;
}

// The nearest point of the sphere on the ray through a texel that lies in the octant's cube; w of the view's frame.
double surfaceAt(const ViewFrame& frame, glm::dvec3 centre, double radius, double u, double v) {
  const glm::dvec3 across = frame.right * u + frame.up * v;
  const double along = glm::dot(centre - across, frame.toward);
  const glm::dvec3 off = across + frame.toward * along - centre;
  const double half = std::sqrt(radius * radius - glm::dot(off, off));
  for (const double w : {along + half, along - half}) {
    const glm::dvec3 p = glm::abs(across + frame.toward * w);
    if (p.x <= 1 && p.y <= 1 && p.z <= 1) return w;
  }
  return NAN;
}

ViewImage octantView(const Grid& grid, uint32_t octant, uint32_t view, glm::dvec3 direction) {
  const ViewFrame frame = viewFrame(direction);
  const CellKey key = CellKey{}.child(octant);
  const double halfSide = cellHalfSide(grid, key), texel = texelSize(kImageSize);
  const glm::dvec3 centre = -cellCentre(grid, key) / halfSide;
  ViewImage image{.view = view, .width = kImageSize, .height = kImageSize, .rgba = {}, .depth = {}, .normal = {}};
  image.depthMin = static_cast<float>(-kViewHalfExtent);
  image.depthMax = static_cast<float>(kViewHalfExtent);
  for (int y = 0; y < kImageSize; ++y)
    for (int x = 0; x < kImageSize; ++x) {
      const double u = (x + 0.5) * texel - kViewHalfExtent, v = (y + 0.5) * texel - kViewHalfExtent;
      const double w = surfaceAt(frame, centre, 1 / halfSide, u, v);
      const bool hit = !std::isnan(w);
      const uint32_t colour = hit ? colourAt(frame.right * u + frame.up * v + frame.toward * w) : 0;
      for (int channel = 0; channel < 3; ++channel)
        image.rgba.push_back(static_cast<uint8_t>(colour >> (8 * channel) & 255));
      image.rgba.push_back(hit ? 255 : 0);
      image.depth.push_back(
          hit ? static_cast<uint8_t>(1 + std::lround(254 * (w + kViewHalfExtent) / (2 * kViewHalfExtent))) : 0);
    }
  return image;
}

Result<> addViews(PackWriter& writer, const Grid& grid, const Viewpoints& viewpoints, uint32_t octant,
                  CellRecord& cell) {
  std::map<uint32_t, ViewPage> groups;
  for (int view = 0; view < kViews; ++view)
    groups[static_cast<uint32_t>(viewpoints.group(view))].views.push_back(
        octantView(grid, octant, static_cast<uint32_t>(view), viewpoints.directions()[static_cast<size_t>(view)]));
  for (const auto& [group, page] : groups) {
    FARCELL_ASSIGN(const uint32_t added,
                   writer.add(PageKind::views, 1 + octant, group, decodedSizeBytes(page), encodeViewPage(page)));
    if (cell.viewPageCount++ == 0) cell.firstViewPage = added;
  }
  return {};
}

}  // namespace

Result<> writeBallPack(const std::filesystem::path& path) {
  Directory directory;
  directory.model.grid = gridAround(glm::dvec3(-1), glm::dvec3(1));
  directory.model.settings.form = {kViews, kImageSize};
  directory.model.hasColours = true;
  directory.cells.push_back(
      {.key = {}, .firstChild = 1, .childCount = 8, .content = {}, .form = directory.model.settings.form});
  FARCELL_ASSIGN(PackWriter writer, PackWriter::create(path));
  for (uint32_t octant = 0; octant < 8; ++octant) {
    CellRecord cell{.key = CellKey{}.child(octant), .parent = 0, .content = {}, .form = directory.model.settings.form};
    const GeometryPage page = octantPage(directory.model.grid, octant, cell.content);
    FARCELL_ASSIGN(cell.firstGeometryPage,
                   writer.add(PageKind::geometry, 1 + octant, 0, decodedSizeBytes(page), encodeGeometryPage(page)));
    cell.triangles = cell.meshTriangles = page.indices.size() / 3;
    cell.geometryPageCount = 1;
    if (octant > 0) FARCELL_TRY(addViews(writer, directory.model.grid, Viewpoints::of(kViews), octant, cell));
    directory.cells[0].content.include(cell.content);
    directory.cells[0].triangles += cell.triangles;
    directory.cells.push_back(cell);
  }
  directory.model.bounds = directory.cells[0].content;
  FARCELL_TRY(writer.finish(std::move(directory)));
  return {};
}

}  // namespace farcell
