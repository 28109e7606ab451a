// Small packs for tests of the runtime: a few triangles cut into cells of one level, views from a brute-force baker
// that shares no code with preprocess/.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <vector>

#include "cache/base/result.h"
#include "cache/pack/directory.h"

namespace farcell {

struct SyntheticTriangle {
  std::array<glm::dvec3, 3> corners;  // world
  uint32_t colour = 0x00ffffff;       // 0x00BBGGRR
};

struct SyntheticPack {
  int level = 1;  // of all leaves
  int views = 42;
  int imageSize = 64;
  int samplesPerEdge = 3;  // of a texel
  bool withViews = true;
  bool withInnerViews = true;
  Lighting lighting = Lighting::baked;
  Sun sun = {};
  std::vector<int> leftOut = {};  // views that no cell has
  UpAxis up = UpAxis::z;
};

// Writes the pack. The grid is gridAround the triangles; corners move to the nearest grid point.
Result<> writeSyntheticPack(const std::filesystem::path& path, const std::vector<SyntheticTriangle>& triangles,
                            const SyntheticPack& settings);

// An axis-aligned box, 12 triangles of one colour.
std::vector<SyntheticTriangle> boxTriangles(glm::dvec3 min, glm::dvec3 max, uint32_t colour);
// A sphere of 8 * 4^subdivisions triangles with corners on the sphere.
std::vector<SyntheticTriangle> sphereTriangles(glm::dvec3 centre, double radius, int subdivisions, uint32_t colour);

}  // namespace farcell
