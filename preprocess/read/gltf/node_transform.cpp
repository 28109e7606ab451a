#include "preprocess/read/gltf/node_transform.h"

#include <tiny_gltf.h>

#include <cmath>

namespace farcell {
namespace {

Result<GltfTransform> fromMatrix(const GltfPlace& place, std::span<const double> m) {
  constexpr double kTolerance = 1e-6;  // of writers that went through floats
  const double off = std::abs(m[3]) + std::abs(m[7]) + std::abs(m[11]) + std::abs(m[15] - 1);
  if (off > kTolerance)
    return place.in("matrix").bad("a last row of 0 0 0 1", fmt::format("{} {} {} {}", m[3], m[7], m[11], m[15]));
  const auto column = [&](size_t i) { return glm::dvec3(m[4 * i], m[4 * i + 1], m[4 * i + 2]); };
  return GltfTransform{glm::dmat3(column(0), column(1), column(2)), column(3)};
}

}  // namespace

GltfTransform fromTrs(glm::dvec3 translation, glm::dvec4 rotation, glm::dvec3 scale) {
  // Scaled first: the square of a component may be too large or too small for a double.
  const double largest =
      std::max({std::abs(rotation.x), std::abs(rotation.y), std::abs(rotation.z), std::abs(rotation.w)});
  const glm::dvec4 unit = glm::normalize(rotation / largest);
  glm::dmat3 linear = glm::mat3_cast(glm::dquat(unit.w, unit.x, unit.y, unit.z));
  for (int i = 0; i < 3; ++i) linear[i] *= scale[i];
  return {linear, translation};
}

GltfTransform operator*(const GltfTransform& outer, const GltfTransform& inner) {
  // As they are where nothing is to be done: 0 * infinity would be no number.
  if (outer.isIdentity()) return inner;
  if (inner.isIdentity()) return outer;
  return {outer.linear * inner.linear, outer.linear * inner.offset + outer.offset};
}

Result<GltfTransform> nodeTransform(const GltfPlace& place, const tinygltf::Node& node) {
  if (!node.matrix.empty()) return fromMatrix(place, node.matrix);
  const auto& t = node.translation;
  const auto& r = node.rotation;
  const auto& s = node.scale;
  const glm::dvec4 rotation = r.empty() ? glm::dvec4(0, 0, 0, 1) : glm::dvec4(r[0], r[1], r[2], r[3]);
  if (rotation == glm::dvec4(0)) return place.in("rotation").bad("a unit quaternion", "zeros");
  return fromTrs(t.empty() ? glm::dvec3(0) : glm::dvec3(t[0], t[1], t[2]), rotation,
                 s.empty() ? glm::dvec3(1) : glm::dvec3(s[0], s[1], s[2]));
}

}  // namespace farcell
