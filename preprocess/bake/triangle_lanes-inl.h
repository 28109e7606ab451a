// The triangles of a vector of samples, and where in them the samples lie.
#if defined(FARCELL_BAKE_TRIANGLE_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FARCELL_BAKE_TRIANGLE_LANES_INL_H
#undef FARCELL_BAKE_TRIANGLE_LANES_INL_H
#else
#define FARCELL_BAKE_TRIANGLE_LANES_INL_H
#endif

#include <vector>

#include "preprocess/bake/lanes-inl.h"
#include "preprocess/bake/settle.h"

HWY_BEFORE_NAMESPACE();
namespace farcell::bake::HWY_NAMESPACE {

constexpr size_t kLanes = HWY_MAX_BYTES / sizeof(float);

// The triangles of one vector of samples, transposed (element by element: gather instructions are no faster).
struct TriangleLanes {
  HWY_ALIGN float positions[3][3][kLanes];
  HWY_ALIGN uint32_t colours[3][kLanes];
  HWY_ALIGN uint32_t normals[3][kLanes];
  HWY_ALIGN uint32_t textures[kLanes];
  HWY_ALIGN float coordinates[3][2][kLanes];
};

template <class T>
HWY_INLINE void pick(const std::vector<T>& from, const uint32_t* indices, T* to) {
  const T* elements = from.data();
  for (size_t lane = 0; lane < hn::Lanes(DF()); ++lane) to[lane] = elements[indices[lane]];
}

HWY_INLINE void loadTriangles(const CellSoup& chunk, const uint32_t* triangles, TriangleLanes& lanes) {
  for (size_t k = 0; k < 3; ++k) {
    pick(chunk.x[k], triangles, lanes.positions[k][0]);
    pick(chunk.y[k], triangles, lanes.positions[k][1]);
    pick(chunk.z[k], triangles, lanes.positions[k][2]);
    pick(chunk.colours[k], triangles, lanes.colours[k]);
    if (!chunk.normals[k].empty()) pick(chunk.normals[k], triangles, lanes.normals[k]);
    if (chunk.textures.empty()) continue;
    pick(chunk.u[k], triangles, lanes.coordinates[k][0]);
    pick(chunk.v[k], triangles, lanes.coordinates[k][1]);
  }
  if (!chunk.textures.empty()) pick(chunk.textures, triangles, lanes.textures);
}

// Weights of corners 1 and 2; both and their rest are in [0, 1].
struct Weights {
  VF first, second;
  VF x1, y1, x2, y2, divisor;  // sides 0-1 and 0-2 in the image; what their cross product divides by
};

HWY_INLINE Weights weightsAt(const VF (&p)[3][3], const Projection& projection, VF atX, VF atY) {
  const DF df;
  const VF zero = hn::Zero(df), one = hn::Set(df, 1.0f);
  const VF x0 = snapped(dot(p[0], projection.right), projection), y0 = snapped(dot(p[0], projection.up), projection);
  const VF x1 = hn::Sub(snapped(dot(p[1], projection.right), projection), x0);
  const VF y1 = hn::Sub(snapped(dot(p[1], projection.up), projection), y0);
  const VF x2 = hn::Sub(snapped(dot(p[2], projection.right), projection), x0);
  const VF y2 = hn::Sub(snapped(dot(p[2], projection.up), projection), y0);
  const VF qx = hn::Sub(atX, x0), qy = hn::Sub(atY, y0);
  const VF area = hn::Sub(hn::Mul(x1, y2), hn::Mul(x2, y1));
  const VF divisor = hn::IfThenElse(hn::Eq(area, zero), one, area);  // a sliver's area may round to zero
  const VF first = hn::Div(hn::Sub(hn::Mul(qx, y2), hn::Mul(x2, qy)), divisor);
  const VF second = hn::Div(hn::Sub(hn::Mul(x1, qy), hn::Mul(qx, y1)), divisor);
  Weights weights;
  weights.first = hn::Max(zero, hn::Min(one, first));
  weights.second = hn::Max(zero, hn::Min(hn::Sub(one, weights.first), second));
  weights.x1 = x1;
  weights.y1 = y1;
  weights.x2 = x2;
  weights.y2 = y2;
  weights.divisor = divisor;
  return weights;
}

HWY_INLINE VF interpolated(const VF (&corner)[3], const Weights& weights) {
  const DF df;
  const VF rest = hn::Sub(hn::Sub(hn::Set(df, 1.0f), weights.first), weights.second);
  return hn::Add(hn::Mul(corner[0], rest),
                 hn::Add(hn::Mul(corner[1], weights.first), hn::Mul(corner[2], weights.second)));
}

}  // namespace farcell::bake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
