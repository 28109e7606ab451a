#include "tools/evaluate/path/generated_path.h"

#include <fmt/format.h>

#include <numbers>

#include "tools/evaluate/path/model_frame.h"
#include "tools/evaluate/path/random.h"
#include "tools/evaluate/path/street.h"

namespace farcell {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180;
constexpr double kFovYRad = 40 * kRadPerDeg;

glm::dvec3 directionAt(const ModelFrame& model, double azimuthRad, double elevationRad) {
  const glm::dvec3 horizontal = model.east * std::cos(azimuthRad) + model.north * std::sin(azimuthRad);
  return horizontal * std::cos(elevationRad) + model.up * std::sin(elevationRad);
}

Camera towardsCentre(const ModelFrame& model, glm::dvec3 position, int frame) {
  return {fmt::format("frame {}", frame), position, model.centre, model.up, kFovYRad};
}

std::vector<Camera> orbit(const ModelFrame& model, int count, std::mt19937& random) {
  const double azimuth = drawn(random, 0, 2 * std::numbers::pi);
  const double elevation = drawn(random, 10, 50) * kRadPerDeg;
  std::vector<Camera> frames;
  for (int frame = 0; frame < count; ++frame) {
    const glm::dvec3 direction = directionAt(model, azimuth + frame * kOrbitStepDeg * kRadPerDeg, elevation);
    frames.push_back(towardsCentre(model, model.centre + direction * (3 * model.radius), frame));
  }
  return frames;
}

std::vector<Camera> flyby(const ModelFrame& model, int count, std::mt19937& random) {
  const double azimuth = drawn(random, 0, 2 * std::numbers::pi);
  const glm::dvec3 nearest = directionAt(model, azimuth, drawn(random, 10, 40) * kRadPerDeg) * (1.5 * model.radius);
  const glm::dvec3 along = directionAt(model, azimuth + std::numbers::pi / 2, 0) * (3 * model.radius);
  std::vector<Camera> frames;
  for (int frame = 0; frame < count; ++frame) {
    const double share = 2.0 * frame / (count - 1) - 1;
    frames.push_back(towardsCentre(model, model.centre + nearest + along * share, frame));
  }
  return frames;
}

}  // namespace

bool isGeneratedPath(std::string_view name) { return name == "orbit" || name == "flyby" || name == "street"; }

Result<std::vector<Camera>> generatedPath(std::string_view name, const PackFile& pack, int count, uint32_t seed) {
  std::mt19937 random(seed);
  const ModelFrame model = modelFrame(pack.directory().model);
  if (name == "orbit") return orbit(model, count, random);
  if (name == "flyby") return flyby(model, count, random);
  return streetPath(pack, count, random);
}

}  // namespace farcell
