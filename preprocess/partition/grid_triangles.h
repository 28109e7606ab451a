// Triangles on the model's grid, as lists of them are kept in memory and in scratch.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "cache/schema/grid.h"
#include "preprocess/mesh/texture_source.h"

namespace farcell {

// 60 bytes, as kept in scratch files.
struct GridTriangle {
  std::array<GridPoint, 3> corners;
  std::array<uint32_t, 3> colours;  // 0x00BBGGRR
  std::array<uint32_t, 3> normals;  // octahedral as in GeometryPage; 0 when the model has none
};

// What a triangle with a texture has besides; 28 bytes more.
struct TriangleTexture {
  uint32_t texture = kNoTexture;
  std::array<glm::vec2, 3> coordinates{};  // mesh_reader.h
};

// Part of a list.
struct GridTriangleSpan {
  std::span<const GridTriangle> triangles;
  std::span<const TriangleTexture> textures;  // one a triangle; empty when none of them has a texture

  size_t size() const { return triangles.size(); }
  TriangleTexture texture(size_t i) const { return textures.empty() ? TriangleTexture{} : textures[i]; }
};

// A list. Triangles without textures cost nothing for those that have one as long as the list holds none of these.
struct GridTriangles {
  std::vector<GridTriangle> triangles;
  std::vector<TriangleTexture> textures;  // as in GridTriangleSpan

  size_t size() const { return triangles.size(); }
  void add(const GridTriangle& triangle, const TriangleTexture& texture) {
    if (texture.texture != kNoTexture && textures.empty()) textures.resize(triangles.size());
    if (texture.texture != kNoTexture || !textures.empty()) textures.push_back(texture);
    triangles.push_back(triangle);
  }
  void clear() {
    triangles.clear();
    textures.clear();
  }
  operator GridTriangleSpan() const { return {triangles, textures}; }
};

}  // namespace farcell
