#include "tools/evaluate/baselines/octahedral_bake.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "cache/base/interrupt.h"
#include "cache/base/parallel.h"
#include "preprocess/atlas/atlas_sampler.h"
#include "preprocess/bake/view_baker.h"

namespace farcell {
namespace {

constexpr int kSamples = 16;
constexpr int kGroup = 32;  // frames in the making at once
constexpr int kDilations = 8;
constexpr int kLeastEdge = 16, kMostEdge = 1024;

uint32_t albedo() { return kDefaultAlbedo[0] | kDefaultAlbedo[1] << 8 | kDefaultAlbedo[2] << 16; }

CellSoup soupOf(const GeometryPage& page, const Grid& grid, const CellKey& cell, const OctahedralViews& views) {
  CellSoup soup;
  const GridPoint origin = cellBox(grid, cell).min;
  for (size_t i = 0; i < page.indices.size(); ++i) {
    const size_t corner = i % 3, vertex = page.indices[i];
    const glm::dvec3 p = (grid.worldFromGrid(origin + GridPoint(page.positions[vertex])) - views.centre) / views.unit;
    soup.x[corner].push_back(static_cast<float>(p.x));
    soup.y[corner].push_back(static_cast<float>(p.y));
    soup.z[corner].push_back(static_cast<float>(p.z));
    soup.colours[corner].push_back(page.colours.empty() ? albedo() : page.colours[vertex]);
    if (!page.normals.empty()) soup.normals[corner].push_back(page.normals[vertex]);
    if (page.coordinates.empty()) continue;
    const glm::vec2 at = unpackedCoordinates(page.coordinates[vertex]);
    soup.u[corner].push_back(at.x);
    soup.v[corner].push_back(at.y);
  }
  if (!page.coordinates.empty()) soup.textures.assign(page.indices.size() / 3, 0);
  return soup;
}

Result<> addLeaves(const PackFile& pack, const OctahedralViews& views, std::vector<ViewBaker>& bakers,
                   AtlasSampler& textures) {
  const Directory& directory = pack.directory();
  for (uint32_t index = 0; index < directory.cells.size(); ++index) {
    const CellRecord& cell = directory.cells[index];
    if (cell.childCount > 0) continue;
    FARCELL_TRY(checkInterrupt());
    for (uint32_t part = 0; part < cell.geometryPageCount; ++part) {
      FARCELL_ASSIGN(const GeometryPage page, pack.readGeometry(cell.firstGeometryPage + part));
      if (!page.coordinates.empty()) {
        FARCELL_ASSIGN(TexturePage atlas, pack.readAtlas(index, part));
        textures.show({std::move(atlas)});
      }
      const CellSoup soup = soupOf(page, directory.model.grid, cell.key, views);
      parallelFor(bakers.size(), threadCount(0), [&](size_t i, int) { bakers[i].add(soup); });
    }
  }
  return {};
}

// An image that the baker made around the cube, of which a frame is the middle.
struct Middle {
  const BakedView& view;
  int offset = 0;  // texels left out on each side
  int edge = 0;

