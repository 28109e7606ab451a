#include "preprocess/bake/rasterise.h"

#include <algorithm>

#include "cache/base/check.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "preprocess/bake/rasterise.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "preprocess/bake/candidates-inl.h"
#include "preprocess/bake/walk_large-inl.h"
#include "preprocess/bake/walk_small-inl.h"

HWY_BEFORE_NAMESPACE();
namespace farcell::bake::HWY_NAMESPACE {

// Corners of one batch of triangles: corner k of lane i.
struct Batch {
  const float* x[3];
  const float* y[3];
  const float* z[3];
};

// One chunk on its way into the image.
struct Rasteriser {
  const CellSoup& chunk;
  const Projection& projection;
  SampleImage& image;
  RasterScratch& scratch;
  CandidateTest* test;  // of the triangles on their way; null: they need none
  SampleLanes lanes;
  // Bounds of the boxes, sample indices
  VF minX, minY, maxX, maxY;
};

// Twice the area and the plane's slopes, in double: differences of snapped corners have 24 bits, so the area is exact,
// and a sliver's plane is as good as its corners.
void findSlopes(TriangleQueue& queue) {
  const DD dd;
  const DFHalf df;
  for (size_t i = 0; i < queue.count; i += hn::Lanes(dd)) {
    VD x[3], y[3], w[3];
    for (int k = 1; k < 3; ++k) {
      x[k] = hn::PromoteTo(dd, hn::Sub(hn::LoadU(df, queue.x[k] + i), hn::LoadU(df, queue.x[0] + i)));
      y[k] = hn::PromoteTo(dd, hn::Sub(hn::LoadU(df, queue.y[k] + i), hn::LoadU(df, queue.y[0] + i)));
      w[k] = hn::PromoteTo(dd, hn::Sub(hn::LoadU(df, queue.w[k] + i), hn::LoadU(df, queue.w[0] + i)));
    }
    const VD area = hn::Sub(hn::Mul(x[1], y[2]), hn::Mul(x[2], y[1]));
    const VD divisor = hn::IfThenElse(hn::Eq(area, hn::Zero(dd)), hn::Set(dd, 1.0), area);
    const VD slopeX = hn::Div(hn::Sub(hn::Mul(w[1], y[2]), hn::Mul(w[2], y[1])), divisor);
    const VD slopeY = hn::Div(hn::Sub(hn::Mul(w[2], x[1]), hn::Mul(w[1], x[2])), divisor);
    hn::StoreU(hn::DemoteTo(df, area), df, queue.area + i);
    hn::StoreU(hn::DemoteTo(df, slopeX), df, queue.slopeX + i);
    hn::StoreU(hn::DemoteTo(df, slopeY), df, queue.slopeY + i);
  }
}

template <class Sink>
void walk(Rasteriser& r, size_t size, Sink& sink) {
  const TriangleQueue& queue = r.scratch.queues[size];
  if (size < kSmallQueues) {
    walkSmall(queue, r.image, sink);
  } else {
    walkLarge(queue, r.lanes, r.image, r.scratch, sink);
  }
}

void flush(Rasteriser& r, size_t size) {
  findSlopes(r.scratch.queues[size]);
  KeySink keys{r.image};
  if (r.test != nullptr) {
    walk(r, size, *r.test);
  } else {
    walk(r, size, keys);
  }
  r.scratch.queues[size].count = 0;
}

// Those of the pass, from triangle `first` on.
HWY_INLINE MF ofThisPass(const Rasteriser& r, size_t first) {
  const DF df;
  const DU du;
  const VU kinds = hn::And(hn::LoadU(du, r.scratch.kinds.data() + first), hn::Set(du, kTested));
  const MU tested = hn::Ne(kinds, hn::Zero(du));
  return hn::RebindMask(df, r.test != nullptr ? tested : hn::Not(tested));
}

HWY_INLINE void append(TriangleQueue& queue, MF which, const VF (&x)[3], const VF (&y)[3], const VF (&w)[3], VU id) {
  const DF df;
  const size_t at = queue.count;
  for (int k = 0; k < 3; ++k) {
    hn::StoreU(hn::Compress(x[k], which), df, queue.x[k] + at);
    hn::StoreU(hn::Compress(y[k], which), df, queue.y[k] + at);
    hn::StoreU(hn::Compress(w[k], which), df, queue.w[k] + at);
  }
  const DU du;
  hn::StoreU(hn::Compress(id, hn::RebindMask(du, which)), du, queue.triangle + at);
  queue.count += hn::CountTrue(df, which);
}

HWY_INLINE void sortBySize(Rasteriser& r, MF remaining, VF size, const VF (&x)[3], const VF (&y)[3], const VF (&w)[3],
                           VU id) {
  const DF df;
  for (size_t i = 0; i <= kSmallQueues; ++i) {
    MF fits = remaining;
    if (i < kSmallQueues) fits = hn::And(remaining, hn::Le(size, hn::Set(df, kSmallSizes[i])));
    if (hn::AllFalse(df, fits)) continue;
    append(r.scratch.queues[i], fits, x, y, w, id);
    if (r.scratch.queues[i].count + hn::Lanes(df) > TriangleQueue::kCapacity) flush(r, i);
    remaining = hn::AndNot(fits, remaining);
    if (hn::AllFalse(df, remaining)) return;
  }
}

HWY_INLINE void projectBatch(Rasteriser& r, const Batch& batch, size_t at, uint32_t firstId, MF valid) {
  const DF df;
  const DU du;
  if (r.scratch.tested) valid = hn::And(valid, ofThisPass(r, firstId));
  if (hn::AllFalse(df, valid)) return;
  VF x[3], y[3], w[3];
  for (int k = 0; k < 3; ++k) {
    const VF p[3] = {hn::LoadU(df, batch.x[k] + at), hn::LoadU(df, batch.y[k] + at), hn::LoadU(df, batch.z[k] + at)};
    x[k] = snapped(dot(p, r.projection.right), r.projection);
    y[k] = snapped(dot(p, r.projection.up), r.projection);
    w[k] = dot(p, r.projection.toward);
  }
  const Box box = sampleBox(x, y, r.image);
  const MF hit = hn::And(valid, hn::And(hn::Le(box.x0, box.x1), hn::Le(box.y0, box.y1)));
  if (hn::AllFalse(df, hit)) return;
  r.minX = hn::Min(r.minX, hn::IfThenElse(hit, box.x0, r.minX));
  r.minY = hn::Min(r.minY, hn::IfThenElse(hit, box.y0, r.minY));
  r.maxX = hn::Max(r.maxX, hn::IfThenElse(hit, box.x1, r.maxX));
  r.maxY = hn::Max(r.maxY, hn::IfThenElse(hit, box.y1, r.maxY));
  const VF size = hn::Max(hn::Sub(box.x1, box.x0), hn::Sub(box.y1, box.y0));
  sortBySize(r, hit, size, x, y, w, hn::Iota(du, firstId));
}

// The last triangles, fewer than a vector holds.
void projectTail(Rasteriser& r, const Batch& batch, size_t at, size_t count) {
  const DF df;
  HWY_ALIGN float padded[9][HWY_MAX_BYTES / sizeof(float)] = {};
  Batch tail{};
  for (int k = 0; k < 3; ++k) {
    std::copy_n(batch.x[k] + at, count, padded[3 * k]);
    std::copy_n(batch.y[k] + at, count, padded[3 * k + 1]);
    std::copy_n(batch.z[k] + at, count, padded[3 * k + 2]);
    tail.x[k] = padded[3 * k];
    tail.y[k] = padded[3 * k + 1];
    tail.z[k] = padded[3 * k + 2];
  }
  projectBatch(r, tail, 0, static_cast<uint32_t>(at), hn::FirstN(df, count));
}

TexelRect touchedTexels(const Rasteriser& r) {
  const DF df;
  const int x0 = static_cast<int>(hn::GetLane(hn::MinOfLanes(df, r.minX)));
  const int y0 = static_cast<int>(hn::GetLane(hn::MinOfLanes(df, r.minY)));
  const int x1 = static_cast<int>(hn::GetLane(hn::MaxOfLanes(df, r.maxX)));
  const int y1 = static_cast<int>(hn::GetLane(hn::MaxOfLanes(df, r.maxY)));
  if (x1 < 0) return {};
  const int shift = r.image.edgeShift;
  return {x0 >> shift, y0 >> shift, x1 >> shift, y1 >> shift};
}

void projectAll(Rasteriser& r) {
  const DF df;
  const CellSoup& chunk = r.chunk;
  Batch batch{};
  for (size_t k = 0; k < 3; ++k) {
    batch.x[k] = chunk.x[k].data();
    batch.y[k] = chunk.y[k].data();
    batch.z[k] = chunk.z[k].data();
  }
  const size_t lanes = hn::Lanes(df);
  const size_t whole = chunk.size() / lanes * lanes;
  const MF all = hn::FirstN(df, lanes);
  for (size_t at = 0; at < whole; at += lanes) projectBatch(r, batch, at, static_cast<uint32_t>(at), all);
  if (whole < chunk.size()) projectTail(r, batch, whole, chunk.size() - whole);
  for (size_t i = 0; i <= kSmallQueues; ++i) flush(r, i);
}

TexelRect rasteriseChunk(const CellSoup& chunk, const Projection& projection, TextureSampler* textures,
                         SampleImage& image, RasterScratch& scratch) {
  const DF df;
  const VF high = hn::Set(df, kMaxSampleEdge), low = hn::Set(df, -1.0f);
  Rasteriser r{chunk, projection, image, scratch, nullptr, SampleLanes(image), high, high, low, low};
  projectAll(r);
  if (!scratch.tested) return touchedTexels(r);
  CandidateTest test(chunk, projection, image, scratch, *textures);
  r.test = &test;
  projectAll(r);
  test.flush();
  return touchedTexels(r);
}

}  // namespace farcell::bake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace farcell::bake {

