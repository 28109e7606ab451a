#include "preprocess/encode/geometry_page.h"

#include <bit>

namespace farcell {
namespace {

struct Vertex {
  glm::uvec3 position;
  uint32_t colour;
  uint32_t normal;
  uint32_t coordinates;
  bool operator==(const Vertex&) const = default;
};

// Vertices by their value, numbered as they come: an open table of 2^n slots, at most half of them used.
class VertexNumbers {
 public:
  explicit VertexNumbers(size_t expected) : slots_(std::bit_ceil(2 * expected + 2), kFree) {
    vertices_.reserve(expected);
  }

  uint32_t numberOf(const Vertex& vertex) {
    size_t slot = firstSlot(vertex);
    while (slots_[slot] != kFree && vertices_[slots_[slot]] != vertex) slot = (slot + 1) & (slots_.size() - 1);
    if (slots_[slot] != kFree) return slots_[slot];
    const auto number = static_cast<uint32_t>(vertices_.size());
    slots_[slot] = number;
    vertices_.push_back(vertex);
    if (2 * vertices_.size() > slots_.size()) grow();
    return number;
  }

  const std::vector<Vertex>& vertices() const { return vertices_; }

 private:
  static constexpr uint32_t kFree = ~0u;

  size_t firstSlot(const Vertex& vertex) const {
    constexpr uint64_t kOdd = 0x9e3779b97f4a7c15;
    uint64_t hash = 0;
    for (const uint32_t word :
         {vertex.position.x, vertex.position.y, vertex.position.z, vertex.colour, vertex.normal, vertex.coordinates})
      hash = std::rotl((hash ^ word) * kOdd, 29);
    return (hash * kOdd >> 32) & (slots_.size() - 1);
  }

  void grow() {
    slots_.assign(2 * slots_.size(), kFree);
    for (uint32_t number = 0; number < vertices_.size(); ++number) {
      size_t slot = firstSlot(vertices_[number]);
      while (slots_[slot] != kFree) slot = (slot + 1) & (slots_.size() - 1);
      slots_[slot] = number;
    }
  }

  std::vector<uint32_t> slots_;
  std::vector<Vertex> vertices_;
};

}  // namespace

GeometryPage geometryPage(std::span<const GridTriangle> triangles, GridPoint cellMin, const Model& model,
                          std::span<const std::array<uint32_t, 3>> coordinates) {
  GeometryPage page;
  page.indices.reserve(3 * triangles.size());
  VertexNumbers numbers(triangles.size());
  for (size_t i = 0; i < triangles.size(); ++i)
    for (size_t k = 0; k < 3; ++k)
      page.indices.push_back(numbers.numberOf({glm::uvec3(triangles[i].corners[k] - cellMin), triangles[i].colours[k],
                                               triangles[i].normals[k], coordinates.empty() ? 0 : coordinates[i][k]}));
  for (const Vertex& vertex : numbers.vertices()) {
    page.positions.push_back(vertex.position);
    if (model.hasColours) page.colours.push_back(vertex.colour);
    if (model.hasNormals) page.normals.push_back(vertex.normal);
    if (!coordinates.empty()) page.coordinates.push_back(vertex.coordinates);
  }
  return page;
}

}  // namespace farcell
