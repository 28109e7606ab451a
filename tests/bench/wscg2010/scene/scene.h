// The model of the experiment: all triangles in memory, scaled so that the root cube of the octree is [-1, 1]^3.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "cache/base/result.h"
#include "cache/schema/model.h"

namespace farcell::wscg {

struct Triangle {
  std::array<glm::vec3, 3> corners;
  std::array<uint32_t, 3> colours;  // albedo, 0x00BBGGRR
  glm::vec3 normal;                 // unit, the face's own: everything is shaded flat
};

struct Scene {
  std::string name;
  std::vector<Triangle> triangles;
  glm::vec3 min{0}, max{0};  // box of the triangles; its longest side is that of the root cube
  glm::dvec3 centre{0};      // of the bounding sphere, and its radius
  double radius = 1;
  glm::vec3 sun{0, 0, 1};
  glm::dvec3 up{0, 0, 1};
};

// A mesh file; more than kMaxTriangles are refused (exhausted).
inline constexpr size_t kMaxTriangles = 8'000'000;
Result<Scene> loadScene(const std::filesystem::path& path, UpAxis up);

// The same of triangles in any coordinates (their normals are computed). REQUIRES: at least one triangle.
Scene sceneOf(std::string name, std::vector<Triangle> triangles, UpAxis up);

}  // namespace farcell::wscg
