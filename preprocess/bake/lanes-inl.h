// Vector types of the rasteriser, once per instruction set (per-target include guard, see Highway's foreach_target.h).
#if defined(FARCELL_BAKE_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FARCELL_BAKE_LANES_INL_H
#undef FARCELL_BAKE_LANES_INL_H
#else
#define FARCELL_BAKE_LANES_INL_H
#endif

#include <hwy/highway.h>

#include "preprocess/bake/projection.h"

HWY_BEFORE_NAMESPACE();
namespace farcell::bake::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using DF = hn::ScalableTag<float>;
using DU = hn::RebindToUnsigned<DF>;
using DI = hn::RebindToSigned<DF>;
using VF = hn::Vec<DF>;
using VU = hn::Vec<DU>;
using VI = hn::Vec<DI>;
using MF = hn::Mask<DF>;
using MU = hn::Mask<DU>;
// As many floats as there are doubles or keys in a vector.
using DD = hn::ScalableTag<double>;
using DK = hn::ScalableTag<uint64_t>;
using DFHalf = hn::Rebind<float, DD>;
using DUHalf = hn::Rebind<uint32_t, DD>;
using DIHalf = hn::Rebind<int32_t, DD>;
using VD = hn::Vec<DD>;
using VK = hn::Vec<DK>;
using VFHalf = hn::Vec<DFHalf>;
using VUHalf = hn::Vec<DUHalf>;
using MFHalf = hn::Mask<DFHalf>;

HWY_INLINE VF dot(const VF (&p)[3], const float (&axis)[3]) {
  const DF df;
  return hn::Add(hn::Mul(p[0], hn::Set(df, axis[0])),
                 hn::Add(hn::Mul(p[1], hn::Set(df, axis[1])), hn::Mul(p[2], hn::Set(df, axis[2]))));
}

// imagePosition of dot(p, right) or dot(p, up)
HWY_INLINE VF snapped(VF position, const Projection& projection) {
  const DF df;
  const VF snap = hn::Set(df, projection.snap), edge = hn::Set(df, projection.halfEdge);
  const VF inside = hn::Max(hn::Min(position, edge), hn::Neg(edge));
  return hn::Sub(hn::Add(inside, snap), snap);
}

// Samples whose centres lie in the bounding box of a triangle: their indices, both ends included.
struct Box {
  VF x0, y0, x1, y1;
};

HWY_INLINE Box sampleBox(const VF (&x)[3], const VF (&y)[3], const SampleImage& image) {
  const DF df;
  const VF centre = hn::Set(df, image.centreIndex), zero = hn::Zero(df);
  const VF last = hn::Set(df, static_cast<float>(image.sampleEdge - 1));
  Box box;
  box.x0 = hn::Max(zero, hn::Ceil(hn::Add(hn::Min(x[0], hn::Min(x[1], x[2])), centre)));
  box.y0 = hn::Max(zero, hn::Ceil(hn::Add(hn::Min(y[0], hn::Min(y[1], y[2])), centre)));
  box.x1 = hn::Min(last, hn::Floor(hn::Add(hn::Max(x[0], hn::Max(x[1], x[2])), centre)));
  box.y1 = hn::Min(last, hn::Floor(hn::Add(hn::Max(y[0], hn::Max(y[1], y[2])), centre)));
  return box;
}

// orderedFromFloat, with -0 made +0
template <class D>
HWY_INLINE hn::Vec<hn::RebindToUnsigned<D>> orderedFromFloats(D d, hn::Vec<D> value) {
  const hn::RebindToUnsigned<D> du;
  const hn::RebindToSigned<D> di;
  const auto bits = hn::BitCast(di, hn::Add(value, hn::Zero(d)));
  const auto flips = hn::Or(hn::ShiftRight<31>(bits), hn::Set(di, INT32_MIN));
  return hn::BitCast(du, hn::Xor(bits, flips));
}

// The payloads (low words) and depths (high words) of as many keys as D has lanes.
template <class D>
HWY_INLINE hn::Vec<D> lowWords(D d, const uint64_t* keys) {
#if HWY_TARGET != HWY_SCALAR
  if constexpr (hn::MaxLanes(D()) > 1) {
    const hn::Repartition<uint64_t, D> dk;
    const auto first = hn::BitCast(d, hn::LoadU(dk, keys));
    return hn::ConcatEven(d, hn::BitCast(d, hn::LoadU(dk, keys + hn::Lanes(dk))), first);
  }
#endif
  return hn::Set(d, static_cast<uint32_t>(*keys));
}

template <class D>
HWY_INLINE hn::Vec<D> highWords(D d, const uint64_t* keys) {
#if HWY_TARGET != HWY_SCALAR
  if constexpr (hn::MaxLanes(D()) > 1) {
    const hn::Repartition<uint64_t, D> dk;
    const auto first = hn::BitCast(d, hn::LoadU(dk, keys));
    return hn::ConcatOdd(d, hn::BitCast(d, hn::LoadU(dk, keys + hn::Lanes(dk))), first);
  }
#endif
  return hn::Set(d, static_cast<uint32_t>(*keys >> 32));
}

}  // namespace farcell::bake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
