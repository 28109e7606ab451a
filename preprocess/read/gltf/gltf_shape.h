// What is read of glTF 2.0, member by member.
#pragma once

#include "preprocess/read/gltf/json_shape.h"

namespace farcell {

// Morph targets, skins, animations, cameras and lights are not read: a mesh is shown as its own vertices and the
// transforms of its nodes place it. Nor are a material's alphaMode and doubleSided, or the alpha of its images:
// surfaces are opaque here, and seen from both sides.
const JsonShape& gltfShape();

}  // namespace farcell
