// PLY: ASCII and binary of both byte orders, polygons ("face") and triangle strips ("tristrips").
#pragma once

#include <memory>

#include "cache/base/file.h"
#include "preprocess/mesh/mesh_reader.h"

namespace farcell {

// Reads the header, the vertices and, once, the face rows: a file that contradicts itself fails here, not later.
Result<std::unique_ptr<MeshReader>> openPly(InputFile file);

}  // namespace farcell
