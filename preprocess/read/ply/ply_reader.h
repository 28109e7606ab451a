// PLY: ASCII and binary of both byte orders, polygons ("face") and triangle strips ("tristrips").
#pragma once

#include <memory>

#include "cache/base/file.h"
#include "preprocess/mesh/mesh_reader.h"
#include "preprocess/mesh/read_memory.h"

namespace farcell {

// Reads the header, the vertices where they are not of one size, and, once, the face rows: a file that contradicts
// itself fails here, not later.
Result<std::unique_ptr<MeshReader>> openPly(InputFile file, const std::shared_ptr<ReadMemory>& memory);

}  // namespace farcell
