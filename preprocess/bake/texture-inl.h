// What textures make of the albedo of samples.
#if defined(FARCELL_BAKE_TEXTURE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FARCELL_BAKE_TEXTURE_INL_H
#undef FARCELL_BAKE_TEXTURE_INL_H
#else
#define FARCELL_BAKE_TEXTURE_INL_H
#endif

#include "preprocess/bake/triangle_lanes-inl.h"
#include "preprocess/mesh/texture_sampler.h"

HWY_BEFORE_NAMESPACE();
namespace farcell::bake::HWY_NAMESPACE {

// The footprint of a sample on the textures of its triangle, across: an orthographic view is affine.
struct Footprints {
  HWY_ALIGN float at[2][kLanes], alongX[2][kLanes], alongY[2][kLanes];
};

// How much a weight changes from a sample to the next one; a sliver's no more than from corner to corner.
HWY_INLINE VF slope(VF side, const Weights& weights) {
  const DF df;
  const VF one = hn::Set(df, 1.0f);
  return hn::Max(hn::Neg(one), hn::Min(one, hn::Div(side, weights.divisor)));
}

HWY_INLINE Footprints footprintsOf(const TriangleLanes& lanes, const Weights& weights) {
  const DF df;
  const VF firstPerX = slope(weights.y2, weights), firstPerY = slope(hn::Neg(weights.x2), weights);
  const VF secondPerX = slope(hn::Neg(weights.y1), weights), secondPerY = slope(weights.x1, weights);
  Footprints footprints;
  for (size_t axis = 0; axis < 2; ++axis) {
    VF corner[3];
    for (size_t k = 0; k < 3; ++k) corner[k] = hn::Load(df, lanes.coordinates[k][axis]);
    const VF first = hn::Sub(corner[1], corner[0]), second = hn::Sub(corner[2], corner[0]);
    const auto change = [&](VF firstPer, VF secondPer) {
      return hn::Add(hn::Mul(first, firstPer), hn::Mul(second, secondPer));
    };
    hn::Store(interpolated(corner, weights), df, footprints.at[axis]);
    hn::Store(change(firstPerX, secondPerX), df, footprints.alongX[axis]);
    hn::Store(change(firstPerY, secondPerY), df, footprints.alongY[axis]);
  }
  return footprints;
}

// Not a vector at a time: lanes may look at different textures.
HWY_INLINE void multiplyByTextures(const TriangleLanes& lanes, const Weights& weights, TextureSampler& textures,
                                   VF (&albedo)[3]) {
  const DF df;
  const Footprints footprints = footprintsOf(lanes, weights);
  HWY_ALIGN float factors[3][kLanes];
  for (size_t lane = 0; lane < hn::Lanes(df); ++lane) {
    const auto pair = [&](const float(&values)[2][kLanes]) { return glm::vec2(values[0][lane], values[1][lane]); };
    glm::vec4 factor(1);
    if (lanes.textures[lane] != kNoTexture)
      factor = textures.sample(
          {lanes.textures[lane], pair(footprints.at), pair(footprints.alongX), pair(footprints.alongY)});
    for (int channel = 0; channel < 3; ++channel) factors[channel][lane] = factor[channel];
  }
  for (int channel = 0; channel < 3; ++channel)
    albedo[channel] = hn::Mul(albedo[channel], hn::Load(df, factors[channel]));
}

}  // namespace farcell::bake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
