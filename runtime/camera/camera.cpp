#include "runtime/camera/camera.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cache/base/file.h"

namespace farcell {
namespace {

using Json = nlohmann::json;

constexpr uint64_t kMaxFileBytes = 1 << 20;
constexpr int kMaxDepth = 16;

// Nesting is bounded before the parser sees the text: its own structures recurse.
bool nestsTooDeep(const std::string& json) {
  int depth = 0;
  bool inString = false;
  for (size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (inString) {
      if (c == '\\') ++i;
      if (c == '"') inString = false;
    } else if (c == '"') {
      inString = true;
    } else if (c == '[' || c == '{') {
      if (++depth > kMaxDepth) return true;
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return false;
}

// Where a message points: the file and the camera in it.
struct Place {
  std::string file;
  std::string camera;

  template <class... Args>
  tl::unexpected<Error> fail(fmt::format_string<Args...> format, Args&&... args) const {
    return farcell::fail(ErrorKind::invalidArgument, "{}: {}: {}", file, camera,
                         fmt::format(format, std::forward<Args>(args)...));
  }
};

Result<const Json*> member(const Json& camera, const char* name, const Place& place) {
  const auto found = camera.find(name);
  if (found == camera.end()) return place.fail("member '{}' is missing", name);
  return &*found;
}

Result<double> readNumber(const Json& camera, const char* name, const Place& place) {
  FARCELL_ASSIGN(const Json* value, member(camera, name, place));
  if (!value->is_number()) return place.fail("{}: expected a number, found {}", name, value->type_name());
  const double number = value->get<double>();
  if (!std::isfinite(number)) return place.fail("{}: expected a finite number", name);
  return number;
}

Result<glm::dvec3> readVector(const Json& camera, const char* name, const Place& place) {
  FARCELL_ASSIGN(const Json* value, member(camera, name, place));
  if (!value->is_array() || value->size() != 3)
    return place.fail("{}: expected three numbers, found {}", name,
                      value->is_array() ? fmt::format("{} elements", value->size()) : std::string(value->type_name()));
  glm::dvec3 result;
  for (int axis = 0; axis < 3; ++axis) {
    const Json& element = (*value)[static_cast<size_t>(axis)];
    if (!element.is_number()) return place.fail("{}[{}]: expected a number, found {}", name, axis, element.type_name());
    result[axis] = element.get<double>();
    if (!std::isfinite(result[axis])) return place.fail("{}[{}]: expected a finite number", name, axis);
  }
  return result;
}

// Unit vector of any finite vector, however large or small its members; zero stays zero.
glm::dvec3 direction(glm::dvec3 v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return largest > 0 ? glm::normalize(v / largest) : glm::dvec3(0);
}

glm::dvec3 between(glm::dvec3 from, glm::dvec3 to) { return direction(to * 0.5 - from * 0.5); }

Result<Camera> readCamera(const Json& json, size_t index, const std::string& file) {
  Place place{file, fmt::format("camera {}", index)};
  if (!json.is_object()) return place.fail("expected an object, found {}", json.type_name());
  Camera camera;
  FARCELL_ASSIGN(const Json* name, member(json, "name", place));
  if (!name->is_string() || name->get_ref<const std::string&>().empty())
    return place.fail("name: expected a string that is not empty");
  camera.name = name->get<std::string>();
  place.camera = fmt::format("camera '{}'", camera.name);
  FARCELL_ASSIGN(camera.position, readVector(json, "position", place));
  FARCELL_ASSIGN(camera.target, readVector(json, "target", place));
  FARCELL_ASSIGN(camera.up, readVector(json, "up", place));
  FARCELL_ASSIGN(const double fovYDeg, readNumber(json, "fovYDeg", place));
  if (between(camera.position, camera.target) == glm::dvec3(0))
    return place.fail("target: expected a point other than position");
  if (direction(camera.up) == glm::dvec3(0)) return place.fail("up: expected a vector that is not zero");
  if (!(fovYDeg > 0 && fovYDeg < 180))
    return place.fail("fovYDeg: expected more than 0 and less than 180, found {}", fovYDeg);
  camera.fovYRad = fovYDeg * std::numbers::pi / 180;
  return camera;
}

Result<> checkNames(const std::vector<Camera>& cameras, const std::string& file) {
  for (size_t i = 0; i < cameras.size(); ++i)
    for (size_t j = 0; j < i; ++j)
      if (cameras[i].name == cameras[j].name)
        return fail(ErrorKind::invalidArgument, "{}: camera '{}': the name is used twice", file, cameras[i].name);
  return {};
}

Json vectorJson(glm::dvec3 v) { return {v.x, v.y, v.z}; }

}  // namespace

CameraAxes cameraAxes(const Camera& camera) {
  CameraAxes axes;
  axes.back = between(camera.target, camera.position);
  axes.right = glm::cross(direction(camera.up), axes.back);
  if (glm::length(axes.right) < 1e-9) {
    int least = 0;
    for (int axis = 1; axis < 3; ++axis)
      if (std::abs(axes.back[axis]) < std::abs(axes.back[least])) least = axis;
    glm::dvec3 up(0);
    up[least] = 1;
    axes.right = glm::cross(up, axes.back);
  }
  axes.right = glm::normalize(axes.right);
  axes.up = glm::cross(axes.back, axes.right);
  return axes;
}

Result<std::vector<Camera>> parseCameras(const std::string& json, const std::string& name) {
  if (json.size() > kMaxFileBytes)
    return fail(ErrorKind::exhausted, "{}: {} bytes, at most {} are allowed", name, json.size(), kMaxFileBytes);
  if (nestsTooDeep(json)) return fail(ErrorKind::invalidArgument, "{}: nested deeper than {} levels", name, kMaxDepth);
  try {
    const Json root = Json::parse(json);
    const auto list = root.is_object() ? root.find("cameras") : root.end();
    if (!root.is_object() || list == root.end() || !list->is_array())
      return fail(ErrorKind::invalidArgument, "{}: expected an object with an array 'cameras'", name);
    if (list->empty()) return fail(ErrorKind::invalidArgument, "{}: 'cameras' is empty", name);
    std::vector<Camera> cameras;
    for (const Json& item : *list) {
      FARCELL_ASSIGN(Camera camera, readCamera(item, cameras.size(), name));
      cameras.push_back(std::move(camera));
    }
    FARCELL_TRY(checkNames(cameras, name));
    return cameras;
  } catch (const Json::exception& error) {
    return fail(ErrorKind::invalidArgument, "{}: {}", name, error.what());
  }
}

Result<std::vector<Camera>> readCameras(const std::filesystem::path& path) {
  FARCELL_ASSIGN(const std::string text, readTextFile(path, kMaxFileBytes));
  return parseCameras(text, path.string());
}

std::string camerasJson(const std::vector<Camera>& cameras) {
  Json list = Json::array();
  for (const Camera& camera : cameras)
    list.push_back({{"name", camera.name},
                    {"position", vectorJson(camera.position)},
                    {"target", vectorJson(camera.target)},
                    {"up", vectorJson(camera.up)},
                    {"fovYDeg", camera.fovYRad * 180 / std::numbers::pi}});
  return Json{{"cameras", list}}.dump(2) + "\n";
}

}  // namespace farcell
