// A camera that moves: keyframes and the smooth way through them.
//
// A path file is a camera file (runtime/camera/camera.h) whose cameras are the keyframes, in order. Their member
// "time", seconds, must rise from one to the next; all of them have it, or none: then they are one second apart.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "cache/base/result.h"
#include "runtime/camera/camera.h"

namespace farcell {

inline constexpr int kMaxPathFrames = 10'000;

struct Keyframe {
  Camera camera;
  double seconds = 0;
};

// Errors name the file, the camera and the member.
Result<std::vector<Keyframe>> readKeyframes(const std::filesystem::path& path);
Result<std::vector<Keyframe>> parseKeyframes(const std::string& json, const std::string& name);

// `count` frames at even steps of time from the first keyframe to the last, both included. Position, target, up and the
// logarithm of the picture's height at distance 1 each follow the Catmull-Rom spline through the keyframes (Catmull,
// Rom, A class of local interpolating splines, 1974) for uneven times: a cubic between two keyframes, whose speed at a
// keyframe is that of the parabola through it and its neighbours; a straight line between two alone. invalidArgument,
// with the frame: a target that meets the position, or a number that is not finite. REQUIRES: two keyframes or more,
// with rising times; 2 <= count <= kMaxPathFrames.
Result<std::vector<Camera>> pathFrames(std::span<const Keyframe> keyframes, int count);

}  // namespace farcell
