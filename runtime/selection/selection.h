// Which cells a frame draws, and how each: a pure function of directory, camera and budgets.
//
// Errors are lengths on screen, pixels, at the nearest point of a cell's content: of an impostor the edge of a texel,
// of a mesh its geometric error, of full triangles none. Each kind has an error it may have. From the root down, a cell
// outside the frustum is dropped; a cell whose views keep to what they may, and from whose bounding sphere the eye is
// outside, is an impostor, as in the 2010 paper (Saraiva, Oliveira, Madeiras Pereira, WSCG 2010, section 3.2). What is
// too near for that is drawn with the fewest triangles whose errors are allowed: a cell's simplified mesh where it has
// fewer than what its children need, else leaves in full.
// Where those are more than the budget, all errors that meshes and views of leaves may have grow by one factor, the
// least with which the budget is kept: the largest errors on screen get triangles first, as the paper's rule has it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cache/pack/directory.h"
#include "cache/schema/viewpoints.h"
#include "runtime/camera/camera.h"

namespace farcell {

inline constexpr double kTexelPixels = 0.5;
inline constexpr double kMeshPixels = 0.5;

enum class RenderMode {
  automatic,  // impostors, meshes and triangles
  impostors,  // no triangles, however near
  meshes,     // no impostors and no budget: the hierarchy of meshes alone
  triangles,  // every leaf in the frustum as triangles
  full,       // every leaf, in the frustum or not: the baseline
};
enum class Representation : uint8_t {
  triangles,  // all of a leaf
  mesh,       // an inner cell's, simplified
  impostor,
};

struct SelectionSettings {
  RenderMode mode = RenderMode::automatic;
  uint64_t triangleBudget = 500'000;
  double texelPixels = kTexelPixels;  // that an impostor's texel may measure
  double meshPixels = kMeshPixels;    // that a simplified mesh's geometric error may measure; 0: no simplified meshes
};

struct CutEntry {
  uint32_t cell = 0;
  Representation representation = Representation::triangles;
  // Impostors: the view of the smallest angle to (eye - centre of the cell's content). Content is often thin and off
  // the cube's centre (a city in its cells): seen from near, the direction to the cube would choose a wrong view.
  uint32_t view = 0;
  uint32_t secondView = 0;     // the next nearest: asked where the first saw no surface
  Viewpoints::Triple blend{};  // kind B: the views of the triangle around the same direction
  // Of how it is drawn, pixels, at the nearest point of the content; infinite inside its box.
  double errorPixels = 0;
};

// Entries lie front to back: of two, the later one can never hide the earlier (octree order seen from the eye).
struct Cut {
  std::vector<CutEntry> entries;
  uint64_t triangles = 0;  // of leaves and meshes
  uint32_t culled = 0;     // cells (with all below) outside the frustum
};

Cut selectCut(const Directory& directory, const Viewpoints& viewpoints, const Camera& camera, int width, int height,
              const SelectionSettings& settings);

}  // namespace farcell
