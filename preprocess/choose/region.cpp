#include "preprocess/choose/region.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "cache/base/file.h"
#include "preprocess/read/scene/scene_json.h"

namespace farcell {
namespace {

// A straight piece of a path is covered by at most as many boxes: along a diagonal, one would hold much beside the way.
constexpr int kMaxBoxesPerSegment = 16;
constexpr size_t kMaxElements = 100'000;

WorldBox around(glm::dvec3 a, glm::dvec3 b, double radius) {
  return {glm::min(a, b) - radius, glm::max(a, b) + radius};
}

Result<WorldBox> box(const SceneValue& value) {
  FARCELL_TRY(value.expectMembers({"min", "max"}));
  if (!value.has("min") || !value.has("max")) return value.bad("an object of min and max");
  WorldBox result;
  FARCELL_ASSIGN(result.min, value.member("min").vector());
  FARCELL_ASSIGN(result.max, value.member("max").vector());
  for (int axis = 0; axis < 3; ++axis)
    if (result.min[axis] > result.max[axis])
      return value.bad("min of at most max on each axis",
                       fmt::format("{} and {} on axis {}", result.min[axis], result.max[axis], axis));
  return result;
}

Result<std::vector<WorldBox>> boxes(const SceneValue& value) {
  FARCELL_ASSIGN(const size_t count, value.objectCount(kMaxElements));
  std::vector<WorldBox> result(count);
  for (size_t i = 0; i < count; ++i) {
    FARCELL_ASSIGN(result[i], box(value.element(i)));
  }
  return result;
}

// In model units; 0 where the file names none.
Result<double> radius(const SceneValue& value, double metresPerUnit) {
  if (!value.has("radius")) return 0;
  FARCELL_ASSIGN(const double metres, value.member("radius").number());
  const double units = metres / metresPerUnit;
  if (!(metres >= 0) || !std::isfinite(units)) return value.member("radius").bad("metres, 0 or more");
  return units;
}

Result<std::vector<WorldBox>> cameras(const SceneValue& value, double around_) {
  FARCELL_ASSIGN(const size_t count, value.objectCount(kMaxElements));
  std::vector<WorldBox> result(count);
  for (size_t i = 0; i < count; ++i) {
    const SceneValue camera = value.element(i);
    if (!camera.json().is_object() || !camera.has("position")) return camera.bad("an object with a position");
    FARCELL_ASSIGN(const glm::dvec3 position, camera.member("position").vector());
    result[i] = around(position, position, around_);
  }
  return result;
}

void addSegment(glm::dvec3 from, glm::dvec3 to, double radius, std::vector<WorldBox>& result) {
  const glm::dvec3 along = to * 0.5 - from * 0.5;  // half of it: the whole may overflow
  const double halfLength = glm::length(along);
  const bool thin = !(halfLength / kMaxBoxesPerSegment < radius);
  const int pieces = thin ? kMaxBoxesPerSegment : std::max(1, static_cast<int>(std::ceil(halfLength / radius)));
  const auto at = [&](int i) { return i == pieces ? to : from + along * (2.0 * i / pieces); };
  for (int i = 0; i < pieces; ++i) result.push_back(around(at(i), at(i + 1), radius));
}

Result<std::vector<WorldBox>> path(const SceneValue& value, double radius) {
  FARCELL_ASSIGN(const size_t count, value.objectCount(kMaxElements));
  std::vector<WorldBox> result;
  glm::dvec3 before(0);
  for (size_t i = 0; i < count; ++i) {
    FARCELL_ASSIGN(const glm::dvec3 point, value.element(i).vector());
    if (i > 0) addSegment(before, point, radius, result);
    before = point;
  }
  if (count == 1) result.push_back(around(before, before, radius));
  return result;
}

Result<std::vector<WorldBox>> boxesOf(const SceneValue& root, double metresPerUnit) {
  if (root.json().is_object()) {
    if (root.has("boxes")) {
      FARCELL_TRY(root.expectMembers({"boxes"}));
      return boxes(root.member("boxes"));
    }
    if (root.has("path") || root.has("cameras")) {
      const char* member = root.has("path") ? "path" : "cameras";
      FARCELL_TRY(root.expectMembers({member, "radius"}));
      FARCELL_ASSIGN(const double units, radius(root, metresPerUnit));
      return (member == std::string_view("path") ? path : cameras)(root.member(member), units);
    }
    if (root.has("min") || root.has("max")) {
      FARCELL_ASSIGN(const WorldBox only, box(root));
      return std::vector<WorldBox>{only};
    }
  }
  return root.bad("an object of min and max, of boxes, of a path or of cameras");
}

bool finite(const WorldBox& box) {
  for (int axis = 0; axis < 3; ++axis)
    if (!std::isfinite(box.min[axis]) || !std::isfinite(box.max[axis])) return false;
  return true;
}

}  // namespace

Result<Region> regionFromJson(const std::string& text, const std::string& file, double metresPerUnit) {
  FARCELL_ASSIGN(const nlohmann::json json, parseSceneJson(text, file));
  const SceneValue root(file, "region", json);
  Region region{Region::Kind::boxes, {}};
  FARCELL_ASSIGN(region.boxes, boxesOf(root, metresPerUnit));
  for (const WorldBox& box : region.boxes)
    if (!finite(box)) return root.bad("places that can be computed with", "numbers too large");
  return region;
}

Result<Region> readRegion(const std::string& name, double metresPerUnit) {
  if (name == "everywhere") return Region{};
  if (name == "above-ground") return Region{Region::Kind::aboveGround, {}};
  FARCELL_ASSIGN(const std::string text, readTextFile(name, kMaxRegionFileBytes));
  return regionFromJson(text, name, metresPerUnit);
}

}  // namespace farcell
