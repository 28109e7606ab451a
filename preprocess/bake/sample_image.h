// The samples of a view and of its antipode while they are being rasterised: what is nearest and what is farthest.
//
// An n x n image with S = e x e samples a texel is an (n e) x (n e) grid of samples. Positions on it are in *sample
// widths from the image's centre*, so that mirroring an image only changes signs and the antipode's bits are those of
// the view baked from there: the centre of sample i lies at i + 1/2 - n e / 2.
//
// Samples of a texel lie together: sample (x, y) is element (texel * S) + (y mod e) * e + (x mod e), with
// texel = (y / e) * n + x / e.
//
// A sample is a key of 64 bits, depth above payload. Depth is w with its bits mapped so that unsigned order is the
// order of the numbers; the nearest surface has the largest key, the farthest the smallest. The payload is a colour
// once the triangle's chunk has been shaded (settled), before that the triangle. On equal depth the smaller payload
// wins on both sides (front keys hold its complement), and colours are smaller than triangles: so the triangle that was
// added first wins, however the triangles were split into chunks.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

namespace farcell::bake {

inline constexpr uint64_t kEmptyFront = 0x00000000ffffffffu;
inline constexpr uint64_t kEmptyBack = 0xffffffff00000000u;

// Payload of a triangle that is not settled: bit 31 set, its index in the chunk, bit 0 whether it has a colour plane.
inline constexpr uint32_t kUnsettled = 0x80000000u;
inline constexpr uint32_t kHasPlane = 1u;
inline constexpr uint32_t kMaxChunkTriangles = 1u << 30;
// Payload of a settled sample: three channels of 10 bits, red lowest; kColourOne is 1.0 (and 4 is 1/255).
inline constexpr uint32_t kColourOne = 1020;
inline constexpr uint32_t kChannelBits = 10;
inline constexpr uint32_t kChannelMask = (1u << kChannelBits) - 1;

// Unsigned integers in the order of the floats (no NaN; -0 must have been made +0).
inline uint32_t orderedFromFloat(float value) {
  const uint32_t bits = std::bit_cast<uint32_t>(value);
  return bits ^ (bits >> 31 ? 0xffffffffu : 0x80000000u);
}
inline float floatFromOrdered(uint32_t ordered) {
  return std::bit_cast<float>(ordered ^ (ordered >> 31 ? 0x80000000u : 0xffffffffu));
}

// Texels, both ends included; empty when x0 > x1.
struct TexelRect {
  int x0 = INT32_MAX, y0 = INT32_MAX, x1 = -1, y1 = -1;
  bool empty() const { return x0 > x1 || y0 > y1; }
  void include(const TexelRect& other);
};

struct SampleImage {
  // samples: 1, 4, 16 or 64; imageSize * sqrt(samples) at most kMaxSampleEdge
  SampleImage(int imageSize, int samples, bool withNormals);
  void clear();  // only what was touched

  int imageSize;   // texels along the edge
  int samples;     // S, per texel
  int edgeShift;   // log2 e
  int sampleEdge;  // samples along the edge of the image
  // Distance from the image's lower edge to its centre less half a sample: position = index - centreIndex.
  float centreIndex;
  std::vector<uint64_t> front, back;                // keys; padded by kKeyPadding
  std::vector<uint32_t> frontNormals, backNormals;  // two snorm16, octahedral; empty unless asked for
  TexelRect touched;                                // where keys may differ from empty
};
inline constexpr int kMaxSampleEdge = 8192;
inline constexpr int kKeyPadding = 16;  // a vector of keys may start at the last sample

}  // namespace farcell::bake
