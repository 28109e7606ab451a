// The vertices of one file while its faces are streamed, in bounded memory (paged_rows.h).
#pragma once

#include <cstdint>
#include <cstring>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>

#include "preprocess/mesh/mesh_reader.h"
#include "preprocess/mesh/paged_rows.h"

namespace farcell {

inline constexpr uint32_t kNoColour = 0xff000000u;

struct Vertex {
  glm::dvec3 position{0};
  uint32_t colour = kNoColour;  // 0x00BBGGRR
  glm::vec3 normal{0};
  glm::vec2 textureCoordinates{0};
};

// What a row holds: the position, then the colour, the normal and the texture coordinates.
struct VertexShape {
  bool isWide = false;  // positions are doubles; else floats, half as many bytes
  bool hasColours = false;
  bool hasNormals = false;
  bool hasTextureCoordinates = false;

  constexpr uint32_t positionBytes() const { return isWide ? sizeof(glm::dvec3) : sizeof(glm::vec3); }
  constexpr uint32_t normalOffset() const { return positionBytes() + (hasColours ? 4u : 0u); }
  constexpr uint32_t textureOffset() const { return normalOffset() + (hasNormals ? 12u : 0u); }
  constexpr uint32_t rowBytes() const { return textureOffset() + (hasTextureCoordinates ? 8u : 0u); }
  // Writes the row of a vertex; a narrow position is rounded to floats.
  void put(const Vertex& vertex, std::byte* row) const;
};

class Vertices {
 public:
  // To be appended.
  Vertices(std::shared_ptr<ReadMemory> memory, VertexShape shape)
      : shape_(shape), rows_(std::make_unique<PagedRows>(std::move(memory), shape.rowBytes())) {}
  // `count` that `load` makes rows of.
  static Result<Vertices> loaded(std::shared_ptr<ReadMemory> memory, VertexShape shape, uint64_t count,
                                 PagedRows::Load load);

  const VertexShape& shape() const { return shape_; }
  uint64_t count() const { return rows_->count(); }
  Result<> append(const Vertex& vertex);
  // Gives each vertex the colour made of its own.
  Result<> recolour(const std::function<uint32_t(uint32_t)>& colourOf);
  // Why corners are worth nothing.
  const std::optional<Error>& failure() const { return rows_->memory()->failure(); }

  // Sets what the vertices have of corner `i`. REQUIRES: index < count().
  void copyCorner(uint64_t index, size_t i, InputTriangle& triangle) const {
    const std::byte* row = rows_->row(index);
    if (shape_.isWide)
      std::memcpy(&triangle.positions[i], row, sizeof(glm::dvec3));
    else
      triangle.positions[i] = glm::dvec3(load<glm::vec3>(row));
    if (shape_.hasColours) triangle.colours[i] = load<uint32_t>(row + shape_.positionBytes());
    if (shape_.hasNormals) triangle.normals[i] = load<glm::vec3>(row + shape_.normalOffset());
    if (shape_.hasTextureCoordinates) triangle.textureCoordinates[i] = load<glm::vec2>(row + shape_.textureOffset());
  }
  void prefetch(uint64_t index) const { rows_->prefetch(index); }

 private:
  Vertices(VertexShape shape, std::unique_ptr<PagedRows> rows) : shape_(shape), rows_(std::move(rows)) {}
  template <class T>
  static T load(const std::byte* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
  }

  VertexShape shape_;
  std::unique_ptr<PagedRows> rows_;
};

// Channels in [0, 1], clamped; NaN gives 0. 0x00BBGGRR.
uint32_t packColour(double red, double green, double blue);
// kDefaultAlbedo of cache/schema/model.h.
uint32_t defaultColour();

}  // namespace farcell
