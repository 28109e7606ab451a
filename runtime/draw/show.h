// What a frame shows besides, or instead of, the picture: where its cells are, what they are drawn as and how well.
//
// levels, kinds and error colour each cell, as bright as the picture (tinted() of show.h in shaders/shared); depth and
// normals colour each point; cells and billboards are lines over the picture. For impostors:
// - error is the edge of a texel of the cell's views on screen, pixels, at the cell's nearest point: what selection
//   compares; of a simplified mesh its geometric error. Full triangles count as 0.
// - depth is that of the surface kinds A and B find, and of the billboard's plane for the flat kind.
// - normals are those baked into the pack, where it has them; else they are derived from the views' depth images.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "cache/pack/directory.h"
#include "runtime/draw/frame_camera.h"
#include "runtime/draw/impostor_kind.h"
#include "runtime/selection/selection.h"

namespace farcell {

enum class Show {
  picture,     // as it is
  cells,       // edges of the cubes of the cells drawn
  billboards,  // outlines of flat impostors; of kinds A and B: of the rectangles their first view holds
  levels,
  kinds,
  error,
  depth,
  normals,
};

// How surfaces are coloured: one set of shader programs each.
enum class Look { picture, tint, depth, normals };
Look lookOf(Show show);

struct LegendEntry {
  std::string meaning;  // "level 3", "0.5 px", "12.5 model units"
  std::array<uint8_t, 3> colour{};
};

// Of one frame.
struct ShowPlan {
  Show show = Show::picture;
  Look look = Look::picture;
  std::vector<std::array<uint8_t, 4>> tints;  // by cut entry; empty: none
  glm::vec4 depthScale{0, 0, 0, 0};           // FrameUniforms::depthScale
  std::vector<LegendEntry> legend;            // what the colours mean; empty for the picture itself
};

ShowPlan planShow(Show show, const Directory& directory, const Cut& cut, const FrameCamera& camera, ImpostorKind kind,
                  double allowedTexelPixels);

// Of what a line stands for (Show::cells, Show::billboards).
std::array<uint8_t, 3> lineColour(Representation representation, ImpostorKind kind);

}  // namespace farcell
