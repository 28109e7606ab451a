// Triangles of many samples: one at a time, texel row by texel row, one sample a lane (rasterise.h tells the story).
// Coverage and depth are the expressions of walk_small-inl.h, so that a triangle's size does not show in its bits.
#if defined(FARCELL_BAKE_WALK_LARGE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FARCELL_BAKE_WALK_LARGE_INL_H
#undef FARCELL_BAKE_WALK_LARGE_INL_H
#else
#define FARCELL_BAKE_WALK_LARGE_INL_H
#endif

#include <algorithm>
#include <cmath>
#include "preprocess/bake/candidates-inl.h"
#include "preprocess/bake/lanes-inl.h"
#include "preprocess/bake/rasterise.h"
#include "preprocess/bake/walk_small-inl.h"

HWY_BEFORE_NAMESPACE();
namespace farcell::bake::HWY_NAMESPACE {

// How the keys of a texel row map to lanes. A vector holds several texels, or a texel is several vectors (slots).
struct SampleLanes {
  static constexpr size_t kMaxSamples = 64;
  HWY_ALIGN float x[kMaxSamples];  // sample offset from the first texel's first sample, by slot and lane
  HWY_ALIGN float y[kMaxSamples];
  int slots;          // vectors a texel
  int texelsPerStep;  // texels a vector, at least 1

