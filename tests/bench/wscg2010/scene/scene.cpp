#include "tests/bench/wscg2010/scene/scene.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "cache/base/check.h"
#include "preprocess/read/open_mesh.h"

namespace farcell::wscg {
namespace {

// The root cube is this much larger than the box, so that no triangle lies on its faces.
constexpr double kMargin = 1e-5;

glm::vec3 faceNormal(const std::array<glm::vec3, 3>& corners) {
  const glm::dvec3 a(corners[0]);
  const glm::dvec3 normal = glm::cross(glm::dvec3(corners[1]) - a, glm::dvec3(corners[2]) - a);
  const double length = glm::length(normal);
  return length > 0 ? glm::vec3(normal / length) : glm::vec3(0, 0, 1);
}

struct Box {
  glm::dvec3 min{INFINITY}, max{-INFINITY};
  void include(glm::dvec3 p) {
    min = glm::min(min, p);
    max = glm::max(max, p);
  }
};

// From the file's coordinates to the root cube's.
struct ToRoot {
  glm::dvec3 centre;
  double scale;

  explicit ToRoot(const Box& box) : centre((box.min + box.max) * 0.5) {
    const glm::dvec3 size = box.max - box.min;
    scale = 2 / ((1 + kMargin) * std::max({size.x, size.y, size.z, 1e-300}));
  }
  glm::vec3 operator()(glm::dvec3 p) const { return glm::vec3((p - centre) * scale); }
};

void describe(Scene& scene, UpAxis up) {
  Box box;
  for (Triangle& triangle : scene.triangles) {
    triangle.normal = faceNormal(triangle.corners);
    for (const glm::vec3& corner : triangle.corners) box.include(glm::dvec3(corner));
  }
  scene.min = glm::vec3(box.min);
  scene.max = glm::vec3(box.max);
  scene.centre = (box.min + box.max) * 0.5;
  scene.radius = glm::length(box.max - box.min) * 0.5;
  scene.sun = sunDirection(up, Sun{});
  scene.up = upVector(up);
}

}  // namespace

Result<Scene> loadScene(const std::filesystem::path& path, UpAxis up) {
  FARCELL_ASSIGN(const auto reader, openMesh(path));
  if (reader->info().declaredTriangles > kMaxTriangles)
    return fail(ErrorKind::exhausted, "{}: {} triangles, at most {} fit this experiment", path.string(),
                reader->info().declaredTriangles, kMaxTriangles);
  Box box;
  const auto measure = [&](std::span<const InputTriangle> batch) -> Result<> {
    for (const InputTriangle& triangle : batch)
      for (const glm::dvec3& position : triangle.positions) box.include(position);
    return {};
  };
  FARCELL_ASSIGN(const MeshCounts counts, reader->forEachTriangle(measure));
  if (counts.accepted == 0) return fail(ErrorKind::invalidArgument, "{}: no triangle to draw", path.string());
  Scene scene;
  scene.name = path.stem().string();
  scene.triangles.reserve(counts.accepted);
  const ToRoot toRoot(box);
  const auto keep = [&](std::span<const InputTriangle> batch) -> Result<> {
    for (const InputTriangle& triangle : batch) {
      Triangle& own = scene.triangles.emplace_back();
      for (size_t k = 0; k < 3; ++k) own.corners[k] = toRoot(triangle.positions[k]);
      own.colours = triangle.colours;
    }
    return {};
  };
  FARCELL_TRY(reader->forEachTriangle(keep));
  describe(scene, up);
  return scene;
}

Scene sceneOf(std::string name, std::vector<Triangle> triangles, UpAxis up) {
  FARCELL_CHECK(!triangles.empty());
  Box box;
  for (const Triangle& triangle : triangles)
    for (const glm::vec3& corner : triangle.corners) box.include(glm::dvec3(corner));
  Scene scene;
  scene.name = std::move(name);
  scene.triangles = std::move(triangles);
  const ToRoot toRoot(box);
  for (Triangle& triangle : scene.triangles)
    for (glm::vec3& corner : triangle.corners) corner = toRoot(glm::dvec3(corner));
  describe(scene, up);
  return scene;
}

}  // namespace farcell::wscg
