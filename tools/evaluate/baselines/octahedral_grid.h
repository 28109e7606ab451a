// Directions over a hemisphere on a square grid: the hemi-octahedral map, as game engines lay out the frames of an
// impostor (Brucks, Octahedral impostors, 2018).
#pragma once

#include <array>
#include <glm/vec3.hpp>

namespace farcell {

inline constexpr int kOctahedralEdge = 16;  // frames along each side of the grid
inline constexpr int kOctahedralFrames = kOctahedralEdge * kOctahedralEdge;

// Unit, z >= 0; frame = y * kOctahedralEdge + x.
glm::dvec3 octahedralDirection(int frame);

// The three frames around a direction (any length but zero) and their weights, barycentric in the grid, sum 1. Below
// the horizon: those of the point of the horizon beneath which it lies.
struct OctahedralFrames {
  std::array<int, 3> frames;
  std::array<double, 3> weights;
};
OctahedralFrames octahedralFrames(glm::dvec3 direction);

}  // namespace farcell
