// A node that stands for many (EXT_mesh_gpu_instancing).
#pragma once

#include "preprocess/read/gltf/scene.h"

namespace tinygltf {
class Node;
}

namespace farcell {

// Appends what the node's mesh stands for: one instance, or those of the extension.
Result<> addInstances(const GltfPlace& place, const tinygltf::Node& node, const GltfTransform& worldFromNode,
                      GltfBuffers& buffers, GltfAccessors& accessors, std::vector<GltfTransform>& instances);

}  // namespace farcell
