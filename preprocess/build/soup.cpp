#include "preprocess/build/soup.h"

#include <algorithm>
#include <array>

#include "cache/schema/view_frame.h"
#include "preprocess/partition/grid_triangle.h"

namespace farcell {
namespace {

constexpr size_t kPortion = 16'384;

struct Corner {
  glm::dvec3 position;  // cell-local
  glm::dvec3 colour;    // 0..255
  glm::vec3 normal;
  glm::dvec2 coordinates;  // on the texture
};

// A triangle cut by the six planes of a cube has at most nine corners.
struct Polygon {
  std::array<Corner, 9> corners;
  int count = 0;
};

Corner mix(const Corner& a, const Corner& b, double t) {
  return {a.position + (b.position - a.position) * t, a.colour + (b.colour - a.colour) * t,
          a.normal * static_cast<float>(1 - t) + b.normal * static_cast<float>(t),
          a.coordinates + (b.coordinates - a.coordinates) * t};
}

// Sutherland and Hodgman, Reentrant Polygon Clipping, 1974: the part with sign * position[axis] <= kCellGrowth.
Polygon clipped(const Polygon& polygon, int axis, double sign) {
  Polygon result;
  const auto outside = [&](const Corner& corner) { return sign * corner.position[axis] - kCellGrowth; };
  for (int i = 0; i < polygon.count; ++i) {
    const Corner& corner = polygon.corners[i];
    const Corner& next = polygon.corners[(i + 1) % polygon.count];
    const double here = outside(corner), there = outside(next);
    if (here <= 0) result.corners[result.count++] = corner;
    if ((here < 0 && there > 0) || (here > 0 && there < 0))
      result.corners[result.count++] = mix(corner, next, here / (here - there));
  }
  return result;
}

uint32_t packColour(glm::dvec3 colour) {
  uint32_t packed = 0;
  for (int channel = 0; channel < 3; ++channel)
    packed |= static_cast<uint32_t>(std::clamp(colour[channel], 0.0, 255.0) + 0.5) << 8 * channel;
  return packed;
}

void pushCorner(CellSoup& soup, size_t k, glm::dvec3 position, uint32_t colour) {
  soup.x[k].push_back(static_cast<float>(position.x));
  soup.y[k].push_back(static_cast<float>(position.y));
  soup.z[k].push_back(static_cast<float>(position.z));
  soup.colours[k].push_back(colour);
}

// Before a triangle goes into the soup: whether it does with a texture. From the first such triangle on all have
// entries.
bool hasTexture(const TriangleTexture& texture, CellSoup& soup) {
  if (texture.texture == kNoTexture) return !soup.textures.empty();
  if (!soup.textures.empty()) return true;
  soup.textures.resize(soup.size(), kNoTexture);
  for (size_t k = 0; k < 3; ++k) {
    soup.u[k].resize(soup.size());
    soup.v[k].resize(soup.size());
  }
  return true;
}

void pushTexture(CellSoup& soup, uint32_t texture, const std::array<glm::vec2, 3>& coordinates) {
  soup.textures.push_back(texture);
  for (size_t k = 0; k < 3; ++k) {
    soup.u[k].push_back(coordinates[k].x);
    soup.v[k].push_back(coordinates[k].y);
  }
}

// Cell-local coordinates of grid points.
struct LocalFrame {
  glm::dvec3 centreSteps;
  double localFromSteps;

