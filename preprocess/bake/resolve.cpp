#include "preprocess/bake/resolve.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "preprocess/bake/settle.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "preprocess/bake/resolve.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "preprocess/bake/lanes-inl.h"

// What all instruction sets share: once, in spite of the repeated inclusion.
#ifndef FARCELL_BAKE_RESOLVE_SHARED
#define FARCELL_BAKE_RESOLVE_SHARED
namespace farcell::bake {
namespace {

// Depths below the nearest sample's are summed in these parts of the averaging limit.
constexpr float kDepthParts = 1 << 20;

// One side of the image, seen from its own viewer.
struct Side {
  const std::vector<uint64_t>& keys;
  const std::vector<uint32_t>& normals;
  bool mirrored;  // the antipode: x runs the other way, and w
  int imageSize, samples;

  uint32_t complement() const { return mirrored ? 0 : 0xffffffffu; }  // stored payload ^ complement = payload
  uint32_t emptyDepth() const { return mirrored ? 0xffffffffu : 0; }
  float towardViewer() const { return mirrored ? -1.0f : 1.0f; }
  float limit() const { return kDepthAverageTexels * static_cast<float>(texelSize(imageSize)); }
};

struct Texel {
  uint32_t covered = 0;
  uint32_t red = 0, green = 0, blue = 0;  // sums
  float depth = 0;
};

}  // namespace
}  // namespace farcell::bake
#endif

