// EXT_meshopt_compression: a buffer view whose bytes are coded by meshoptimizer.
#pragma once

#include <string>

#include "preprocess/read/gltf/byte_range.h"
#include "preprocess/read/gltf/place.h"

namespace farcell {

struct MeshoptCoding {
  uint32_t buffer = 0;
  uint64_t offset = 0;  // of the coded bytes in the buffer
  uint64_t size = 0;
  uint32_t stride = 0;  // of the decoded elements
  uint64_t count = 0;
  std::string mode;
  std::string filter;
};

// Whether the extension allows all this, it makes viewBytes, and the coded bytes can hold it (so that callers may
// allocate by it).
Result<> checkMeshoptCoding(const GltfPlace& place, const MeshoptCoding& coding, uint64_t viewBytes);
// REQUIRES: checked. `coded`: the bytes the coding names. Values - indices too - may be any: garbage decodes to
// garbage.
Result<std::vector<std::byte>> decodeMeshopt(const GltfPlace& place, const MeshoptCoding& coding,
                                             const ByteRange& coded);

}  // namespace farcell
