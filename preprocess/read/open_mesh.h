// Any mesh file as a stream of triangles.
#pragma once

#include <filesystem>
#include <memory>

#include "preprocess/mesh/mesh_reader.h"

namespace farcell {

// Chosen by content (PLY magic) and name (.ply, .obj). unsupported for other formats, named in the message.
Result<std::unique_ptr<MeshReader>> openMesh(const std::filesystem::path& path);

}  // namespace farcell
