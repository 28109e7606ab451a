// Wavefront OBJ: v (with optional colour), vt, vn, f, usemtl and mtllib (Kd, map_Kd); everything else is passed over.
#pragma once

#include <memory>

#include "cache/base/file.h"
#include "preprocess/mesh/mesh_reader.h"
#include "preprocess/mesh/read_memory.h"

namespace farcell {

// Reads the whole file once (vertices are kept, faces counted and checked); each pass over the triangles reads the
// faces again.
Result<std::unique_ptr<MeshReader>> openObj(InputFile file, const std::shared_ptr<ReadMemory>& memory);

}  // namespace farcell
