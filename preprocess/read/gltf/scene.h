// Where the meshes of a glTF file stand: its nodes as flat transforms.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "preprocess/read/gltf/accessors.h"

namespace tinygltf {
class Model;
}

namespace farcell {

// world = linear * mesh + offset.
struct GltfTransform {
  glm::dmat3 linear{1};
  glm::dvec3 offset{0};

  bool isIdentity() const { return linear == glm::dmat3(1) && offset == glm::dvec3(0); }
  bool isMirrored() const;
  // Turns directions across surfaces: the inverse transpose up to a positive factor, which exists where the inverse
  // does not.
  glm::dmat3 normalMatrix() const;
};

// For each mesh, its instances, in the order of the nodes: those below the roots of the default scene; of all scenes,
// where no scene is the default; below all nodes without a parent, where there is no scene. EXT_mesh_gpu_instancing
// makes several of one node. corrupt for cycles, nodes of several parents, and transforms that are not affine;
// exhausted for trees too deep.
Result<std::vector<std::vector<GltfTransform>>> readInstances(const tinygltf::Model& model, GltfBuffers& buffers,
                                                              GltfAccessors& accessors);

}  // namespace farcell
