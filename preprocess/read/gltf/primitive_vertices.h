// The vertices of one primitive in memory, as its triangles need them.
#pragma once

#include "preprocess/read/gltf/primitive.h"

namespace farcell {

struct PrimitiveVertices {
  std::vector<glm::vec3> positions;  // as in the file; divided by `divisor` they are the mesh's
  double divisor = 1;
  std::vector<glm::vec3> normals;  // empty: none
  std::vector<uint32_t> colours;   // 0x00BBGGRR, display values; empty: all as `colour`
  uint32_t colour = 0;
  std::vector<glm::vec2> textureCoordinates;  // v up; empty: none
};

struct VertexWindow {
  uint64_t first = 0;
  uint64_t count = 0;
};

// `out` keeps its memory from one call to the next.
Result<> loadVertices(const PrimitiveElements& elements, const GltfPrimitive& primitive, VertexWindow window,
                      PrimitiveVertices& out);

}  // namespace farcell
