// Cameras for measuring a pack where its impostors are weakest: between the directions its views were baked from.
#pragma once

#include <string>
#include <vector>

#include "cache/schema/model.h"
#include "cache/schema/viewpoints.h"
#include "runtime/camera/camera.h"

namespace farcell {

inline constexpr double kAutoCameraFovYDeg = 40;
// In diameters of the bounding sphere, from its surface; cameras take these in turn.
inline constexpr double kAutoCameraDistances[] = {.25, .5, 1, 2, 4, 8};

// `count` cameras that look at the centre of the model, 10 to 60 degrees above its horizon, each about as far from any
// baked direction as that allows and far from each other. The same for the same model and viewpoints. Names hold the
// distance: "auto-03-1d".
std::vector<Camera> autoCameras(const Model& model, const Viewpoints& viewpoints, int count);

// As a camera file holds them (camera.h); doubles survive exactly, the field of view within rounding.
std::string cameraFileText(const std::vector<Camera>& cameras);

}  // namespace farcell
