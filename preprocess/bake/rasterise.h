// Finds, for every sample, the triangle that is nearest to the viewer and the one that is farthest.
//
// 1. Triangles are projected, one a SIMD lane; those whose box holds no sample centre are left out, the others are
//    queued by the size of their box (projectBatch).
// 2. A queue that is full is turned into depth planes, in double (findSlopes).
// 3. Small triangles are walked one a lane, sample by sample of their boxes (walkSmall); large ones texel row by texel
//    row, one sample a lane (walkLarge).
// 4. Triangles that alpha makes holes in, or that are seen from one side only, go through 1 to 3 after the others, and
//    each of their samples is tested before it counts (candidates-inl.h).
//
// Which samples a triangle covers. Corners are rounded to a grid so fine that differences are exact in float. A
// sample is covered when dx * qy >= dy * qx for the three edges: two rounded products of exact factors, compared.
// Rounding never swaps the order of two numbers, so every sample that lies in the (closed) rounded triangle is found:
// a closed surface has no gaps, whatever its triangles' sizes. What is found beyond it lies within 2^-23 of the
// triangle's extent. Both windings count. Triangles without area in the projection are left out: their neighbours
// cover their samples.
//
// No operation is fused, reordered or approximate, so every instruction set gives the same bits.
#pragma once

#include <cstdint>
#include <vector>

#include "preprocess/bake/projection.h"
#include "preprocess/bake/view_baker.h"

namespace farcell::bake {

// Triangles whose corners are projected and rounded; structure of arrays, one lane a triangle.
struct TriangleQueue {
  static constexpr size_t kCapacity = 256;
  static constexpr size_t kPadded = kCapacity + 16;  // vectors are stored whole

  alignas(64) float x[3][kPadded] = {};
  alignas(64) float y[3][kPadded] = {};
  alignas(64) float w[3][kPadded] = {};
  alignas(64) float slopeX[kPadded] = {};  // dw/dx, dw/dy of the triangle's plane
  alignas(64) float slopeY[kPadded] = {};
  alignas(64) float area[kPadded] = {};  // twice the signed area, samples^2: zero only if it is zero
  alignas(64) uint32_t triangle[kPadded] = {};
  size_t count = 0;
};

// Sizes of boxes (samples along the longer side, less one) that share a queue; what is larger goes to the last queue.
inline constexpr float kSmallSizes[] = {0, 1, 3, 7};
inline constexpr size_t kSmallQueues = 4;

// What the texture of a triangle makes of it (SurfaceKind).
inline constexpr uint32_t kHasAlpha = 1, kSingleSided = 2, kHasImage = 4;
inline constexpr uint32_t kTested = kHasAlpha | kSingleSided;

// Samples that wait for the test whether anything is seen there (candidates-inl.h).
struct CandidateList {
  static constexpr size_t kCapacity = 1024;
  uint32_t payloads[kCapacity], elements[kCapacity], depths[kCapacity];
  size_t count = 0;
};

struct RasterScratch {
  TriangleQueue queues[kSmallQueues + 1];
  CandidateList candidates;
  bool tested = false;                   // some of the chunk's triangles are
  std::vector<uint32_t> kinds;           // by triangle, padded by a vector; empty: all are 0
  bool planes = true;                    // large triangles without image are to have colour planes (kHasPlane)
  std::vector<uint32_t> largeTriangles;  // out: those of this chunk, in the order of their slots
  std::vector<uint32_t> largeSlots;      // out: by triangle; defined for large triangles only
};

// Rasterises a chunk into the image; textures: of the chunk, null when it has none; returns the texels it may have
// touched. The keys it writes are not settled.
TexelRect rasterise(const CellSoup& chunk, const Projection& projection, TextureSampler* textures, SampleImage& image,
                    RasterScratch& scratch);

}  // namespace farcell::bake
