#include "tools/evaluate/path/camera_path.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cache/base/check.h"
#include "cache/base/file.h"

namespace farcell {
namespace {

using Json = nlohmann::json;

constexpr uint64_t kMaxFileBytes = 1 << 20;

Result<double> readSeconds(const Json& keyframe, const Camera& camera, const std::string& file) {
  const Json& time = keyframe.at("time");
  const double seconds = time.is_number() ? time.get<double>() : std::nan("");
  if (!std::isfinite(seconds))
    return fail(ErrorKind::invalidArgument, "{}: camera '{}': time: expected a finite number of seconds", file,
                camera.name);
  return seconds;
}

// What the spline carries from keyframe to keyframe.
constexpr size_t kValues = 10;
using Values = std::array<double, kValues>;

Values valuesOf(const Camera& camera) {
  const glm::dvec3 &p = camera.position, &t = camera.target, &u = camera.up;
  return {p.x, p.y, p.z, t.x, t.y, t.z, u.x, u.y, u.z, std::log(std::tan(camera.fovYRad / 2))};
}

Camera cameraOf(const Values& v, std::string name) {
  return {std::move(name), {v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8]}, 2 * std::atan(std::exp(v[9]))};
}

double stepSeconds(std::span<const Keyframe> keyframes, size_t i) {
  return keyframes[i + 1].seconds - keyframes[i].seconds;
}

double slope(std::span<const Keyframe> keyframes, size_t i, size_t value) {
  return (valuesOf(keyframes[i + 1].camera)[value] - valuesOf(keyframes[i].camera)[value]) / stepSeconds(keyframes, i);
}

// Per second, at a keyframe: of the parabola through it and its neighbours; at an end, through the nearest three.
double speed(std::span<const Keyframe> keyframes, size_t i, size_t value) {
  const size_t last = keyframes.size() - 1;
  if (last == 1) return slope(keyframes, 0, value);
  const size_t middle = std::clamp<size_t>(i, 1, last - 1);
  const double before = stepSeconds(keyframes, middle - 1), after = stepSeconds(keyframes, middle);
  const double low = slope(keyframes, middle - 1, value), high = slope(keyframes, middle, value);
  const double bend = (high - low) / (before + after);  // half the parabola's second derivative
  const double atMiddle = low + bend * before;
  return i < middle ? atMiddle - 2 * bend * before : i > middle ? atMiddle + 2 * bend * after : atMiddle;
}

// Cubic Hermite between keyframes i and i + 1.
Values valuesAt(std::span<const Keyframe> keyframes, size_t i, double seconds) {
  const double length = stepSeconds(keyframes, i), t = (seconds - keyframes[i].seconds) / length;
  const Values from = valuesOf(keyframes[i].camera), to = valuesOf(keyframes[i + 1].camera);
  Values result{};
  for (size_t v = 0; v < kValues; ++v) {
    const double start = speed(keyframes, i, v) * length, end = speed(keyframes, i + 1, v) * length;
    const double move = to[v] - from[v];
    result[v] = from[v] + t * (start + t * (3 * move - 2 * start - end + t * (start + end - 2 * move)));
  }
  return result;
}

Result<> checkFrame(const Camera& camera, const Values& values) {
  if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); }))
    return fail(ErrorKind::invalidArgument, "path, {}: a number that is not finite", camera.name);
  if (camera.position == camera.target)
    return fail(ErrorKind::invalidArgument, "path, {}: the target meets the position", camera.name);
  return {};
}

}  // namespace

Result<std::vector<Keyframe>> parseKeyframes(const std::string& json, const std::string& name) {
  FARCELL_ASSIGN(const std::vector<Camera> cameras, parseCameras(json, name));
  const Json list = Json::parse(json).at("cameras");  // parseCameras() took it
  const auto timed = std::count_if(list.begin(), list.end(), [](const Json& item) { return item.contains("time"); });
  if (cameras.size() < 2) return fail(ErrorKind::invalidArgument, "{}: a path needs two cameras or more", name);
  std::vector<Keyframe> keyframes;
  for (const Camera& camera : cameras) {
    const Json& item = list[keyframes.size()];
    Keyframe keyframe{camera, static_cast<double>(keyframes.size())};
    if (timed > 0 && !item.contains("time"))
      return fail(ErrorKind::invalidArgument, "{}: camera '{}': member 'time' is missing, others have it", name,
                  camera.name);
    if (timed > 0) {
      FARCELL_ASSIGN(keyframe.seconds, readSeconds(item, camera, name));
    }
    if (!keyframes.empty() && !(keyframe.seconds > keyframes.back().seconds))
      return fail(ErrorKind::invalidArgument, "{}: camera '{}': time: expected more than {}, found {}", name,
                  camera.name, keyframes.back().seconds, keyframe.seconds);
    keyframes.push_back(std::move(keyframe));
  }
  return keyframes;
}

Result<std::vector<Keyframe>> readKeyframes(const std::filesystem::path& path) {
  FARCELL_ASSIGN(const std::string text, readTextFile(path, kMaxFileBytes));
  return parseKeyframes(text, path.string());
}

Result<std::vector<Camera>> pathFrames(std::span<const Keyframe> keyframes, int count) {
  FARCELL_CHECK(keyframes.size() >= 2 && count >= 2 && count <= kMaxPathFrames);
  const double first = keyframes.front().seconds, last = keyframes.back().seconds;
  std::vector<Camera> frames;
  size_t segment = 0;
  for (int frame = 0; frame < count; ++frame) {
    const double share = static_cast<double>(frame) / (count - 1), seconds = first * (1 - share) + last * share;
    while (segment + 2 < keyframes.size() && seconds >= keyframes[segment + 1].seconds) ++segment;
    const Values values = valuesAt(keyframes, segment, seconds);
    frames.push_back(cameraOf(values, fmt::format("frame {}", frame)));
    FARCELL_TRY(checkFrame(frames.back(), values));
  }
  return frames;
}

}  // namespace farcell
