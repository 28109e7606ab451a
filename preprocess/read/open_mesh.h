// Any mesh file, or several, as a stream of triangles.
#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "preprocess/mesh/mesh_reader.h"

namespace farcell {

// Chosen by content where that is certain, whatever the name (PLY, GLB, OFF, binary STL), else by name: .ply,
// .obj, .stl, .off, .gltf, .glb, and .json for a scene (scene/scene_file.h). unsupported for other formats, named in
// the message.
Result<std::unique_ptr<MeshReader>> openMesh(const std::filesystem::path& path);

// Several files, each as openMesh opens it, as one model (scene/scene_reader.h). invalidArgument when there is none.
Result<std::unique_ptr<MeshReader>> openMeshes(std::span<const std::filesystem::path> paths);

}  // namespace farcell
