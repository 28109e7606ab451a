// The triangles of one primitive, for every place where it stands.
#pragma once

#include "preprocess/mesh/triangle_batch.h"
#include "preprocess/read/gltf/primitive_vertices.h"
#include "preprocess/read/gltf/scene.h"

namespace farcell {

// Vertices once loaded, for the next primitive that has the same.
class VertexCache {
 public:
  explicit VertexCache(std::shared_ptr<ReadMemory> memory) : memory_(std::move(memory)) {}

  // Gives back the memory of other vertices than those of `primitive`.
  void makeRoomFor(const GltfPrimitive& primitive);
  Result<const PrimitiveVertices*> load(const PrimitiveElements& elements, const GltfPrimitive& primitive);

 private:
  std::shared_ptr<ReadMemory> memory_;
  std::optional<GltfPrimitive> loaded_;
  std::optional<PrimitiveVertices> vertices_;
};

// Triangles into the batch, until it has failed. corrupt for an index that restarts (the largest of its type).
Result<> emitTriangles(const GltfPlace& place, const GltfPrimitive& primitive, const PrimitiveElements& elements,
                       std::span<const GltfTransform> instances, VertexCache& cache, TriangleBatch& batch);

}  // namespace farcell
