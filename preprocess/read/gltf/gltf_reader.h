// glTF 2.0, as text (.gltf) or binary (.glb).
//
// 1. readContainer finds the JSON and the binary chunk; parseJsonText and takeShape make sure of its size, depth and
//    kinds; loadModel has tinygltf turn the rest into structures, without the bytes.
// 2. GltfBuffers opens what the file names; readInstances flattens the nodes; readPrimitive checks every index and
//    extent of what will be read. All this is done when the file is opened; values are looked at as a pass meets them.
// 3. A pass takes one primitive after the other: its vertices page by page as they are asked for (elementsOf,
//    primitiveVertices), its indices as a stream, once for each place where its mesh stands (emitTriangles).
//
// What cannot be paged must fit the memory (ReadOptions), else exhausted: the JSON while the file is opened, data URIs,
// sparse accessors, views compressed by EXT_meshopt_compression and parts compressed by Draco, one of each at a time.
#pragma once

#include <memory>

#include "cache/base/file.h"
#include "preprocess/mesh/mesh_reader.h"
#include "preprocess/mesh/read_memory.h"

namespace farcell {

// The magic bytes of a .glb.
bool startsLikeGltf(const InputFile& file);
Result<std::unique_ptr<MeshReader>> openGltf(InputFile file, const std::shared_ptr<ReadMemory>& memory);

}  // namespace farcell
