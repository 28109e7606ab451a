// The geometry of one baked view: an orthographic, square image around a cell's centre.
//
// A cell-local position is (world - cell centre) / half side: the cube is [-1, 1]^3. A view looks from `toward`
// to the centre: u = dot(p, right), v = dot(p, up), w = dot(p, toward), larger w nearer to the viewer.
// Texel (x, y) of an n x n image covers u in [-e + x t, -e + (x+1) t], v likewise, e = kViewHalfExtent, t = 2 e / n:
// row 0 is the lowest row, as in OpenGL.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>

namespace farcell {

// A grown cell is its cube enlarged by this factor about its centre: enough to close the gaps between cells
// (1.02 to 1.06 measured alike; the bounding sphere, as in the 2010 paper, costs twice the bytes and more error).
inline constexpr double kCellGrowth = 1.04;
// Half the edge of a view's image, in half sides: every view holds the whole grown cube from any direction.
inline constexpr double kViewHalfExtent = 1.7320508075688772 * kCellGrowth;

struct ViewFrame {
  glm::dvec3 right;
  glm::dvec3 up;
  glm::dvec3 toward;  // unit; from the cell's centre to the viewer
};

// The frame of a direction (unit). The frame of -direction has the same up and the opposite right: its image is the
// mirror image. Never degenerate: the reference axis is the one `direction` leans on least.
ViewFrame viewFrame(glm::dvec3 direction);

// Edge of a texel in half sides of the cell.
inline double texelSize(int imageSize) { return 2.0 * kViewHalfExtent / imageSize; }

}  // namespace farcell