  LocalFrame(const Grid& grid, const CellKey& key) {
    const GridBox box = cellBox(grid, key);
    centreSteps = glm::dvec3(box.min + box.max) * 0.5;
    localFromSteps = 2.0 / static_cast<double>(box.max.x - box.min.x);
  }
  glm::dvec3 operator()(GridPoint point) const { return (glm::dvec3(point) - centreSteps) * localFromSteps; }
};

void appendWhole(const GridTriangle& triangle, const TriangleTexture& texture, const LocalFrame& local,
                 bool withNormals, CellSoup& soup) {
  if (hasTexture(texture, soup)) pushTexture(soup, texture.texture, texture.coordinates);
  for (size_t k = 0; k < 3; ++k) {
    pushCorner(soup, k, local(triangle.corners[k]), triangle.colours[k]);
    if (withNormals) soup.normals[k].push_back(triangle.normals[k]);
  }
}

void appendCut(const GridTriangle& triangle, const TriangleTexture& texture, const LocalFrame& local, bool withNormals,
               CellSoup& soup) {
  Polygon polygon;
  polygon.count = 3;
  for (int k = 0; k < 3; ++k) {
    const uint32_t colour = triangle.colours[k];
    polygon.corners[k] = {local(triangle.corners[k]), glm::dvec3(colour & 255, colour >> 8 & 255, colour >> 16 & 255),
                          withNormals ? unpackNormal(triangle.normals[k]) : glm::vec3(0),
                          glm::dvec2(texture.coordinates[k])};
  }
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) polygon = clipped(polygon, axis, sign);
  for (int i = 2; i < polygon.count; ++i) {
    const std::array<const Corner*, 3> fan = {&polygon.corners[0], &polygon.corners[i - 1], &polygon.corners[i]};
    if (hasTexture(texture, soup))
      pushTexture(soup, texture.texture,
                  {glm::vec2(fan[0]->coordinates), glm::vec2(fan[1]->coordinates), glm::vec2(fan[2]->coordinates)});
    for (size_t k = 0; k < 3; ++k) {
      pushCorner(soup, k, fan[k]->position, packColour(fan[k]->colour));
      if (withNormals) soup.normals[k].push_back(packNormal(fan[k]->normal));
    }
  }
}

// -1: outside the grown cube, 1: inside, 0: crosses its faces.
int placeOf(const GridBox& box, const LocalFrame& local) {
  const glm::dvec3 min = local(box.min), max = local(box.max);
  bool inside = true;
  for (int axis = 0; axis < 3; ++axis) {
    if (min[axis] > kCellGrowth || max[axis] < -kCellGrowth) return -1;
    inside = inside && min[axis] >= -kCellGrowth && max[axis] <= kCellGrowth;
  }
  return inside ? 1 : 0;
}

}  // namespace

std::vector<uint32_t> SoupSource::leavesInside(uint32_t cell) const {
  const LocalFrame local(model_.grid, tree_.cells[cell].key);
  std::vector<uint32_t> found, open = {0};
  while (!open.empty()) {
    const uint32_t index = open.back();
    open.pop_back();
    const CellRecord& record = tree_.cells[index];
    if (placeOf(record.content, local) < 0) continue;
    if (record.childCount == 0) found.push_back(index);
    for (uint32_t child = 0; child < record.childCount; ++child) open.push_back(record.firstChild + child);
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<uint32_t> SoupSource::leavesBelow(uint32_t cell) const {
  std::vector<uint32_t> found, open = {cell};
  while (!open.empty()) {
    const uint32_t index = open.back();
    open.pop_back();
    const CellRecord& record = tree_.cells[index];
    if (record.childCount == 0 && record.triangles > 0) found.push_back(index);
    for (uint32_t child = 0; child < record.childCount; ++child) open.push_back(record.firstChild + child);
  }
  std::sort(found.begin(), found.end());
  return found;
}

Result<> SoupSource::append(uint32_t cell, uint32_t leafCell, CellSoup& soup,
                            const std::function<Result<>()>& appended) const {
  const LocalFrame local(model_.grid, tree_.cells[cell].key);
  const bool withNormals = model_.hasNormals;
  const auto put = [&](const GridTriangleSpan& portion) -> Result<> {
    for (size_t i = 0; i < portion.size(); ++i) {
      const GridTriangle& triangle = portion.triangles[i];
      const int place = placeOf(boxOf(triangle), local);
      if (place < 0) continue;
      (place == 0 ? appendCut : appendWhole)(triangle, portion.texture(i), local, withNormals, soup);
    }
    return appended();
  };
  return partition_.triangles.forEachPortion(partition_.leaves[tree_.leafOf[leafCell]].list, kPortion, put);
}

}  // namespace farcell
