// What the shaders need of one impostor, computed in double and relative to the eye.
#pragma once

#include "runtime/draw/frame_camera.h"
#include "runtime/draw/view_store.h"

namespace farcell {

// A view and its direction (Viewpoints::directions). Empty views (layer < 0) are never hit.
struct DirectedView {
  glm::dvec3 direction;
  ResidentView view;
};

shared::ImpostorInstance makeImpostorInstance(const Model& model, const CellRecord& cell, const DirectedView& nearest,
                                              const DirectedView& second, const FrameCamera& camera);

}  // namespace farcell
