// How every generated model is written: binary little-endian PLY of coloured triangles, its counts known beforehand.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "cache/base/result.h"

namespace farcell {

struct PlyLayout {
  std::string comment;  // one line
  uint64_t vertices = 0;
  uint64_t triangles = 0;
  bool isWide = false;  // coordinates are doubles, not floats
};

// unsupported when there are more vertices than 32-bit indices can name (some 4 billion).
Result<> checkPlyLayout(const PlyLayout& layout);
// x y z, uchar red green blue; faces. Indices are int as long as they fit, else uint.
std::string plyHeader(const PlyLayout& layout);
uint64_t plyBytes(const PlyLayout& layout);  // of the whole file

struct PlyVertex {
  glm::dvec3 position{0};  // rounded once where coordinates are floats
  std::array<uint8_t, 3> colour{};
};

// Appended to `out`.
void putPlyVertices(std::span<const PlyVertex> vertices, bool isWide, std::vector<std::byte>& out);
void putPlyFaces(std::span<const std::array<uint32_t, 3>> faces, uint64_t firstVertex, std::vector<std::byte>& out);

}  // namespace farcell