  explicit SampleLanes(const SampleImage& image) {
    const int lanes = static_cast<int>(hn::Lanes(DK()));
    const int edge = 1 << image.edgeShift;
    slots = std::max(1, image.samples / lanes);
    texelsPerStep = std::max(1, lanes / image.samples);
    for (int i = 0; i < slots * lanes; ++i) {
      const int inTexel = i % image.samples;
      x[i] = static_cast<float>(i / image.samples * edge + inTexel % edge);
      y[i] = static_cast<float>(inTexel / edge);
    }
  }
};

// One triangle, counter-clockwise; positions in sample widths from the centre.
struct LargeTriangle {
  float x[3], y[3];
  float dx[3], dy[3];  // edge k runs from corner k to the next one
  double xPerY[3];     // along edge k; where dy is 0 unused
  float w, slopeX, slopeY, wMin, wMax;
  float x0, y0, x1, y1;  // centres of the first and last samples of its box
  uint32_t payload;
};

inline LargeTriangle largeTriangle(const TriangleQueue& queue, size_t at, const SampleImage& image, uint32_t flags) {
  LargeTriangle t;
  const bool clockwise = queue.area[at] < 0;
  for (size_t k = 0; k < 3; ++k) {
    const size_t corner = clockwise ? (3 - k) % 3 : k;
    t.x[k] = queue.x[corner][at];
    t.y[k] = queue.y[corner][at];
  }
  for (size_t k = 0; k < 3; ++k) {
    t.dx[k] = t.x[(k + 1) % 3] - t.x[k];
    t.dy[k] = t.y[(k + 1) % 3] - t.y[k];
    t.xPerY[k] = t.dy[k] != 0 ? double{t.dx[k]} / t.dy[k] : 0;
  }
  t.w = queue.w[0][at];
  t.slopeX = queue.slopeX[at];
  t.slopeY = queue.slopeY[at];
  t.wMin = std::min({queue.w[0][at], queue.w[1][at], queue.w[2][at]});
  t.wMax = std::max({queue.w[0][at], queue.w[1][at], queue.w[2][at]});
  const float centre = image.centreIndex;
  t.x0 = std::max(std::ceil(std::min({t.x[0], t.x[1], t.x[2]}) + centre) - centre, -centre);
  t.y0 = std::max(std::ceil(std::min({t.y[0], t.y[1], t.y[2]}) + centre) - centre, -centre);
  t.x1 = std::min(std::floor(std::max({t.x[0], t.x[1], t.x[2]}) + centre) - centre, centre);
  t.y1 = std::min(std::floor(std::max({t.y[0], t.y[1], t.y[2]}) + centre) - centre, centre);
  t.payload = kUnsettled | queue.triangle[at] << 1 | flags;
  return t;
}

// Columns that may be covered between rows yLow and yHigh: a sample wider than the edges say.
struct Span {
  double x0, x1;
};

inline Span spanOf(const LargeTriangle& t, double yLow, double yHigh) {
  Span span{t.x0, t.x1};
  for (int k = 0; k < 3; ++k) {
    if (t.dy[k] == 0) continue;
    const double low = t.x[k] + (yLow - t.y[k]) * t.xPerY[k], high = t.x[k] + (yHigh - t.y[k]) * t.xPerY[k];
    if (t.dy[k] > 0) {
      span.x1 = std::min(span.x1, std::max(low, high) + 1);
    } else {
      span.x0 = std::max(span.x0, std::min(low, high) - 1);
    }
  }
  return span;
}

// What does not change along a texel row, for one slot.
struct RowLanes {
  MFHalf inside;
  VFHalf left[3];
  VFHalf wAtRow;
  VFHalf offsetX;
};

HWY_INLINE RowLanes rowLanes(const LargeTriangle& t, const SampleLanes& lanes, size_t slot, float texelY) {
  const DFHalf df;
  RowLanes row;
  const VFHalf y = hn::Add(hn::Set(df, texelY), hn::LoadU(df, lanes.y + slot * hn::Lanes(df)));
  row.inside = hn::And(hn::Ge(y, hn::Set(df, t.y0)), hn::Le(y, hn::Set(df, t.y1)));
  for (int k = 0; k < 3; ++k) row.left[k] = hn::Mul(hn::Set(df, t.dx[k]), hn::Sub(y, hn::Set(df, t.y[k])));
  row.wAtRow = hn::Mul(hn::Sub(y, hn::Set(df, t.y[0])), hn::Set(df, t.slopeY));
  row.offsetX = hn::LoadU(df, lanes.x + slot * hn::Lanes(df));
  return row;
}

// Keys of whole vectors: depth 0 in front and the largest depth behind never win.
HWY_INLINE void addVector(MFHalf covered, VUHalf depth, uint32_t payload, size_t element, KeySink& sink) {
  const DUHalf du;
  const DK dk;
  uint64_t* front = sink.image.front.data() + element;
  uint64_t* back = sink.image.back.data() + element;
  const auto which = hn::RebindMask(du, covered);
  const VUHalf frontDepth = hn::IfThenElseZero(which, depth);
  const VUHalf backDepth = hn::IfThenElse(which, depth, hn::Set(du, 0xffffffffu));
  const VK frontKey = hn::Or(hn::ShiftLeft<32>(hn::PromoteTo(dk, frontDepth)), hn::Set(dk, uint64_t{~payload}));
  const VK backKey = hn::Or(hn::ShiftLeft<32>(hn::PromoteTo(dk, backDepth)), hn::Set(dk, uint64_t{payload}));
  hn::StoreU(hn::Max(hn::LoadU(dk, front), frontKey), dk, front);
  hn::StoreU(hn::Min(hn::LoadU(dk, back), backKey), dk, back);
}

HWY_INLINE void addVector(MFHalf covered, VUHalf depth, uint32_t payload, size_t element, CandidateTest& test) {
  const DUHalf du;
  HWY_ALIGN uint32_t depths[kLanes], lanes[kLanes];
  const auto which = hn::RebindMask(du, covered);
  hn::StoreU(hn::Compress(depth, which), du, depths);
  hn::StoreU(hn::Compress(hn::Iota(du, 0), which), du, lanes);
  for (size_t i = 0; i < hn::CountTrue(du, which); ++i) test.add(payload, element + lanes[i], depths[i]);
}

// The vector of samples whose first texel begins at texelX.
template <class Sink>
HWY_INLINE void stampSamples(const LargeTriangle& t, const RowLanes& row, float texelX, size_t element, Sink& sink) {
  const DFHalf df;
  const VFHalf x = hn::Add(hn::Set(df, texelX), row.offsetX);
  MFHalf covered = hn::And(row.inside, hn::And(hn::Ge(x, hn::Set(df, t.x0)), hn::Le(x, hn::Set(df, t.x1))));
  for (int k = 0; k < 3; ++k) {
    const VFHalf right = hn::Mul(hn::Set(df, t.dy[k]), hn::Sub(x, hn::Set(df, t.x[k])));
    covered = hn::And(covered, hn::Ge(row.left[k], right));
  }
  if (hn::AllFalse(df, covered)) return;
  const VFHalf along = hn::Mul(hn::Sub(x, hn::Set(df, t.x[0])), hn::Set(df, t.slopeX));
  const VFHalf w = hn::Add(hn::Set(df, t.w), hn::Add(along, row.wAtRow));
  const VUHalf depth = orderedFromFloats(df, hn::Max(hn::Set(df, t.wMin), hn::Min(hn::Set(df, t.wMax), w)));
  addVector(covered, depth, t.payload, element, sink);
}

template <class Sink>
void walkTexelRow(const LargeTriangle& t, int texelRow, const SampleLanes& lanes, const SampleImage& image,
                  Sink& sink) {
  const int shift = image.edgeShift;
  const float centre = image.centreIndex;
  const float texelY = static_cast<float>(texelRow << shift) - centre;
  const float lastY = texelY + static_cast<float>((1 << shift) - 1);
  const Span span = spanOf(t, std::max(texelY, t.y0), std::min(lastY, t.y1));
  if (!(span.x0 <= span.x1)) return;
  const int first = static_cast<int>(span.x0 + centre) >> shift, last = static_cast<int>(span.x1 + centre) >> shift;
  const size_t rowStart = size_t(texelRow) * size_t(image.imageSize);
  const size_t vectorKeys = hn::Lanes(DK());
  for (int slot = 0; slot < lanes.slots; ++slot) {
    const RowLanes row = rowLanes(t, lanes, size_t(slot), texelY);
    for (int texel = first; texel <= last; texel += lanes.texelsPerStep) {
      const size_t element = ((rowStart + size_t(texel)) << (2 * shift)) + size_t(slot) * vectorKeys;
      const float texelX = static_cast<float>(texel << shift) - centre;
      stampSamples(t, row, texelX, element, sink);
    }
  }
}

template <class Sink>
void walkLarge(const TriangleQueue& queue, const SampleLanes& lanes, const SampleImage& image, RasterScratch& scratch,
               Sink& sink) {
  for (size_t at = 0; at < queue.count; ++at) {
    if (queue.area[at] == 0) continue;
    const bool plane =
        scratch.planes && (scratch.kinds.empty() || (scratch.kinds[queue.triangle[at]] & kHasImage) == 0);
    if (plane) {
      scratch.largeSlots[queue.triangle[at]] = static_cast<uint32_t>(scratch.largeTriangles.size());
      scratch.largeTriangles.push_back(queue.triangle[at]);
    }
    const LargeTriangle t = largeTriangle(queue, at, image, plane ? kHasPlane : 0);
    const int first = static_cast<int>(t.y0 + image.centreIndex) >> image.edgeShift;
    const int last = static_cast<int>(t.y1 + image.centreIndex) >> image.edgeShift;
    for (int texelRow = first; texelRow <= last; ++texelRow) walkTexelRow(t, texelRow, lanes, image, sink);
  }
}

}  // namespace farcell::bake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