HWY_BEFORE_NAMESPACE();
namespace farcell::bake::HWY_NAMESPACE {

template <class DFloat, class DUint = hn::RebindToUnsigned<DFloat>>
HWY_INLINE hn::Vec<DFloat> floatsFromOrdered(DFloat df, hn::Vec<DUint> ordered) {
  const hn::RebindToSigned<DFloat> di;
  const auto bits = hn::BitCast(di, ordered);
  const auto flips = hn::Or(hn::Not(hn::ShiftRight<31>(bits)), hn::Set(di, INT32_MIN));
  return hn::BitCast(df, hn::Xor(bits, flips));
}

// Colour sums, coverage; returns the ordered depth of the sample that is nearest to this side's viewer.
template <class D>
HWY_INLINE uint32_t addColours(D du, const Side& side, const uint64_t* keys, Texel& texel) {
  const auto complement = hn::Set(du, side.complement()), empty = hn::Set(du, side.emptyDepth());
  const auto channel = hn::Set(du, kChannelMask);
  auto red = hn::Zero(du), green = hn::Zero(du), blue = hn::Zero(du), nearest = empty;
  for (int i = 0; i < side.samples; i += static_cast<int>(hn::Lanes(du))) {
    const auto depth = highWords(du, keys + i);
    const auto payload = hn::Xor(lowWords(du, keys + i), complement);  // 0 where empty
    texel.covered += static_cast<uint32_t>(hn::CountTrue(du, hn::Ne(depth, empty)));
    nearest = side.mirrored ? hn::Min(nearest, depth) : hn::Max(nearest, depth);
    red = hn::Add(red, hn::And(payload, channel));
    green = hn::Add(green, hn::And(hn::ShiftRight<kChannelBits>(payload), channel));
    blue = hn::Add(blue, hn::And(hn::ShiftRight<2 * kChannelBits>(payload), channel));
  }
  if (texel.covered == 0) return side.emptyDepth();
  texel.red = hn::GetLane(hn::SumOfLanes(du, red));
  texel.green = hn::GetLane(hn::SumOfLanes(du, green));
  texel.blue = hn::GetLane(hn::SumOfLanes(du, blue));
  return hn::GetLane(side.mirrored ? hn::MinOfLanes(du, nearest) : hn::MaxOfLanes(du, nearest));
}

// Mean over the covered samples within the limit of the nearest one.
template <class D>
HWY_INLINE float meanDepth(D du, const Side& side, const uint64_t* keys, float nearest) {
  const hn::RebindToFloat<D> df;
  const hn::RebindToSigned<D> di;
  const float limit = side.limit(), scale = kDepthParts / limit;
  auto parts = hn::Zero(di);
  size_t count = 0;
  for (int i = 0; i < side.samples; i += static_cast<int>(hn::Lanes(du))) {
    const auto depth = highWords(du, keys + i);
    const auto w = hn::Mul(floatsFromOrdered(df, depth), hn::Set(df, side.towardViewer()));
    const auto below = hn::Sub(hn::Set(df, nearest), w);  // not a number where empty
    const auto covered = hn::RebindMask(df, hn::Ne(depth, hn::Set(du, side.emptyDepth())));
    const auto counts = hn::And(covered, hn::Le(below, hn::Set(df, limit)));
    const auto counted = hn::IfThenElseZero(counts, below);
    const auto rounded = hn::Add(hn::Mul(counted, hn::Set(df, scale)), hn::Set(df, 0.5f));
    parts = hn::Add(parts, hn::ConvertTo(di, rounded));
    count += hn::CountTrue(df, counts);
  }
  const auto sum = static_cast<float>(hn::GetLane(hn::SumOfLanes(di, parts)));
  return nearest - sum / static_cast<float>(count) / scale;
}

template <class D>
HWY_INLINE Texel resolveTexel(D du, const Side& side, const uint64_t* keys) {
  Texel texel;
  const uint32_t ordered = addColours(du, side, keys, texel);
  if (texel.covered == 0) return texel;
  const float nearest = floatFromOrdered(ordered) * side.towardViewer();
  texel.depth = side.samples == 1 ? nearest : meanDepth(du, side, keys, nearest);
  return texel;
}

// Texels [x0, x1] of a row of samples, from the first to the last or, mirrored, from the last to the first.
template <class D>
void resolveRow(D du, const Side& side, const TexelRect& from, int y, Texel* texels) {
  const int width = from.x1 - from.x0 + 1;
  for (int column = 0; column < width; ++column) {
    const int x = side.mirrored ? from.x1 - column : from.x0 + column;
    const size_t first = (size_t(y) * size_t(side.imageSize) + size_t(x)) * size_t(side.samples);
    texels[column] = resolveTexel(du, side, side.keys.data() + first);
  }
}

void resolveTexels(const Side& side, const TexelRect& from, int y, Texel* texels) {
  if (side.samples == 1) {
    resolveRow(hn::CappedTag<uint32_t, 1>(), side, from, y, texels);
  } else if (side.samples == 4) {
    resolveRow(hn::CappedTag<uint32_t, 4>(), side, from, y, texels);
  } else {
    resolveRow(hn::CappedTag<uint32_t, 16>(), side, from, y, texels);
  }
}

}  // namespace farcell::bake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace farcell::bake {

HWY_EXPORT(resolveTexels);

