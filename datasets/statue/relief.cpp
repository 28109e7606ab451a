#include "datasets/statue/relief.h"

#include <glm/geometric.hpp>

namespace farcell {
namespace {

// How far towards the corners' tangent planes a point is drawn (Boubekeur, Alexa, Phong Tessellation, 2008). They take
// 3/4; half way is exact for a paraboloid, and makes neither cones nor dents of the corners.
constexpr double kRounding = 0.5;

}  // namespace

PlyVertex Relief::vertex(const SurfacePoint& point) const {
  glm::dvec3 flat(0), normal(0);
  std::array<double, 3> colour{};
  for (size_t i = 0; i < 3; ++i) {
    const double weight = point.weights[i];
    flat += weight * base_.positions[point.corners[i]];
    normal += weight * base_.normals[point.corners[i]];
    for (size_t channel = 0; channel < 3; ++channel)
      colour[channel] += weight * base_.colours[point.corners[i]][channel];
  }
  glm::dvec3 round = flat;
  for (size_t i = 0; i < 3; ++i) {
    const uint32_t corner = point.corners[i];
    const glm::dvec3 tilt = base_.normals[corner] * glm::dot(flat - base_.positions[corner], base_.normals[corner]);
    round -= tilt * (point.weights[i] * kRounding * static_cast<double>(base_.roundness[corner]));
  }
  const double length = glm::length(normal);
  const StonePoint stone = stone_.at(round);
  // Where opposite faces cancel there is no outside: such points stay.
  const glm::dvec3 moved = length > 0 ? round + normal * (stone.height / length) : round;
  const std::array<uint8_t, 3> albedo = {static_cast<uint8_t>(colour[0] + 0.5), static_cast<uint8_t>(colour[1] + 0.5),
                                         static_cast<uint8_t>(colour[2] + 0.5)};
  return {base_.middle + moved * base_.diagonal, stone_.colour(albedo, round, stone.cavity)};
}

}  // namespace farcell
