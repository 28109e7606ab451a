// Any mesh file, or several, as a stream of triangles.
#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "preprocess/mesh/mesh_reader.h"
#include "preprocess/mesh/read_memory.h"

namespace farcell {

// Chosen by content where that is certain, whatever the name (PLY, GLB, OFF, binary STL), else by name: .ply,
// .obj, .stl, .off, .gltf, .glb, and .json for a scene (scene/scene_file.h). unsupported for other formats, named in
// the message.
Result<std::unique_ptr<MeshReader>> openMesh(const std::filesystem::path& path, const ReadOptions& options = {});

// Several files, each as openMesh opens it, as one model (scene/scene_reader.h). invalidArgument when there is none.
Result<std::unique_ptr<MeshReader>> openMeshes(std::span<const std::filesystem::path> paths,
                                               const ReadOptions& options = {});
// The same, in a memory that tells how much of it is used.
Result<std::unique_ptr<MeshReader>> openMeshes(std::span<const std::filesystem::path> paths,
                                               const std::shared_ptr<ReadMemory>& memory);

}  // namespace farcell
