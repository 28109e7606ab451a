// The vertices of one primitive, as its triangles need them.
#pragma once

#include "preprocess/mesh/vertices.h"
#include "preprocess/read/gltf/primitive.h"

namespace farcell {

struct PrimitiveVertices {
  Vertices vertices;    // display values; positions as in the file
  double divisor = 1;   // positions divided by it are the mesh's
  uint32_t colour = 0;  // 0x00BBGGRR, display values: of all, where the vertices have none
};

// Loaded from where the elements lie when they are asked for.
Result<PrimitiveVertices> primitiveVertices(const PrimitiveElements& elements, const GltfPrimitive& primitive,
                                            const std::shared_ptr<ReadMemory>& memory);

}  // namespace farcell
