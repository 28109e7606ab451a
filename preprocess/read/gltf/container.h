// What a .gltf or .glb file is made of: JSON text and, in a .glb, bytes that its first buffer may name.
#pragma once

#include <optional>
#include <string>

#include "preprocess/read/gltf/byte_range.h"

namespace farcell {

struct GltfContainer {
  std::string json;
  uint64_t jsonOffset = 0;          // in the file
  std::optional<ByteRange> binary;  // of the file
};

bool startsLikeGlb(const InputFile& file);
// A file that starts like a GLB is one; any other is taken for JSON. `file` must outlive the container.
Result<GltfContainer> readContainer(const InputFile& file);

}  // namespace farcell
