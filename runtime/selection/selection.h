// Which cells a frame draws, and how each: a pure function of directory, camera and budgets.
//
// The 2010 paper's rule (Saraiva, Oliveira, Madeiras Pereira, WSCG 2010, section 3.2) with a level rule: from the root
// down, a cell outside the frustum is dropped; a cell whose texel is at most kTexelPixels of a pixel at the cell's
// nearest point, and from whose bounding sphere the eye is outside, is an impostor; leaves that are too near for that
// become triangles, those with the largest texels on screen first (of equal cells: the nearest first), until the
// triangle budget, and impostors beyond it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cache/pack/directory.h"
#include "cache/schema/viewpoints.h"
#include "runtime/camera/camera.h"

namespace farcell {

inline constexpr double kTexelPixels = 0.5;

enum class RenderMode {
  automatic,  // impostors and triangles
  impostors,  // no triangles, however near
  triangles,  // every leaf in the frustum as triangles
  full,       // every leaf, in the frustum or not: the baseline
};
enum class Representation : uint8_t { triangles, impostor };

struct SelectionSettings {
  RenderMode mode = RenderMode::automatic;
  uint64_t triangleBudget = 500'000;
  double texelPixels = kTexelPixels;
};

struct CutEntry {
  uint32_t cell = 0;
  Representation representation = Representation::triangles;
  // Impostors: the view of the smallest angle to (eye - centre of the cell's content). Content is often thin and off
  // the cube's centre (a city in its cells): seen from near, the direction to the cube would choose a wrong view.
  uint32_t view = 0;
  uint32_t secondView = 0;     // the next nearest: asked where the first saw no surface
  Viewpoints::Triple blend{};  // kind B: the views of the triangle around the same direction
  // Impostors: edge of a texel on screen, pixels, at the nearest point of the content; infinite inside its box.
  double texelPixels = 0;
};

// Entries lie front to back: of two, the later one can never hide the earlier (octree order seen from the eye).
struct Cut {
  std::vector<CutEntry> entries;
  uint64_t triangles = 0;
  uint32_t culled = 0;  // cells (with all below) outside the frustum
};

Cut selectCut(const Directory& directory, const Viewpoints& viewpoints, const Camera& camera, int width, int height,
              const SelectionSettings& settings);

}  // namespace farcell
