#include "tools/evaluate/plan/auto_cameras.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>

namespace farcell {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180;
constexpr int kCandidates = 4096;
constexpr double kLowestRad = 10 * kRadPerDeg;
constexpr double kHighestRad = 60 * kRadPerDeg;

// Directions spread evenly over the band of elevations: a Fibonacci lattice (Gonzalez, Measurement of Areas on a
// Sphere Using Fibonacci and Latitude-Longitude Lattices, 2010).
std::vector<glm::dvec3> candidateDirections(UpAxis axis) {
  const glm::dvec3 up = upVector(axis);
  const glm::dvec3 east(up.y, up.z, up.x), north = glm::cross(up, east);
  const double low = std::sin(kLowestRad), high = std::sin(kHighestRad);
  std::vector<glm::dvec3> directions;
  for (int i = 0; i < kCandidates; ++i) {
    const double sine = low + (high - low) * (i + 0.5) / kCandidates;
    const double azimuth = 2 * std::numbers::pi * std::fmod(i * std::numbers::phi, 1.0);
    const double cosine = std::sqrt(1 - sine * sine);
    directions.push_back(up * sine + (east * std::cos(azimuth) + north * std::sin(azimuth)) * cosine);
  }
  return directions;
}

double angleRad(glm::dvec3 a, glm::dvec3 b) { return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0)); }

double nearestAngleRad(glm::dvec3 direction, std::span<const glm::dvec3> others) {
  double nearest = std::numbers::pi;
  for (const glm::dvec3& other : others) nearest = std::min(nearest, angleRad(direction, other));
  return nearest;
}

// Those that are at least nine tenths as far from a baked direction as the farthest.
std::vector<glm::dvec3> betweenViews(std::vector<glm::dvec3> directions, const Viewpoints& viewpoints) {
  std::vector<double> angles;
  for (const glm::dvec3& direction : directions) angles.push_back(nearestAngleRad(direction, viewpoints.directions()));
  const double enough = 0.9 * *std::max_element(angles.begin(), angles.end());
  std::vector<glm::dvec3> kept;
  for (size_t i = 0; i < directions.size(); ++i)
    if (angles[i] >= enough) kept.push_back(directions[i]);
  return kept;
}

// The first is the first candidate; each next one lies farthest from those before.
std::vector<glm::dvec3> spreadDirections(const std::vector<glm::dvec3>& candidates, int count) {
  std::vector<double> nearest(candidates.size(), std::numbers::pi);
  std::vector<glm::dvec3> chosen;
  for (int i = 0; i < count; ++i) {
    const auto best = static_cast<size_t>(std::max_element(nearest.begin(), nearest.end()) - nearest.begin());
    chosen.push_back(candidates[best]);
    for (size_t c = 0; c < candidates.size(); ++c)
      nearest[c] = std::min(nearest[c], angleRad(candidates[c], candidates[best]));
  }
  return chosen;
}

nlohmann::ordered_json vectorJson(glm::dvec3 v) { return {v.x, v.y, v.z}; }

}  // namespace

std::vector<Camera> autoCameras(const Model& model, const Viewpoints& viewpoints, int count) {
  const glm::dvec3 min = model.grid.worldFromGrid(model.bounds.min), max = model.grid.worldFromGrid(model.bounds.max);
  const glm::dvec3 centre = (min + max) * 0.5;
  // A model without extent still has a root cube of some size.
  const double radius = std::max(glm::length(max - min) * 0.5, model.grid.side * 0.25);
  const auto candidates = betweenViews(candidateDirections(model.settings.up), viewpoints);
  std::vector<Camera> cameras;
  for (const glm::dvec3& direction : spreadDirections(candidates, count)) {
    const double diameters = kAutoCameraDistances[cameras.size() % std::size(kAutoCameraDistances)];
    Camera camera;
    camera.name = fmt::format("auto-{:02}-{}d", cameras.size() + 1, diameters);
    camera.target = centre;
    camera.position = centre + direction * (radius * (1 + 2 * diameters));
    camera.up = upVector(model.settings.up);
    camera.fovYRad = kAutoCameraFovYDeg * kRadPerDeg;
    cameras.push_back(camera);
  }
  return cameras;
}

std::string cameraFileText(const std::vector<Camera>& cameras) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Camera& camera : cameras) {
    list.push_back({{"name", camera.name},
                    {"position", vectorJson(camera.position)},
                    {"target", vectorJson(camera.target)},
                    {"up", vectorJson(camera.up)},
                    {"fovYDeg", camera.fovYRad / kRadPerDeg}});
  }
  return nlohmann::ordered_json{{"cameras", list}}.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace farcell
