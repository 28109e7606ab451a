// Any mesh file as a stream of triangles.
#pragma once

#include <filesystem>
#include <memory>

#include "preprocess/mesh/mesh_reader.h"

namespace farcell {

// Chosen by content (magic of PLY and GLB) and name (.ply, .obj, .gltf, .glb). unsupported for other formats, named in
// the message.
Result<std::unique_ptr<MeshReader>> openMesh(const std::filesystem::path& path);

}  // namespace farcell
