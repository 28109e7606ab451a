// How far two meshes are apart, measured: the greatest distance of one's samples from the other's triangles.
#pragma once

#include <cstdint>
#include <span>

#include "preprocess/lod/welded_mesh.h"

namespace farcell::lod {

struct Surface {
  std::span<const GridPoint> places;
  std::span<const Triangle> triangles;
};

// Samples are the corners, the middles of the edges and of the triangles; where they are farthest, many more.
// nearby: of a place of `from`, a place of `to` that is likely near. knownSteps: a distance that is known, as the other
// way round; only greater ones are looked for. Steps; infinity when only `to` has no triangles.
double greatestDistanceSteps(const Surface& from, const Surface& to, std::span<const uint32_t> nearby,
                             double knownSteps = 0);

}  // namespace farcell::lod
