// KHR_draco_mesh_compression: a primitive whose vertices and indices are coded together.
#pragma once

#include "preprocess/read/gltf/accessors.h"

namespace farcell {

// Whether this build has libdraco.
extern const bool kHasDraco;

struct DracoAttribute {
  uint32_t id = 0;    // "unique id" in the coded bytes
  Elements elements;  // in: type and numbers as the accessor says; out: the decoded bytes too
};

struct DracoMesh {
  uint64_t points = 0;
  uint64_t faces = 0;
  std::vector<DracoAttribute> attributes;
  Elements indices;  // out: uint32
};

// `mesh`: what the accessors of the primitive promise, filled with what the coded bytes hold. corrupt where they
// differ; exhausted where the bytes are too few to hold it. The library decodes all of it at once: a part must fit the
// memory, at about 160 bytes a triangle, and has at most 16 Mi of them.
Result<> decodeDraco(const GltfPlace& place, const ByteRange& coded, GltfBuffers& buffers, DracoMesh& mesh);

}  // namespace farcell
