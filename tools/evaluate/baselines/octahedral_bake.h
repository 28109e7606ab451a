// The frames of an octahedral impostor: orthographic views of the whole model, baked as those of packs are.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "cache/pack/pack_file.h"
#include "cache/schema/view_frame.h"
#include "tools/evaluate/baselines/octahedral_grid.h"

namespace farcell {

// Each frame is a square around the bounding sphere of the content box.
struct OctahedralViews {
  int edge = 0;                               // texels of a frame
  glm::dvec3 centre{0};                       // world: local (0, 0, 0)
  double unit = 1;                            // world length of 1
  double halfExtent = 1;                      // of a frame, and of its depths about the centre; local
  std::array<glm::dvec3, 3> grid{};           // x, y, z of octahedral_grid.h, world
  std::vector<ViewFrame> axes;                // one a frame
  std::vector<std::vector<uint8_t>> colours;  // 4 a texel, premultiplied, row 0 lowest
  std::vector<std::vector<uint8_t>> depths;   // 1 a texel: w / halfExtent from -1 (0) to 1 (255); dilated
};

// Bytes of all frames on the GPU: RGBA8 with mip levels and R8.
uint64_t octahedralBytes(int edge);
// The largest frame with which all take at most `bytes`; 16 to 1024.
int octahedralEdgeOf(uint64_t bytes);

// Lit by the sun of that direction, from the full triangles of the leaves, 16 samples a texel, streamed: a few frames
// are in the making at once, and the leaves are read once for each such group. Ends with `cancelled` on Ctrl-C.
Result<OctahedralViews> bakeOctahedral(const PackFile& pack, int edge, glm::vec3 sun);

}  // namespace farcell
