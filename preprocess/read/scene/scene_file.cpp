#include "preprocess/read/scene/scene_file.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "cache/base/file.h"
#include "preprocess/read/scene/scene_json.h"
#include "preprocess/read/scene/scene_reader.h"

namespace farcell {
namespace {

constexpr double kMaxScale = 1e12;

// Of any finite vector that is not zero.
glm::dvec3 unitOf(glm::dvec3 v) { return glm::normalize(v / std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)})); }

// Sine and cosine, exact where they are 0, 1 or -1.
glm::dvec2 sineCosine(double angleDeg) {
  const double angle = std::remainder(angleDeg, 360);
  if (angle == 0) return {0, 1};
  if (std::abs(angle) == 90) return {angle / 90, 0};
  if (std::abs(angle) == 180) return {0, -1};
  const double rad = angle * std::numbers::pi / 180;
  return {std::sin(rad), std::cos(rad)};
}

// Rodrigues: the matrix of a turn about a unit vector.
glm::dmat3 turn(glm::dvec3 axis, glm::dvec2 sineCosine) {
  const glm::dmat3 cross(0, axis.z, -axis.y, -axis.z, 0, axis.x, axis.y, -axis.x, 0);
  return glm::dmat3(sineCosine.y) + cross * sineCosine.x + glm::outerProduct(axis, axis) * (1 - sineCosine.y);
}

Result<glm::dmat3> quaternion(const SceneValue& value) {
  FARCELL_TRY(value.expectNumbers(4));
  std::array<double, 4> q{};
  double largest = 0;
  for (size_t i = 0; i < q.size(); ++i) {
    FARCELL_ASSIGN(q[i], value.element(i).number());
    largest = std::max(largest, std::abs(q[i]));
  }
  if (largest == 0) return value.bad("a quaternion that is not zero", "[0, 0, 0, 0]");
  const glm::dvec3 v = glm::dvec3(q[0], q[1], q[2]) / largest;
  const double w = q[3] / largest;
  const double sine = glm::length(v);  // of half the angle, times the length of the quaternion
  if (sine == 0) return glm::dmat3(1);
  const double square = sine * sine + w * w;
  return turn(unitOf(v), {2 * sine * w / square, (w * w - sine * sine) / square});
}

Result<glm::dmat3> rotation(const SceneValue& value) {
  if (value.json().is_array()) return quaternion(value);
  if (!value.json().is_object() || !value.has("axis") || !value.has("angleDeg"))
    return value.bad("four numbers (a quaternion) or an object of axis and angleDeg");
  FARCELL_TRY(value.expectMembers({"axis", "angleDeg"}));
  FARCELL_ASSIGN(const glm::dvec3 axis, value.member("axis").vector());
  FARCELL_ASSIGN(const double angleDeg, value.member("angleDeg").number());
  if (axis == glm::dvec3(0)) return value.member("axis").bad("a vector that is not zero", "[0, 0, 0]");
  return turn(unitOf(axis), sineCosine(angleDeg));
}

Result<double> factor(const SceneValue& value) {
  FARCELL_ASSIGN(const double factor, value.number());
  if (std::abs(factor) >= 1 / kMaxScale && std::abs(factor) <= kMaxScale) return factor;
  return value.bad(fmt::format("a factor of {} to {} in magnitude", 1 / kMaxScale, kMaxScale));
}

Result<glm::dvec3> scale(const SceneValue& value) {
  if (!value.json().is_array()) return factor(value).map([](double all) { return glm::dvec3(all); });
  FARCELL_TRY(value.expectNumbers(3));
  glm::dvec3 scale;
  for (int axis = 0; axis < 3; ++axis) {
    FARCELL_ASSIGN(scale[axis], factor(value.element(static_cast<size_t>(axis))));
  }
  return scale;
}

Result<Placement> placement(const SceneValue& value) {
  Pose pose;
  if (value.has("translation")) {
    FARCELL_ASSIGN(pose.translation, value.member("translation").vector());
  }
  if (value.has("rotation")) {
    FARCELL_ASSIGN(pose.rotation, rotation(value.member("rotation")));
  }
  if (value.has("scale")) {
    FARCELL_ASSIGN(pose.scale, scale(value.member("scale")));
  }
  return Placement(pose);
}

Result<std::vector<Placement>> placements(const SceneValue& file, size_t limit) {
  FARCELL_ASSIGN(const Placement own, placement(file));
  if (!file.has("instances")) return std::vector<Placement>{own};
  const SceneValue instances = file.member("instances");
  FARCELL_ASSIGN(const size_t count, instances.objectCount(limit));
  std::vector<Placement> placements;
  for (size_t i = 0; i < count; ++i) {
    const SceneValue instance = instances.element(i);
    FARCELL_TRY(instance.expectMembers({"translation", "rotation", "scale"}));
    FARCELL_ASSIGN(const Placement then, placement(instance));
    placements.push_back(own.then(then));
  }
  return placements;
}

Result<SceneFile> sceneFile(const SceneValue& value, const std::filesystem::path& directory, size_t limit) {
  FARCELL_TRY(value.expectMembers({"path", "translation", "rotation", "scale", "instances"}));
  if (!value.has("path")) return value.bad("a member path");
  FARCELL_ASSIGN(const std::string name, value.member("path").string());
  FARCELL_ASSIGN(std::vector<Placement> placed, placements(value, limit));
  return SceneFile{directory / name, std::move(placed)};
}

Result<UpAxis> upAxis(const SceneValue& value) {
  FARCELL_ASSIGN(const std::string name, value.string());
  if (const std::optional<UpAxis> up = upAxisNamed(name)) return *up;
  return value.bad("x, y or z");
}

Result<double> metresPerUnit(const SceneValue& value) {
  double metres = 0;
  if (value.json().is_string()) metres = metresOfUnit(value.json().get_ref<const std::string&>()).value_or(0);
  if (value.json().is_number()) metres = value.json().get<double>();
  if (metres > 0 && std::isfinite(metres)) return metres;
  return value.bad("mm, cm, m, km, in, ft or a positive number of metres");
}

}  // namespace

Result<Scene> readScene(const std::filesystem::path& path) {
  const std::string name = path.string();
  FARCELL_ASSIGN(const std::string text, readTextFile(path, kMaxSceneBytes));
  FARCELL_ASSIGN(const nlohmann::json json, parseSceneJson(text, name));
  const SceneValue root(name, "scene", json);
  FARCELL_TRY(root.expectMembers({"up", "unit", "files"}));
  if (!root.has("files")) return root.bad("a member files");
  Scene scene;
  if (root.has("up")) {
    FARCELL_ASSIGN(scene.up, upAxis(root.member("up")));
  }
  if (root.has("unit")) {
    FARCELL_ASSIGN(scene.metresPerUnit, metresPerUnit(root.member("unit")));
  }
  const SceneValue files = root.member("files");
  FARCELL_ASSIGN(const size_t count, files.objectCount(kMaxSceneFiles));
  size_t placed = 0;
  for (size_t i = 0; i < count; ++i) {
    FARCELL_ASSIGN(SceneFile file, sceneFile(files.element(i), path.parent_path(), kMaxPlacements - placed));
    placed += std::min(file.placements.size(), kMaxPlacements - placed);
    scene.files.push_back(std::move(file));
  }
  return scene;
}

}  // namespace farcell
