// Paths for a model of which nobody has one: the same for the same pack, number of frames and seed.
#pragma once

#include <string_view>
#include <vector>

#include "cache/pack/pack_file.h"
#include "runtime/camera/camera.h"

namespace farcell {

inline constexpr const char* kGeneratedPaths = "orbit, flyby, street";
bool isGeneratedPath(std::string_view name);

inline constexpr double kOrbitStepDeg = 0.5;  // a frame

// orbit: around the centre, one diameter of the bounding sphere from its surface, 10 to 50 degrees above the horizon,
// half
//   a degree around the up axis a frame.
// flyby: a horizontal line past the model, seen all the time: from three radii before to three radii after the nearest
//   point, which is a quarter of a diameter from the sphere's surface.
// street: straight ahead near the ground (street.h).
// The seed draws directions and places. REQUIRES: isGeneratedPath(name); count >= 2. Fails as reading the pack does.
Result<std::vector<Camera>> generatedPath(std::string_view name, const PackFile& pack, int count, uint32_t seed);

}  // namespace farcell
