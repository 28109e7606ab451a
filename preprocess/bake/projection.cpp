#include "preprocess/bake/projection.h"

#include <algorithm>
#include <tuple>

namespace farcell::bake {

Projection projectionOf(const ViewFrame& frame, const SampleImage& image) {
  Projection projection{};
  const double samplesPerHalfSide = image.sampleEdge / (2 * kViewHalfExtent);
  for (int axis = 0; axis < 3; ++axis) {
    projection.right[axis] = static_cast<float>(frame.right[axis] * samplesPerHalfSide);
    projection.up[axis] = static_cast<float>(frame.up[axis] * samplesPerHalfSide);
    projection.toward[axis] = static_cast<float>(frame.toward[axis]);
  }
  projection.snap = 1.5f * static_cast<float>(std::bit_ceil(static_cast<unsigned>(image.sampleEdge)));
  projection.halfEdge = 0.5f * static_cast<float>(image.sampleEdge);
  const auto& [x, y, z] = std::tie(frame.toward.x, frame.toward.y, frame.toward.z);
  projection.isAntipode = z < 0 || (z == 0 && (y < 0 || (y == 0 && x < 0)));
  return projection;
}

float imagePosition(glm::vec3 point, const float (&axis)[3], const Projection& projection) {
  const float position = point.x * axis[0] + (point.y * axis[1] + point.z * axis[2]);
  return (std::clamp(position, -projection.halfEdge, projection.halfEdge) + projection.snap) - projection.snap;
}

}  // namespace farcell::bake
