// The lit colour and the normal of surface points, one a lane: shading.h's shade(), eight or sixteen at a time.
#if defined(FARCELL_BAKE_LIGHT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FARCELL_BAKE_LIGHT_INL_H
#undef FARCELL_BAKE_LIGHT_INL_H
#else
#define FARCELL_BAKE_LIGHT_INL_H
#endif

#include "preprocess/bake/settle.h"
#include "preprocess/bake/texture-inl.h"
#include "preprocess/bake/triangle_lanes-inl.h"
#include "shaders/shared/shading.h"

HWY_BEFORE_NAMESPACE();
namespace farcell::bake::HWY_NAMESPACE {

struct Surface {
  VF colour[3];  // lit, or albedo; kColourOne is 1
  VF normal[3];  // not normalised; either side
  VF face[3];    // of the flat triangle, not normalised
};

HWY_INLINE VF dot3(const VF (&a)[3], const VF (&b)[3]) {
  return hn::Add(hn::Mul(a[0], b[0]), hn::Add(hn::Mul(a[1], b[1]), hn::Mul(a[2], b[2])));
}

HWY_INLINE void faceNormal(const VF (&p)[3][3], VF (&normal)[3]) {
  VF a[3], b[3];
  for (int axis = 0; axis < 3; ++axis) {
    a[axis] = hn::Sub(p[1][axis], p[0][axis]);
    b[axis] = hn::Sub(p[2][axis], p[0][axis]);
  }
  for (int axis = 0; axis < 3; ++axis) {
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    normal[axis] = hn::Sub(hn::Mul(a[i], b[j]), hn::Mul(a[j], b[i]));
  }
}

HWY_INLINE VF copySignOf(VF magnitude, VF sign) {
  const DF df;
  return hn::IfThenElse(hn::Lt(sign, hn::Zero(df)), hn::Neg(magnitude), magnitude);
}

// unitFromPacked
HWY_INLINE void decodeNormal(VI packed, VF (&normal)[3]) {
  const DF df;
  const VF one = hn::Set(df, 1.0f), scale = hn::Set(df, 1.0f / 32767.0f);
  const VF x = hn::Mul(hn::ConvertTo(df, hn::ShiftRight<16>(hn::ShiftLeft<16>(packed))), scale);
  const VF y = hn::Mul(hn::ConvertTo(df, hn::ShiftRight<16>(packed)), scale);
  const VF z = hn::Sub(hn::Sub(one, hn::Abs(x)), hn::Abs(y));
  const MF lower = hn::Lt(z, hn::Zero(df));
  normal[0] = hn::IfThenElse(lower, copySignOf(hn::Sub(one, hn::Abs(y)), x), x);
  normal[1] = hn::IfThenElse(lower, copySignOf(hn::Sub(one, hn::Abs(x)), y), y);
  normal[2] = z;
  const VF length = hn::Sqrt(dot3(normal, normal));  // >= 1/sqrt(3)
  for (VF& component : normal) component = hn::Div(component, length);
}

HWY_INLINE void vertexNormal(const TriangleLanes& lanes, const Weights& weights, VF (&normal)[3]) {
  VF corners[3][3];
  for (size_t k = 0; k < 3; ++k) decodeNormal(hn::BitCast(DI(), hn::Load(DU(), lanes.normals[k])), corners[k]);
  for (int axis = 0; axis < 3; ++axis) {
    const VF corner[3] = {corners[0][axis], corners[1][axis], corners[2][axis]};
    normal[axis] = interpolated(corner, weights);
  }
}

// lightFactor; a normal without length gets ambient light only.
HWY_INLINE VF lightOn(const VF (&normal)[3], glm::vec3 sun) {
  const DF df;
  const VF light[3] = {hn::Set(df, sun.x), hn::Set(df, sun.y), hn::Set(df, sun.z)};
  const VF length = hn::Sqrt(dot3(normal, normal));
  const MF known = hn::Gt(length, hn::Zero(df));
  const VF cosine = hn::Div(hn::Abs(dot3(normal, light)), hn::IfThenElse(known, length, hn::Set(df, 1.0f)));
  return hn::Add(hn::Set(df, shared::kAmbient),
                 hn::Mul(hn::Set(df, shared::kDiffuse), hn::IfThenElseZero(known, cosine)));
}

HWY_INLINE void albedoAt(const TriangleLanes& lanes, const Weights& weights, VF (&albedo)[3]) {
  const DF df;
  const DI di;
  VI packed[3];
  for (size_t k = 0; k < 3; ++k) packed[k] = hn::BitCast(di, hn::Load(DU(), lanes.colours[k]));
  for (int channel = 0; channel < 3; ++channel) {
    VF corner[3];
    for (int k = 0; k < 3; ++k)
      corner[k] = hn::ConvertTo(df, hn::And(hn::ShiftRightSame(packed[k], 8 * channel), hn::Set(di, 0xff)));
    albedo[channel] = interpolated(corner, weights);
  }
}

// Of the triangles at x, y: a vector of samples.
HWY_INLINE Surface surfaceAt(const Winners& winners, const uint32_t* triangles, VF x, VF y) {
  const DF df;
  TriangleLanes lanes;
  loadTriangles(winners.chunk, triangles, lanes);
  VF p[3][3];
  for (size_t k = 0; k < 3; ++k)
    for (size_t axis = 0; axis < 3; ++axis) p[k][axis] = hn::Load(df, lanes.positions[k][axis]);
  const Weights weights = weightsAt(p, winners.projection, x, y);
  Surface surface;
  faceNormal(p, surface.face);
  if (winners.chunk.normals[0].empty()) {
    for (int axis = 0; axis < 3; ++axis) surface.normal[axis] = surface.face[axis];
  } else {
    vertexNormal(lanes, weights, surface.normal);
  }
  VF albedo[3];
  albedoAt(lanes, weights, albedo);
  if (!winners.chunk.textures.empty()) multiplyByTextures(lanes, weights, *winners.textures, albedo);
  VF scale = hn::Set(df, kColourOne / 255.0f);
  if (winners.sun) scale = hn::Mul(lightOn(surface.normal, *winners.sun), scale);
  for (int channel = 0; channel < 3; ++channel) surface.colour[channel] = hn::Mul(albedo[channel], scale);
  return surface;
}

// The unit normal on the viewer's side of the surface; side: 1 for the view, -1 for its antipode.
HWY_INLINE void facing(const Surface& surface, const Projection& projection, float side, VF (&normal)[3]) {
  const DF df;
  const VF zero = hn::Zero(df), one = hn::Set(df, 1.0f);
  VF toward[3];
  for (int axis = 0; axis < 3; ++axis) toward[axis] = hn::Set(df, side * projection.toward[axis]);
  const MF faceAway = hn::Lt(dot3(surface.face, toward), zero);
  const MF normalAway = hn::Lt(dot3(surface.face, surface.normal), zero);
  const VF sign = hn::IfThenElse(hn::Xor(faceAway, normalAway), hn::Set(df, -1.0f), one);
  const VF length = hn::Sqrt(dot3(surface.normal, surface.normal));
  const MF known = hn::Gt(length, zero);
  const VF scale = hn::Div(sign, hn::IfThenElse(known, length, one));
  for (int axis = 0; axis < 3; ++axis)
    normal[axis] = hn::IfThenElse(known, hn::Mul(surface.normal[axis], scale), toward[axis]);
}

}  // namespace farcell::bake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
