#include "preprocess/encode/geometry_page.h"

#include <cstring>
#include <unordered_map>

#include "cache/base/hash.h"

namespace farcell {
namespace {

struct Vertex {
  glm::uvec3 position;
  uint32_t colour;
  uint32_t normal;
  bool operator==(const Vertex&) const = default;
};

struct VertexHash {
  size_t operator()(const Vertex& vertex) const { return hashBytes(std::as_bytes(std::span(&vertex, 1))); }
};

}  // namespace

GeometryPage geometryPage(std::span<const GridTriangle> triangles, GridPoint cellMin, const Model& model) {
  GeometryPage page;
  std::unordered_map<Vertex, uint32_t, VertexHash> indexOf;
  indexOf.reserve(triangles.size());
  for (const GridTriangle& triangle : triangles) {
    for (int k = 0; k < 3; ++k) {
      const Vertex vertex{glm::uvec3(triangle.corners[k] - cellMin), triangle.colours[k], triangle.normals[k]};
      const auto [entry, added] = indexOf.try_emplace(vertex, static_cast<uint32_t>(page.positions.size()));
      page.indices.push_back(entry->second);
      if (!added) continue;
      page.positions.push_back(vertex.position);
      if (model.hasColours) page.colours.push_back(vertex.colour);
      if (model.hasNormals) page.normals.push_back(vertex.normal);
    }
  }
  return page;
}

}  // namespace farcell
