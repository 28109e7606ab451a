#include "runtime/draw/gpu_mesh.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

#include "cache/schema/model.h"
#include "shaders/shared/shading.h"

namespace farcell {
namespace {

uint32_t packedDefaultAlbedo() {
  return kDefaultAlbedo[0] | static_cast<uint32_t>(kDefaultAlbedo[1]) << 8 |
         static_cast<uint32_t>(kDefaultAlbedo[2]) << 16;
}

uint32_t packedOctahedral(glm::vec3 unit) {
  const glm::vec2 p = shared::octahedralFromUnit(unit);
  const auto snorm = [](float v) { return static_cast<uint16_t>(static_cast<int16_t>(std::lround(v * 32767.0f))); };
  return static_cast<uint32_t>(snorm(p.x)) | static_cast<uint32_t>(snorm(p.y)) << 16;
}

// Gives each triangle a last corner that carries its normal.
void assignFlatNormals(GpuMesh& mesh, std::span<const uint32_t> shown) {
  std::vector<bool> owned(mesh.vertices.size(), false);
  for (size_t first = 0; first < mesh.indices.size(); first += 3) {
    const std::array<uint32_t, 3> corners = {mesh.indices[first], mesh.indices[first + 1], mesh.indices[first + 2]};
    const uint32_t normal = packedOctahedral(faceNormal(
        mesh.vertices[corners[0]].position, mesh.vertices[corners[1]].position, mesh.vertices[corners[2]].position));
    const auto same = [&](const GpuVertex& vertex) {
      return shown.empty() ? vertex.normal == normal : vertex.colour == shown[first / 3];
    };
    size_t chosen = 3;
    for (size_t i = 0; i < 3 && chosen == 3; ++i)
      if (!owned[corners[i]] || same(mesh.vertices[corners[i]])) chosen = i;
    const size_t last = chosen == 3 ? 2 : chosen;
    mesh.indices[first] = corners[(last + 1) % 3];
    mesh.indices[first + 1] = corners[(last + 2) % 3];
    mesh.indices[first + 2] = corners[last];
    if (chosen == 3) {
      mesh.indices[first + 2] = static_cast<uint32_t>(mesh.vertices.size());
      mesh.vertices.push_back(mesh.vertices[corners[last]]);
      if (!mesh.coordinates.empty()) mesh.coordinates.push_back(mesh.coordinates[corners[last]]);
      owned.push_back(true);
    }
    owned[mesh.indices[first + 2]] = true;
    mesh.vertices[mesh.indices[first + 2]].normal = normal;
    if (!shown.empty()) mesh.vertices[mesh.indices[first + 2]].colour = kShown | shown[first / 3];
  }
}

}  // namespace

glm::vec3 faceNormal(GridPoint a, GridPoint b, GridPoint c) {
  // Edges are below 2^25 steps: products and their differences fit 64 bits.
  const std::array<int64_t, 3> u = {b.x - a.x, b.y - a.y, b.z - a.z};
  const std::array<int64_t, 3> v = {c.x - a.x, c.y - a.y, c.z - a.z};
  const glm::dvec3 cross(static_cast<double>(u[1] * v[2] - u[2] * v[1]), static_cast<double>(u[2] * v[0] - u[0] * v[2]),
                         static_cast<double>(u[0] * v[1] - u[1] * v[0]));
  const double length = glm::length(cross);
  return length > 0 ? glm::vec3(cross / length) : glm::vec3(0, 0, 1);
}

double atlasEdgesPerStep(const GeometryPage& page) {
  if (page.coordinates.empty()) return 0;
  const auto onAtlas = [&](uint32_t vertex) { return glm::dvec2(unpackedCoordinates(page.coordinates[vertex])); };
  double onImage = 0, surface = 0;  // twice the areas
  for (size_t i = 0; i + 2 < page.indices.size(); i += 3) {
    const uint32_t a = page.indices[i], b = page.indices[i + 1], c = page.indices[i + 2];
    const glm::dvec2 u = onAtlas(b) - onAtlas(a), v = onAtlas(c) - onAtlas(a);
    const double area = std::abs(u.x * v.y - u.y * v.x);
    if (area == 0) continue;
    const glm::dvec3 from(page.positions[a]);
    onImage += area;
    surface += glm::length(glm::cross(glm::dvec3(page.positions[b]) - from, glm::dvec3(page.positions[c]) - from));
  }
  return surface > 0 ? std::sqrt(onImage / surface) : 0;
}

GpuMesh makeGpuMesh(const GeometryPage& page, GridPoint origin) {
  GpuMesh mesh;
  mesh.vertices.resize(page.positions.size());
  const uint32_t albedo = packedDefaultAlbedo();
  for (size_t i = 0; i < page.positions.size(); ++i) {
    GpuVertex& vertex = mesh.vertices[i];
    vertex.position = origin + GridPoint(page.positions[i]);
    const uint32_t colour = page.colours.empty() ? albedo : page.colours[i];
    vertex.colour = (colour & ~kSeenFromFront) | ((colour & kSeenFromFront) != 0 ? kLitFront : kLit);
    if (!page.normals.empty()) vertex.normal = page.normals[i];
  }
  mesh.coordinates = page.coordinates;
  mesh.indices = page.indices;
  if (page.normals.empty()) assignFlatNormals(mesh, page.shown);
  return mesh;
}

}  // namespace farcell
