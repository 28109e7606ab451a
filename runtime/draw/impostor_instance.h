// What the shaders need of one impostor, computed in double and relative to the eye.
#pragma once

#include "runtime/draw/frame_camera.h"
#include "runtime/draw/view_store.h"

namespace farcell {

// `direction`: of the view (Viewpoints::directions). REQUIRES: the view is not empty.
shared::ImpostorInstance makeImpostorInstance(const Model& model, const CellRecord& cell, glm::dvec3 direction,
                                              const ResidentView& view, const FrameCamera& camera);

}  // namespace farcell
