// One node's own transform.
#pragma once

#include <glm/gtc/quaternion.hpp>

#include "preprocess/read/gltf/place.h"
#include "preprocess/read/gltf/scene.h"

namespace tinygltf {
class Node;
}

namespace farcell {

// From its matrix, or translation, rotation and scale.
Result<GltfTransform> nodeTransform(const GltfPlace& place, const tinygltf::Node& node);

// Translation * rotation * scale; `rotation` (x, y, z, w) of any length but none at all.
GltfTransform fromTrs(glm::dvec3 translation, glm::dvec4 rotation, glm::dvec3 scale);
// outer(inner(point)).
GltfTransform operator*(const GltfTransform& outer, const GltfTransform& inner);

}  // namespace farcell
