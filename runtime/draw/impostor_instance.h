// What the shaders need of one impostor, computed in double and relative to the eye.
#pragma once

#include <array>

#include "runtime/draw/frame_camera.h"
#include "runtime/draw/view_store.h"

namespace farcell {

// A view, its direction (Viewpoints::directions) and its weight where views are blended. Empty views (layer < 0) are
// never hit.
struct DirectedView {
  uint32_t index = kNone;  // kNone: no view
  glm::dvec3 direction{0, 0, 1};
  ResidentView view;
  double weight = 0;
};
using ImpostorViews = std::array<DirectedView, shared::kImpostorViews>;

// shares: CutEntry::shares.
shared::ImpostorInstance makeImpostorInstance(const Model& model, const CellRecord& cell, const ImpostorViews& views,
                                              uint8_t shares, const FrameCamera& camera);

}  // namespace farcell
