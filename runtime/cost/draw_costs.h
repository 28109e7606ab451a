// What a frame takes: milliseconds of wall time as a sum over what it draws. Linear, because selection adds up cells.
#pragma once

#include <array>
#include <cstddef>

namespace farcell {

// What a frame draws, as far as selection foresees it.
struct FrameWork {
  double picturePixels = 0;
  double triangles = 0;
  double meshPixels = 0;      // that triangles may cover: mean silhouettes of the content boxes of their cells
  double impostors = 0;       // cells
  double impostorPixels = 0;  // the same of theirs

  FrameWork& operator+=(const FrameWork& more) {
    picturePixels += more.picturePixels;
    triangles += more.triangles;
    meshPixels += more.meshPixels;
    impostors += more.impostors;
    impostorPixels += more.impostorPixels;
    return *this;
  }
};

// Milliseconds of each, of one kind of impostor at one number of samples a pixel.
struct DrawCosts {
  double picturePixelMs = 0;
  double triangleMs = 0;
  double meshPixelMs = 0;
  double impostorMs = 0;
  double impostorPixelMs = 0;
  bool operator==(const DrawCosts&) const = default;
};

// By kind of impostor (flat, A, B), each at 1 sample and at more.
struct CostModel {
  std::array<DrawCosts, 6> draws;
  const DrawCosts& of(size_t kind, bool multisampled) const { return draws[2 * kind + multisampled]; }
  bool operator==(const CostModel&) const = default;
};

// Of llvmpipe on two cores (tests/bench/cost/results.md).
inline constexpr CostModel kDefaultCosts = {{{{5e-7, 1.2e-4, 2e-6, 0.02, 5e-6},
                                              {5e-7, 4e-4, 5e-6, 0.1, 1.1e-5},
                                              {5e-7, 1.2e-4, 2e-6, 0.15, 8e-5},
                                              {5e-7, 4e-4, 5e-6, 0.6, 3e-4},
                                              {5e-7, 1.2e-4, 2e-6, 0.2, 1.1e-4},
                                              {5e-7, 4e-4, 5e-6, 0.7, 4e-4}}}};

inline double expectedMs(const DrawCosts& costs, const FrameWork& work) {
  return costs.picturePixelMs * work.picturePixels + costs.triangleMs * work.triangles +
         costs.meshPixelMs * work.meshPixels + costs.impostorMs * work.impostors +
         costs.impostorPixelMs * work.impostorPixels;
}

}  // namespace farcell