HWY_EXPORT(rasteriseChunk);

namespace {

uint32_t kindOf(const SurfaceKind& surface) {
  return (surface.alpha != AlphaMode::opaque ? kHasAlpha : 0) | (surface.doubleSided ? 0 : kSingleSided) |
         (surface.hasImage ? kHasImage : 0);
}

// Lanes of the widest vector that any target has (SVE): this is compiled for one target, what reads them for all.
constexpr size_t kMostLanes = 256 / sizeof(uint32_t);

void findKinds(const CellSoup& chunk, const TextureSampler* textures, RasterScratch& scratch) {
  std::vector<uint32_t>& kinds = scratch.kinds;
  kinds.clear();
  scratch.tested = false;
  if (chunk.textures.empty()) return;
  kinds.resize(chunk.size() + kMostLanes);
  for (size_t i = 0; i < chunk.size(); ++i) {
    if (chunk.textures[i] != kNoTexture) kinds[i] = kindOf(textures->surface(chunk.textures[i]));
    scratch.tested |= (kinds[i] & kTested) != 0;
  }
}

}  // namespace

TexelRect rasterise(const CellSoup& chunk, const Projection& projection, TextureSampler* textures, SampleImage& image,
                    RasterScratch& scratch) {
  FARCELL_CHECK(chunk.size() < kMaxChunkTriangles);
  scratch.largeTriangles.clear();
  if (scratch.largeSlots.size() < chunk.size()) scratch.largeSlots.resize(chunk.size());
  findKinds(chunk, textures, scratch);
  return HWY_DYNAMIC_DISPATCH(rasteriseChunk)(chunk, projection, textures, image, scratch);
}

}  // namespace farcell::bake
#endif
