// A statue of any size: a coarse closed surface, subdivided and given the relief of weathered stone at every scale. The
// same for the same settings on every machine and with any number of threads.
//
// How it comes about: 1. the coarse surface is a figure of our own (moai.h, made a mesh by surface_nets.h) or a mesh
// from elsewhere, put together by base_mesh.h; 2. subdivision.h numbers the vertices and faces of the fine one;
// 3. relief.h gives each vertex its place by its number alone: on the rounded surface (Phong tessellation), moved along
// the smooth normal by the fractal noise of stone.h; 4. statue.cpp writes them part by part.
#pragma once

#include <cstdint>
#include <filesystem>

#include "cache/base/progress.h"
#include "cache/base/result.h"
#include "datasets/statue/base_mesh.h"

namespace farcell {

struct StatueSettings {
  uint64_t triangles = 5'000'000;  // wished; what is made is within 5 %, save for a mesh of very few
  uint64_t seed = 1;
  int threads = 0;           // 0: all the machine offers
  double amplitude = 0.016;  // most that a vertex is moved, in diagonals of the bounding box; 0 to 0.1
  double roughness = 0.55;   // height of each finer layer of relief against that of twice its width; 0 to 0.9
};

inline constexpr uint64_t kMinStatueTriangles = 5'000;

struct StatueCounts {
  uint64_t triangles = 0;
  uint64_t vertices = 0;
  uint64_t baseTriangles = 0;
  uint64_t bytes = 0;  // of the file
};

// The figure of our own: closed, metres, z up, looking along -y. At most `settings.triangles` coarse triangles.
// invalidArgument below kMinStatueTriangles.
Result<BaseMesh> makeFigure(const StatueSettings& settings);

// Writes binary little-endian PLY: x y z (double where float would show), uchar red green blue; faces. Closed where the
// base is. Memory is that of the base mesh and some megabytes.
// invalidArgument for settings out of range or fewer triangles than the base has; unsupported when there would be more
// vertices than a PLY file's 32-bit indices can name.
Result<StatueCounts> writeStatue(const BaseMesh& base, const StatueSettings& settings,
                                 const std::filesystem::path& path, Progress& progress);

}  // namespace farcell
