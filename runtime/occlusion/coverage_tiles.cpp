#include "runtime/occlusion/coverage_tiles.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace farcell {
namespace {

constexpr double kEdgePixels = 1e-4;  // a sample this near to an inner edge is inside for both triangles at it
constexpr uint64_t kWhole = ~uint64_t{0};

}  // namespace

CoverageTiles::CoverageTiles(int width, int height, std::span<const glm::vec2> samples)
    : tileEdge_(samples.size() == 1 ? 8 : 4),
      columns_((width + tileEdge_ - 1) / tileEdge_),
      rows_((height + tileEdge_ - 1) / tileEdge_),
      tiles_(static_cast<size_t>(columns_) * static_cast<size_t>(rows_)) {
  size_t i = 0;
  for (int y = 0; y < tileEdge_; ++y)
    for (int x = 0; x < tileEdge_; ++x)
      for (const glm::vec2& sample : samples) {
        sampleX_[i] = static_cast<float>(x) + sample.x;
        sampleY_[i++] = static_cast<float>(y) + sample.y;
      }
}

uint64_t CoverageTiles::maskOf(const std::array<Edge, 3>& edges, double x, double y) const {
  std::array<float, 64> least;
  least.fill(1);
  for (const Edge& edge : edges) {
    const auto a = static_cast<float>(edge.a), b = static_cast<float>(edge.b);
    const auto c = static_cast<float>(edge.a * x + edge.b * y + edge.c);
    for (size_t i = 0; i < 64; ++i) least[i] = std::min(least[i], a * sampleX_[i] + b * sampleY_[i] + c);
  }
  uint64_t mask = 0;
  for (size_t i = 0; i < 64; ++i) mask |= uint64_t{least[i] >= 0} << i;
  return mask;
}

// Long because the edges, the depth's plane and the tiles' bounds share what is set up once for a triangle.
void CoverageTiles::add(const std::array<glm::dvec3, 3>& corners, const std::array<bool, 3>& inner) {
  const glm::dvec3 u = corners[1] - corners[0], v = corners[2] - corners[0];
  const double area = u.x * v.y - u.y * v.x;
  if (!(std::abs(area) > 0)) return;
  std::array<Edge, 3> edges;
  for (size_t i = 0; i < 3; ++i) {
    const glm::dvec3 &p = corners[i], &q = corners[(i + 1) % 3];
    const double length = std::hypot(q.x - p.x, q.y - p.y) * (area > 0 ? 1 : -1);
    if (length == 0) return;
    edges[i] = {(p.y - q.y) / length, (q.x - p.x) / length, (p.x * q.y - q.x * p.y) / length};
    edges[i].c += inner[i] ? kEdgePixels : -kSnapPixels;
  }
  const double depthX = (u.z * v.y - v.z * u.y) / area, depthY = (v.z * u.x - u.z * v.x) / area;
  const double depthAt0 = corners[0].z - depthX * corners[0].x - depthY * corners[0].y;
  const auto [lowX, highX] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
  const auto [lowY, highY] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
  const double farthest = std::min({corners[0].z, corners[1].z, corners[2].z});
  const auto tileOf = [&](double at, int count) {
    return static_cast<int>(std::clamp(std::floor(at / tileEdge_), -1.0, static_cast<double>(count)));
  };
  const int x0 = std::max(tileOf(lowX, columns_), 0), x1 = std::min(tileOf(highX, columns_), columns_ - 1);
  const int y0 = std::max(tileOf(lowY, rows_), 0), y1 = std::min(tileOf(highY, rows_), rows_ - 1);
  const double size = tileEdge_;
  for (int ty = y0; ty <= y1; ++ty)
    for (int tx = x0; tx <= x1; ++tx) {
      const double x = tx * size, y = ty * size;
      bool outside = false, inside = true;
      for (const Edge& edge : edges) {
        const double at = edge.a * x + edge.b * y + edge.c;
        outside |= at + size * (std::max(edge.a, 0.0) + std::max(edge.b, 0.0)) < 0;
        inside &= at + size * (std::min(edge.a, 0.0) + std::min(edge.b, 0.0)) >= 0;
      }
      if (outside) continue;
      ++tilesTouched_;
      const double plane = depthAt0 + depthX * x + depthY * y + size * (std::min(depthX, 0.0) + std::min(depthY, 0.0));
      const auto depth = static_cast<float>(std::max(plane, farthest));
      Tile& tile = tiles_[static_cast<size_t>(ty) * static_cast<size_t>(columns_) + static_cast<size_t>(tx)];
      if (depth <= tile.depth) continue;
      if (inside) {
        tile.depth = depth;
        continue;
      }
      const uint64_t mask = maskOf(edges, x, y);
      if (mask == 0) continue;
      tile.layer = tile.mask == 0 ? depth : std::min(tile.layer, depth);
      tile.mask |= mask;
      if (tile.mask != kWhole) continue;
      tile.depth = std::max(tile.depth, tile.layer);
      tile.mask = 0;
    }
}

bool CoverageTiles::covers(glm::dvec2 min, glm::dvec2 max, double depth) const {
  const double width = columns_ * tileEdge_, height = rows_ * tileEdge_;
  if (max.x < 0 || max.y < 0 || min.x >= width || min.y >= height) return true;
  const auto tileOf = [&](double at, int count) {
    return static_cast<int>(std::clamp(std::floor(at / tileEdge_), 0.0, static_cast<double>(count - 1)));
  };
  const int x1 = tileOf(max.x, columns_), y1 = tileOf(max.y, rows_);
  for (int y = tileOf(min.y, rows_); y <= y1; ++y)
    for (int x = tileOf(min.x, columns_); x <= x1; ++x)
      if (!(static_cast<double>(tiles_[static_cast<size_t>(y * columns_ + x)].depth) > depth)) return false;
  return true;
}

}  // namespace farcell