namespace {

// Of the samples that the colour is the mean of. In integers, so that their order makes no difference.
glm::vec3 meanNormal(const Side& side, size_t first, uint32_t covered) {
  constexpr float kParts = 1 << 20;
  glm::ivec3 sum(0);
  for (size_t i = first; i < first + size_t(side.samples); ++i)
    if (static_cast<uint32_t>(side.keys[i] >> 32) != side.emptyDepth())
      sum += glm::ivec3(glm::round(unitFromPacked(side.normals[i]) * kParts));
  return glm::vec3(sum) / (kParts * static_cast<float>(covered));
}

void allocate(BakedView& view, const Side& side, const TexelRect& from) {
  view.x0 = side.mirrored ? side.imageSize - 1 - from.x1 : from.x0;
  view.y0 = from.y0;
  view.width = from.x1 - from.x0 + 1;
  view.height = from.y1 - from.y0 + 1;
  const size_t texels = size_t(view.width) * size_t(view.height);
  view.rgba.resize(4 * texels);
  view.depth.resize(texels);
  view.normal.resize(side.normals.empty() ? 0 : 3 * texels);
}

void writeTexel(const Texel& texel, int samples, size_t to, BakedView& view) {
  const float perSample = 1.0f / static_cast<float>(samples), perLevel = perSample / kColourOne;
  view.rgba[4 * to] = static_cast<float>(texel.red) * perLevel;
  view.rgba[4 * to + 1] = static_cast<float>(texel.green) * perLevel;
  view.rgba[4 * to + 2] = static_cast<float>(texel.blue) * perLevel;
  view.rgba[4 * to + 3] = static_cast<float>(texel.covered) * perSample;
  view.depth[to] = texel.covered > 0 ? texel.depth : -std::numeric_limits<float>::infinity();
}

void writeNormals(const Side& side, const TexelRect& from, int y, const std::vector<Texel>& texels, BakedView& view) {
  for (int column = 0; column < view.width; ++column) {
    const int x = side.mirrored ? from.x1 - column : from.x0 + column;
    const size_t first = (size_t(y) * size_t(side.imageSize) + size_t(x)) * size_t(side.samples);
    const uint32_t samples = texels[size_t(column)].covered;
    const glm::vec3 normal = samples > 0 ? meanNormal(side, first, samples) : glm::vec3(0);
    const size_t to = 3 * (size_t(y - from.y0) * size_t(view.width) + size_t(column));
    for (int axis = 0; axis < 3; ++axis) view.normal[to + size_t(axis)] = normal[axis];
  }
}

void cropPlane(std::vector<float>& plane, size_t channels, int oldWidth, const TexelRect& kept) {
  const size_t width = size_t(kept.x1 - kept.x0 + 1) * channels;
  size_t to = 0;
  for (int y = kept.y0; y <= kept.y1; ++y, to += width) {
    const size_t from = (size_t(y) * size_t(oldWidth) + size_t(kept.x0)) * channels;
    if (from != to) std::copy_n(plane.begin() + ptrdiff_t(from), width, plane.begin() + ptrdiff_t(to));
  }
  plane.resize(to);
}

// kept: within the view's rectangle.
void crop(BakedView& view, const TexelRect& kept) {
  cropPlane(view.rgba, 4, view.width, kept);
  cropPlane(view.depth, 1, view.width, kept);
  if (!view.normal.empty()) cropPlane(view.normal, 3, view.width, kept);
  view.x0 += kept.x0;
  view.y0 += kept.y0;
  view.width = kept.x1 - kept.x0 + 1;
  view.height = kept.y1 - kept.y0 + 1;
}

void makeEmpty(BakedView& view) {
  view.x0 = view.y0 = view.width = view.height = 0;
  view.rgba.clear();
  view.depth.clear();
  view.normal.clear();
}

void resolveSide(const Side& side, const TexelRect& from, BakedView& view) {
  if (from.empty()) return makeEmpty(view);
  allocate(view, side, from);
  std::vector<Texel> texels(size_t(view.width));
  TexelRect covered;
  for (int row = 0; row < view.height; ++row) {
    HWY_DYNAMIC_DISPATCH(resolveTexels)(side, from, from.y0 + row, texels.data());
    for (int column = 0; column < view.width; ++column) {
      const Texel& texel = texels[size_t(column)];
      if (texel.covered > 0) covered.include({column, row, column, row});
      writeTexel(texel, side.samples, size_t(row) * size_t(view.width) + size_t(column), view);
    }
    if (!view.normal.empty()) writeNormals(side, from, from.y0 + row, texels, view);
  }
  if (covered.empty()) return makeEmpty(view);
  crop(view, covered);
}

}  // namespace

void resolve(const SampleImage& image, BakedView& view, BakedView& antipode) {
  const Side front{image.front, image.frontNormals, false, image.imageSize, image.samples};
  const Side back{image.back, image.backNormals, true, image.imageSize, image.samples};
  resolveSide(front, image.touched, view);
  resolveSide(back, image.touched, antipode);
}

}  // namespace farcell::bake
#endif
