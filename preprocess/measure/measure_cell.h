// How far each way to draw a cell is from its full triangles, by the size of its texels on screen.
//
// Pictures are taken by parallel rays from a few directions and their antipodes, which are as far from the nearest
// baked view as directions are on average, whatever the set. Truth: the full triangles of the cell and of what lies
// around it, 16 samples a pixel at the finest scale, 64 and more at the others. Only pixels count in which nothing
// but the cell itself is seen: where it goes on in its neighbours there is no edge to get wrong.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>

#include "cache/base/result.h"
#include "cache/pack/error_table.h"
#include "cache/schema/model.h"
#include "cache/schema/viewpoints.h"
#include "preprocess/measure/view_set.h"

namespace farcell {

// What is measured of a cell. The triangles are cell-local.
struct MeasuredCell {
  LocalBox content;
  const CellSoup& alone;  // clipped to the cube
  const CellSoup& grown;  // with what lies around it: what views are baked from
  const CellSoup* mesh;   // of the pack; null: there is none
  TextureSampler* textures;
  TextureSampler* meshTextures;  // of the mesh, which has its own
};

struct MeasureSettings {
  const Viewpoints& viewpoints;
  int imageSize = 128;  // texels along a view's edge
  int samples = 16;     // per texel of views
  glm::vec3 sun{0, 0, 1};
  Lighting lighting = Lighting::baked;  // of views
  int viewError = 0;                    // of candidates.h, as BuildSettings::viewError
};

// Sums over directions, of each way to draw the cell and of full geometry at one sample a pixel.
struct CellErrors {
  std::array<ErrorSum, kErrorScales> single{};
  std::array<std::array<ErrorSum, kErrorScales>, kErrorWays> ways{};
};

// Unit, of those seen from the other side as well.
std::span<const glm::dvec3> measuredDirections();

inline constexpr int kTruthSamples = 16;  // at the finest scale
inline constexpr int kMeshSamples = 4;

// Pictures of more pixels along an edge are not taken: kErrorTexelPixels beyond stay without covered pixels.
inline constexpr int kMaxMeasuredEdge = 256;

// view: the cell's view of a number as the pack holds it.
Result<CellErrors> measureCell(const MeasuredCell& cell, const ViewOf& view, const MeasureSettings& settings);

}  // namespace farcell
