#include "tests/bench/wscg2010/scene/cameras.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "cache/base/check.h"
#include "cache/schema/viewpoints.h"

namespace farcell::wscg {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180;
constexpr int kGaps = 42;

std::vector<glm::dvec3> gapsBetween(const Scene& scene, double lowDeg, double highDeg) {
  const auto gaps = Viewpoints::create(kGaps);
  FARCELL_CHECK(gaps.has_value());
  std::vector<glm::dvec3> kept;
  for (const glm::dvec3& direction : gaps->directions()) {
    const double elevationDeg = std::asin(glm::dot(direction, scene.up)) / kRadPerDeg;
    if (elevationDeg >= lowDeg && elevationDeg <= highDeg) kept.push_back(direction);
  }
  FARCELL_CHECK(!kept.empty());
  return kept;
}

}  // namespace

Camera orbitCamera(const Scene& scene, glm::dvec3 direction, double distance, double fovDeg) {
  Camera camera;
  camera.target = scene.centre;
  camera.position = scene.centre + direction * (scene.radius * (1 + 2 * distance));
  camera.up = scene.up;
  camera.fovYRad = fovDeg * kRadPerDeg;
  return camera;
}

std::vector<glm::dvec3> levelDirections(const Scene& scene, int count) {
  const auto candidates = gapsBetween(scene, 0, 35);
  std::vector<glm::dvec3> chosen;
  std::vector<double> nearest(candidates.size(), 2);  // distance to the chosen ones; each next one lies farthest
  while (static_cast<int>(chosen.size()) < count) {
    const auto best = static_cast<size_t>(std::max_element(nearest.begin(), nearest.end()) - nearest.begin());
    chosen.push_back(candidates[best]);
    for (size_t i = 0; i < candidates.size(); ++i)
      nearest[i] = std::min(nearest[i], glm::length(candidates[i] - candidates[best]));
  }
  return chosen;
}

glm::dvec3 steepDirection(const Scene& scene) { return gapsBetween(scene, 45, 75).front(); }

std::vector<ErrorCamera> errorCameras(const Scene& scene, const std::vector<double>& distances, int levelCount) {
  std::vector<ErrorCamera> cameras;
  for (const double distance : distances) {
    int number = 0;
    for (const glm::dvec3& direction : levelDirections(scene, levelCount)) {
      cameras.push_back({orbitCamera(scene, direction, distance), distance, false});
      cameras.back().camera.name = fmt::format("level-{}-{}d", ++number, distance);
    }
    cameras.push_back({orbitCamera(scene, steepDirection(scene), distance), distance, true});
    cameras.back().camera.name = fmt::format("steep-{}d", distance);
  }
  return cameras;
}

}  // namespace farcell::wscg