  // Of the frame's texel, in the cropped view; negative: not there.
  int indexOf(int x, int y) const {
    const int column = x + offset - view.x0, row = y + offset - view.y0;
    const bool there = column >= 0 && row >= 0 && column < view.width && row < view.height;
    return there ? row * view.width + column : -1;
  }
};

std::vector<uint8_t> coloursOf(const Middle& middle) {
  std::vector<uint8_t> colours(4 * static_cast<size_t>(middle.edge) * static_cast<size_t>(middle.edge));
  for (int y = 0; y < middle.edge; ++y)
    for (int x = 0; x < middle.edge; ++x) {
      const int from = middle.indexOf(x, y);
      for (int c = 0; from >= 0 && c < 4; ++c)
        colours[4 * static_cast<size_t>(y * middle.edge + x) + static_cast<size_t>(c)] =
            static_cast<uint8_t>(std::lround(255 * middle.view.rgba[static_cast<size_t>(4 * from + c)]));
    }
  return colours;
}

// Texels without a surface take the mean of their neighbours that have one.
void dilate(std::vector<float>& depths, int edge) {
  const std::vector<float> before = depths;
  for (int y = 0; y < edge; ++y)
    for (int x = 0; x < edge; ++x) {
      if (std::isfinite(before[static_cast<size_t>(y * edge + x)])) continue;
      float sum = 0, count = 0;
      for (int ny = std::max(0, y - 1); ny <= std::min(edge - 1, y + 1); ++ny)
        for (int nx = std::max(0, x - 1); nx <= std::min(edge - 1, x + 1); ++nx) {
          const float depth = before[static_cast<size_t>(ny * edge + nx)];
          sum += std::isfinite(depth) ? depth : 0.0f;
          count += std::isfinite(depth) ? 1.0f : 0.0f;
        }
      if (count > 0) depths[static_cast<size_t>(y * edge + x)] = sum / count;
    }
}

std::vector<uint8_t> depthsOf(const Middle& middle, double halfExtent) {
  std::vector<float> depths;
  for (int y = 0; y < middle.edge; ++y)
    for (int x = 0; x < middle.edge; ++x) {
      const int from = middle.indexOf(x, y);
      depths.push_back(from < 0 ? -INFINITY : middle.view.depth[static_cast<size_t>(from)]);
    }
  for (int i = 0; i < kDilations; ++i) dilate(depths, middle.edge);
  std::vector<uint8_t> bytes;
  for (const float depth : depths) {
    const double share = std::isfinite(depth) ? std::clamp(depth / halfExtent, -1.0, 1.0) : 0;
    bytes.push_back(static_cast<uint8_t>(std::lround((share + 1) / 2 * 255)));
  }
  return bytes;
}

std::array<glm::dvec3, 3> gridAxes(UpAxis axis) {
  const glm::dvec3 up = upVector(axis), east(up.y, up.z, up.x);
  return {east, glm::cross(up, east), up};
}

}  // namespace

uint64_t octahedralBytes(int edge) {
  const auto texels = static_cast<uint64_t>(edge) * static_cast<uint64_t>(edge);
  return kOctahedralFrames * (texels * 4 * 4 / 3 + texels);
}

int octahedralEdgeOf(uint64_t bytes) {
  int edge = kLeastEdge;
  while (edge < kMostEdge && octahedralBytes(edge + 1) <= bytes) ++edge;
  return edge;
}

Result<OctahedralViews> bakeOctahedral(const PackFile& pack, int edge, glm::vec3 sun) {
  const Model& model = pack.directory().model;
  const glm::dvec3 min = model.grid.worldFromGrid(model.bounds.min), max = model.grid.worldFromGrid(model.bounds.max);
  const glm::dvec3 half = (max - min) * 0.5;
  OctahedralViews views;
  views.centre = (min + max) * 0.5;
  views.unit = std::max({half.x, half.y, half.z, model.grid.step()});
  const double radius = std::max(glm::length(half) / views.unit, 0.5);
  // The baker's image holds the whole cube from any direction; the frame is as much of its middle as the sphere takes.
  const int cube = edge + 2 * static_cast<int>(std::ceil(edge * (kViewHalfExtent / radius - 1) / 2));
  views.edge = edge;
  views.halfExtent = kViewHalfExtent * edge / cube;
  views.grid = gridAxes(model.settings.up);
  for (int frame = 0; frame < kOctahedralFrames; ++frame) {
    const glm::dvec3 d = octahedralDirection(frame);
    views.axes.push_back(viewFrame(glm::normalize(views.grid[0] * d.x + views.grid[1] * d.y + views.grid[2] * d.z)));
  }
  for (int first = 0; first < kOctahedralFrames; first += kGroup) {
    AtlasSampler textures({});  // of the part that is being added
    std::vector<ViewBaker> bakers;
    for (int i = 0; i < kGroup; ++i) {
      bakers.emplace_back(BakeSettings{cube, kSamples, sun, false}, &textures);
      bakers.back().begin(views.axes[static_cast<size_t>(first + i)]);
    }
    FARCELL_TRY(addLeaves(pack, views, bakers, textures));
    for (ViewBaker& baker : bakers) {
      BakedView view, antipode;
      baker.finish(view, antipode);
      const Middle middle{view, (cube - edge) / 2, edge};
      views.colours.push_back(coloursOf(middle));
      views.depths.push_back(depthsOf(middle, views.halfExtent));
    }
  }
  return views;
}

}  // namespace farcell
