// How far a picture is from the truth. Both are composited over the same background first; d is the difference of the
// two in R, G, B of 0-255.
//
// *foreground*: pixels whose reference coverage is above 0; *rectangle*: their bounding rectangle.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tools/evaluate/metrics/images.h"

namespace farcell {

// PSNR of equal pictures is infinite, which no report can hold: it is capped here.
inline constexpr double kMaxPsnrDb = 100;
inline constexpr double kHoleReferenceCoverage = 0.999;  // a pixel that must be covered ...
inline constexpr double kHoleCoverage = 0.5;             // ... and is not
inline constexpr double kLeakCoverage = 0.02;            // a pixel that must be empty and is covered more than this

struct Metrics {
  double paperErrorSum = 0;  // sum of |dR| + |dG| + |dB| over the whole image
  double paperError = 0;     // the same / pixels of the rectangle (Saraiva, Oliveira, Madeiras Pereira, WSCG 2010)
  double mae = 0;            // mean |d| over the foreground's pixels and channels
  double psnr = 0;           // dB, from the mean d^2 over the foreground's pixels and channels; at most kMaxPsnrDb
  double ssim = 0;           // structuralSimilarity(), mean over the foreground
  double flip = 0;           // flipErrors(), mean over the whole image
  double p95 = 0;            // of max(|dR|, |dG|, |dB|) over the foreground, nearest rank
  double p99 = 0;
  double holeRate = 0;         // of pixels with reference coverage > .999, the share whose own coverage is < .5
  double leakRate = 0;         // pixels with reference coverage 0 and own > .02, per foreground pixel
  double coverageBias = 0;     // own coverage / reference coverage - 1, each summed over the image
  double impostorShare = 0;    // mean of impostorCoverage / own coverage over foreground pixels with own coverage > 0
  double silhouetteShare = 0;  // of paperErrorSum, what lies where reference coverage is in (0, 1)
  double interiorShare = 0;    // ... where it is 1; the rest lies where it is 0
  uint64_t foregroundPixels = 0;
  uint64_t rectanglePixels = 0;
};

// REQUIRES: pictures of the same size, every buffer of the size its image states. A reference without foreground gives
// psnr kMaxPsnrDb, ssim 1, paperErrorSum and flip as measured and 0 for everything else. flipMap: gets flipErrors();
// null: not wanted.
Metrics measure(const ReferenceImage& reference, const TestImage& test, const Colour& background,
                std::vector<float>* flipMap = nullptr);

// Metrics::paperError alone. truth, own: reference and picture, composited, 3 a pixel.
double paperError(const ReferenceImage& reference, std::span<const float> truth, std::span<const float> own);

// Wang, Bovik, Sheikh, Simoncelli, Image quality assessment: from error visibility to structural similarity, 2004:
// Gaussian window of 11 x 11 pixels, sigma 1.5, K1 .01, K2 .03, on luma (Rec. 601 weights of R, G, B in 0-255); a
// window at the image's border counts only its pixels inside. Returns one value a pixel. `a` and `b`: 3 a pixel.
std::vector<double> structuralSimilarity(std::span<const float> a, std::span<const float> b, int width, int height);

// LDR-FLIP: what a person sees of the difference when the two pictures take turns in one place, [0, 1], one value a
// pixel (flip.cpp). `a` and `b`: 3 a pixel, 0-255, taken as sRGB.
inline constexpr double kFlipPixelsPerDegree = 67;  // the paper's viewer: .7 m from a screen .7 m wide of 3840 pixels
std::vector<float> flipErrors(std::span<const float> a, std::span<const float> b, int width, int height);

}  // namespace farcell
