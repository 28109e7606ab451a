// Triangles of a few samples: one triangle a lane, all lanes walk their boxes in step (rasterise.h tells the story).
#if defined(FARCELL_BAKE_WALK_SMALL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FARCELL_BAKE_WALK_SMALL_INL_H
#undef FARCELL_BAKE_WALK_SMALL_INL_H
#else
#define FARCELL_BAKE_WALK_SMALL_INL_H
#endif

#include <algorithm>
#include <bit>
#include <cstring>

#include "preprocess/bake/lanes-inl.h"
#include "preprocess/bake/rasterise.h"
#include "preprocess/bake/triangle_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace farcell::bake::HWY_NAMESPACE {

// A vector of triangles, counter-clockwise.
struct SmallTriangles {
  MF valid;
  Box box;
  VF x[3], y[3];    // corners
  VF dx[3], dy[3];  // edge k runs from corner k to the next one
  VF w, slopeX, slopeY, wMin, wMax;
  const uint32_t* triangle;
};

HWY_INLINE SmallTriangles loadSmall(const TriangleQueue& queue, size_t at, const SampleImage& image) {
  const DF df;
  SmallTriangles t;
  const VF area = hn::Load(df, queue.area + at);
  t.valid = hn::And(hn::FirstN(df, queue.count - at), hn::Ne(area, hn::Zero(df)));
  const MF clockwise = hn::Lt(area, hn::Zero(df));
  for (int k = 0; k < 3; ++k) {
    const int mirrored = (3 - k) % 3;
    t.x[k] = hn::IfThenElse(clockwise, hn::Load(df, queue.x[mirrored] + at), hn::Load(df, queue.x[k] + at));
    t.y[k] = hn::IfThenElse(clockwise, hn::Load(df, queue.y[mirrored] + at), hn::Load(df, queue.y[k] + at));
  }
  for (int k = 0; k < 3; ++k) {
    t.dx[k] = hn::Sub(t.x[(k + 1) % 3], t.x[k]);
    t.dy[k] = hn::Sub(t.y[(k + 1) % 3], t.y[k]);
  }
  t.box = sampleBox(t.x, t.y, image);
  const VF w1 = hn::Load(df, queue.w[1] + at), w2 = hn::Load(df, queue.w[2] + at);
  t.w = hn::Load(df, queue.w[0] + at);
  t.wMin = hn::Min(t.w, hn::Min(w1, w2));
  t.wMax = hn::Max(t.w, hn::Max(w1, w2));
  t.slopeX = hn::Load(df, queue.slopeX + at);
  t.slopeY = hn::Load(df, queue.slopeY + at);
  t.triangle = queue.triangle + at;
  return t;
}

// Element of sample (x, y), sample_image.h.
HWY_INLINE VI sampleElement(VI x, VI y, const SampleImage& image) {
  const DI di;
  const int shift = image.edgeShift;
  const VI inTexel = hn::Set(di, (1 << shift) - 1);
  const VI texel =
      hn::Add(hn::Mul(hn::ShiftRightSame(y, shift), hn::Set(di, image.imageSize)), hn::ShiftRightSame(x, shift));
  const VI sample = hn::Add(hn::ShiftLeftSame(hn::And(y, inTexel), shift), hn::And(x, inTexel));
  return hn::Add(hn::ShiftLeftSame(texel, 2 * shift), sample);
}

// Writes keys at once.
struct KeySink {
  SampleImage& image;

  HWY_INLINE void add(uint32_t payload, size_t element, uint32_t depth) {
    const uint64_t key = uint64_t{depth} << 32 | payload;
    uint64_t& front = image.front[element];
    uint64_t& back = image.back[element];
    front = std::max(front, key ^ 0xffffffffu);
    back = std::min(back, key);
  }
};

template <class Sink>
HWY_INLINE void addSamples(MF covered, VU depth, VI element, const uint32_t* triangle, Sink& sink) {
  const DF df;
  HWY_ALIGN uint32_t depths[kLanes];
  HWY_ALIGN int32_t elements[kLanes];
  hn::Store(depth, DU(), depths);
  hn::Store(element, DI(), elements);
  uint8_t maskBytes[8] = {};
  hn::StoreMaskBits(df, covered, maskBytes);
  uint64_t bits;
  std::memcpy(&bits, maskBytes, sizeof(bits));
  for (; bits != 0; bits &= bits - 1) {
    const int lane = std::countr_zero(bits);
    sink.add(kUnsettled | triangle[lane] << 1, static_cast<size_t>(elements[lane]), depths[lane]);
  }
}

template <class Sink>
HWY_INLINE void walkRow(const SmallTriangles& t, MF row, VF y, VF indexY, float columns, const SampleImage& image,
                        Sink& sink) {
  const DF df;
  const DI di;
  const VF one = hn::Set(df, 1.0f);
  VF left[3], qx[3];
  const VF x = hn::Sub(t.box.x0, hn::Set(df, image.centreIndex));
  for (int k = 0; k < 3; ++k) {
    left[k] = hn::Mul(t.dx[k], hn::Sub(y, t.y[k]));
    qx[k] = hn::Sub(x, t.x[k]);
  }
  const VF wAtRow = hn::Mul(hn::Sub(y, t.y[0]), t.slopeY);
  VF indexX = t.box.x0;
  for (float column = 0; column <= columns; ++column) {
    MF covered = hn::And(row, hn::Le(indexX, t.box.x1));
    for (int k = 0; k < 3; ++k) covered = hn::And(covered, hn::Ge(left[k], hn::Mul(t.dy[k], qx[k])));
    if (!hn::AllFalse(df, covered)) {
      const VF w = hn::Add(t.w, hn::Add(hn::Mul(qx[0], t.slopeX), wAtRow));
      const VU depth = orderedFromFloats(df, hn::Max(t.wMin, hn::Min(t.wMax, w)));
      const VI element = sampleElement(hn::ConvertTo(di, indexX), hn::ConvertTo(di, indexY), image);
      addSamples(covered, depth, element, t.triangle, sink);
    }
    indexX = hn::Add(indexX, one);
    for (int k = 0; k < 3; ++k) qx[k] = hn::Add(qx[k], one);  // exact
  }
}

template <class Sink>
void walkSmall(const TriangleQueue& queue, const SampleImage& image, Sink& sink) {
  const DF df;
  const VF zero = hn::Zero(df), centre = hn::Set(df, image.centreIndex);
  for (size_t at = 0; at < queue.count; at += hn::Lanes(df)) {
    const SmallTriangles t = loadSmall(queue, at, image);
    const VF width = hn::IfThenElse(t.valid, hn::Sub(t.box.x1, t.box.x0), zero);
    const VF height = hn::IfThenElse(t.valid, hn::Sub(t.box.y1, t.box.y0), zero);
    const float columns = hn::GetLane(hn::MaxOfLanes(df, width));
    const float rows = hn::GetLane(hn::MaxOfLanes(df, height));
    VF indexY = t.box.y0;
    for (float row = 0; row <= rows; ++row) {
      walkRow(t, hn::And(t.valid, hn::Le(indexY, t.box.y1)), hn::Sub(indexY, centre), indexY, columns, image, sink);
      indexY = hn::Add(indexY, hn::Set(df, 1.0f));
    }
  }
}

}  // namespace farcell::bake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
