// The identity of what a pack was built from.
#pragma once

#include "preprocess/mesh/mesh_reader.h"

namespace farcell {

// Of one file: XXH3-64 of its bytes. Of several: XXH3-64 of their hashes, eight bytes each, little-endian, in the order
// of MeshReader::files(). Reads every file whole.
Result<uint64_t> sourceHash(const MeshReader& mesh);

}  // namespace farcell
