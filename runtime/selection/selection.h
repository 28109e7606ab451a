// Which cells a frame draws, and how each: a pure function of directory, camera and budgets.
//
// The 2010 paper's rule (Saraiva, Oliveira, Madeiras Pereira, WSCG 2010, section 3.2) with a level rule: from the root
// down, a cell outside the frustum is dropped; a cell whose texel is at most texelPixels of a pixel at the cell's
// nearest point, and from whose bounding sphere the eye is outside, is an impostor. Where the build measured errors
// (loss.h), such a cell may also be what is too near for that, until a texel is half as large.
//
// What is too near for that is the cut of the least loss: of leaves in full, leaves as impostors, and inner cells as
// simplified meshes whose geometric error is at most meshPixels at the cell's nearest point. A way of drawing a cell
// loses the image error to expect of it (loss.h) times the pixels the cell covers. Budgets of triangles, time, texels
// and bytes are kept (cut_optimiser.h); where no time is given, a millisecond has a price, so that each goes where it
// removes the most error. What takes how long is the machine's matter, `costs`; the default is one machine's, so that a
// picture is the same on all.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "cache/pack/directory.h"
#include "cache/schema/viewpoints.h"
#include "runtime/camera/camera.h"
#include "runtime/cost/draw_costs.h"
#include "runtime/selection/hidden_cells.h"

namespace farcell {

inline constexpr double kTexelPixels = 0.5;
inline constexpr double kMeshPixels = 1;

// Image error x pixels that a millisecond must save, where no time budget is given.
inline constexpr double kMillisecondPrice = 8;

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
  uint64_t triangleBudget = 1'000'000;
  double texelPixels = kTexelPixels;  // that an impostor's texel may measure
  double meshPixels = kMeshPixels;    // that a simplified mesh's geometric error may measure; 0: no simplified meshes
  // Of automatic pictures; 0: none. Where one of these binds, impostors may be coarser than texelPixels.
  double timeBudgetMs = 0;                      // expected, by `costs`
  double millisecondPrice = kMillisecondPrice;  // where no time budget is given
  uint64_t texelBudget = 0;                     // of views, roughly
  uint64_t byteBudget = 0;                      // stored, of the pages drawn from
  DrawCosts costs = kDefaultCosts.of(1, true);  // of kind A
  // How the cut of a share differs from the others' (hand_over.h).
  double detail = 1;         // a pixel counts as so many along its edge
  glm::dvec3 lean{0, 0, 0};  // added to the unit direction from which the nearest view is chosen
  bool operator==(const SelectionSettings&) const = default;
};

// A cut is for all of a pixel's samples or for some: its shares.
inline constexpr int kShares = 4;
inline constexpr uint8_t kAllShares = (1 << kShares) - 1;

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
  uint8_t shares = kAllShares;  // a bit for each share that the entry is part of
};

// Entries lie front to back: of two, the later one can never hide the earlier (octree order seen from the eye).
struct Cut {
  std::vector<CutEntry> entries;
  uint64_t triangles = 0;  // of leaves and meshes
  FrameWork work;
  double loss = 0;       // image error to expect, in that of full geometry at one sample a pixel, x pixels
  double lossBound = 0;  // of automatic pictures: no cut within the budgets that takes no longer loses less

  // Left out because nearer cells hide them: entries, what they would have drawn and how much they are in the pack.
  struct {
    uint32_t cells = 0;
    FrameWork work;
    uint64_t storedBytes = 0;
  } hidden;
  // From the eye to the nearest content of what is drawn or left out as hidden, so that depths do not depend on that.
  double nearestSteps = std::numeric_limits<double>::infinity();
  uint32_t culled = 0;  // cells (with all below) outside the frustum
};

// hidden: what is left out; null: nothing. Where a budget binds, what hidden cells do not take is given to others; else
// the rest of the cut stays as it is without `hidden`.
Cut selectCut(const Directory& directory, const Camera& camera, int width, int height,
              const SelectionSettings& settings, const HiddenCells* hidden = nullptr);

}  // namespace farcell
