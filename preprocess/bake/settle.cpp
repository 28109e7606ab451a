#include "preprocess/bake/settle.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "preprocess/bake/colour_plane.h"
#include "shaders/shared/shading.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "preprocess/bake/settle.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "preprocess/bake/light-inl.h"

HWY_BEFORE_NAMESPACE();
namespace farcell::bake::HWY_NAMESPACE {

// One texel row of one side of the image.
struct Row {
  uint64_t* keys;
  uint32_t* normals;    // null: not asked for
  uint32_t complement;  // kept payload ^ complement = payload
  float texelY;         // position of the row's lowest samples
};

// Samples [at, at + lanes) of a row.
struct RowVector {
  size_t at;
  VU payload;
};

HWY_INLINE void append(SampleList& list, const RowVector& vector, MU which) {
  const DU du;
  const VU triangle = hn::And(hn::ShiftRight<1>(vector.payload), hn::Set(du, kMaxChunkTriangles - 1));
  const VU sample = hn::Iota(du, static_cast<uint32_t>(vector.at));
  hn::StoreU(hn::Compress(sample, which), du, list.samples.data() + list.count);
  hn::StoreU(hn::Compress(triangle, which), du, list.triangles.data() + list.count);
  list.count += hn::CountTrue(du, which);
}

// The last vector of a list is filled up with its first sample.
void padList(SampleList& list) {
  std::fill_n(list.samples.begin() + ptrdiff_t(list.count), kLanes, list.samples[0]);
  std::fill_n(list.triangles.begin() + ptrdiff_t(list.count), kLanes, list.triangles[0]);
}

struct Positions {
  VF x, y;
};

HWY_INLINE Positions positionsOf(VU samples, const Row& row, const SampleImage& image) {
  const DF df;
  const DI di;
  const int shift = image.edgeShift;
  const VI inEdge = hn::Set(di, (1 << shift) - 1);
  const VI sample = hn::BitCast(di, samples);
  const VI texel = hn::ShiftRightSame(sample, 2 * shift);
  const VI x = hn::Add(hn::ShiftLeftSame(texel, shift), hn::And(sample, inEdge));
  const VI y = hn::And(hn::ShiftRightSame(sample, shift), inEdge);
  return {hn::Sub(hn::ConvertTo(df, x), hn::Set(df, image.centreIndex)),
          hn::Add(hn::ConvertTo(df, y), hn::Set(df, row.texelY))};
}

HWY_INLINE VU payloadOf(const VF (&colour)[3]) {
  const DF df;
  const DI di;
  const DU du;
  VU payload = hn::Zero(du);
  for (int channel = 2; channel >= 0; --channel) {
    const VI level = hn::ConvertTo(di, hn::Add(colour[channel], hn::Set(df, 0.5f)));
    payload = hn::Or(hn::ShiftLeft<kChannelBits>(payload), hn::BitCast(du, level));
  }
  return payload;
}

HWY_INLINE void storePayloads(VU payload, const uint32_t* samples, size_t count, const Row& row) {
  HWY_ALIGN uint32_t payloads[kLanes];
  hn::Store(payload, DU(), payloads);
  for (size_t lane = 0; lane < count; ++lane) {
    uint64_t& key = row.keys[samples[lane]];
    key = (key >> 32 << 32) | (payloads[lane] ^ row.complement);
  }
}

HWY_INLINE VU planePayload(const ColourPlane& plane, const Positions& position) {
  const DF df;
  const VF x = hn::Sub(position.x, hn::Set(df, plane.originX)), y = hn::Sub(position.y, hn::Set(df, plane.originY));
  VF colour[3];
  for (int channel = 0; channel < 3; ++channel) {
    const VF slope =
        hn::Add(hn::Mul(x, hn::Set(df, plane.gradientX[channel])), hn::Mul(y, hn::Set(df, plane.gradientY[channel])));
    const VF value = hn::Add(hn::Set(df, plane.value[channel]), slope);
    colour[channel] = hn::Max(hn::Set(df, plane.low[channel]), hn::Min(hn::Set(df, plane.high[channel]), value));
  }
  return payloadOf(colour);
}

// Replaces the payloads of whole vectors of keys.
HWY_INLINE void replacePayloads(VU payload, uint64_t* keys, uint32_t complement) {
  const DU du;
  const DK dk;
  const DUHalf half;
  HWY_ALIGN uint32_t words[kLanes];
  hn::Store(hn::Xor(payload, hn::Set(du, complement)), du, words);
  for (size_t i = 0; i < hn::Lanes(du); i += hn::Lanes(dk)) {
    const VK depth = hn::And(hn::LoadU(dk, keys + i), hn::Set(dk, 0xffffffff00000000u));
    hn::StoreU(hn::Or(depth, hn::PromoteTo(dk, hn::Load(half, words + i))), dk, keys + i);
  }
}

// Samples of large triangles are read off the triangles' colour planes, one triangle after the other.
HWY_INLINE void settlePlanar(const Winners& winners, const SettleScratch& scratch, const RowVector& vector, MU which,
                             const Row& row, const SampleImage& image) {
  const DU du;
  const Positions position = positionsOf(hn::Iota(du, static_cast<uint32_t>(vector.at)), row, image);
  VU payload = vector.payload;
  for (intptr_t lane = hn::FindFirstTrue(du, which); lane >= 0; lane = hn::FindFirstTrue(du, which)) {
    const uint32_t first = static_cast<uint32_t>(row.keys[vector.at + size_t(lane)]) ^ row.complement;
    const uint32_t slot = winners.largeSlots[(first & ~kUnsettled) >> 1];
    const MU same = hn::And(which, hn::Eq(vector.payload, hn::Set(du, first)));
    payload = hn::IfThenElse(same, planePayload(scratch.planes[slot], position), payload);
    which = hn::AndNot(same, which);
  }
  replacePayloads(payload, row.keys + vector.at, row.complement);
}

// Settles what colour planes can settle in elements [begin, end) of the row, and lists the others.
void settlePlanesOfRow(const Winners& winners, size_t begin, size_t end, const Row& row, const SampleImage& image,
                       SettleScratch& scratch) {
  const DU du;
  scratch.single.count = 0;
  const VU complement = hn::Set(du, row.complement);
  for (size_t at = begin; at < end; at += hn::Lanes(du)) {
    const VU payload = hn::Xor(lowWords(du, row.keys + at), complement);
    const MU unsettled = hn::And(hn::TestBit(payload, hn::Set(du, kUnsettled)), hn::FirstN(du, end - at));
    if (hn::AllFalse(du, unsettled)) continue;
    const RowVector vector{at, payload};
    const MU planar = hn::And(unsettled, hn::TestBit(payload, hn::Set(du, kHasPlane)));
    if (!hn::AllFalse(du, planar)) settlePlanar(winners, scratch, vector, planar, row, image);
    const MU single = hn::AndNot(planar, unsettled);
    if (!hn::AllFalse(du, single)) append(scratch.single, vector, single);
  }
}

void storeNormals(const VF (&normal)[3], const uint32_t* samples, size_t count, const Row& row) {
  const DF df;
  HWY_ALIGN float n[3][kLanes];
  for (int axis = 0; axis < 3; ++axis) hn::Store(normal[axis], df, n[axis]);
  for (size_t lane = 0; lane < count; ++lane)
    row.normals[samples[lane]] = packedOctahedral(glm::vec3(n[0][lane], n[1][lane], n[2][lane]));
}

void settleSingle(const Winners& winners, const SampleList& list, const Row& row, const SampleImage& image) {
  const DF df;
  const float side = row.complement != 0 ? 1.0f : -1.0f;  // front keys are complemented
  for (size_t at = 0; at < list.count; at += hn::Lanes(df)) {
    const uint32_t* samples = list.samples.data() + at;
    const size_t count = std::min(list.count - at, hn::Lanes(df));
    const Positions position = positionsOf(hn::LoadU(DU(), samples), row, image);
    const Surface surface = surfaceAt(winners, list.triangles.data() + at, position.x, position.y);
    storePayloads(payloadOf(surface.colour), samples, count, row);
    if (row.normals == nullptr) continue;
    VF normal[3];
    facing(surface, winners.projection, side, normal);
    storeNormals(normal, samples, count, row);
  }
}

void settleSide(const Winners& winners, const TexelRect& touched, bool front, SampleImage& image,
                SettleScratch& scratch) {
  const size_t rowSamples = size_t(image.imageSize) * size_t(image.samples);
  const size_t begin = size_t(touched.x0) * size_t(image.samples), end = size_t(touched.x1 + 1) * size_t(image.samples);
  uint64_t* keys = (front ? image.front : image.back).data();
  std::vector<uint32_t>& normals = front ? image.frontNormals : image.backNormals;
  for (int y = touched.y0; y <= touched.y1; ++y) {
    const Row row{keys + size_t(y) * rowSamples, normals.empty() ? nullptr : normals.data() + size_t(y) * rowSamples,
                  front ? 0xffffffffu : 0u, static_cast<float>(y << image.edgeShift) - image.centreIndex};
    settlePlanesOfRow(winners, begin, end, row, image, scratch);
    if (scratch.single.count == 0) continue;
    padList(scratch.single);
    settleSingle(winners, scratch.single, row, image);
  }
}

void settleBoth(const Winners& winners, const TexelRect& touched, SampleImage& image, SettleScratch& scratch) {
  settleSide(winners, touched, true, image, scratch);
  settleSide(winners, touched, false, image, scratch);
}

}  // namespace farcell::bake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace farcell::bake {
namespace {

constexpr float kSnorm16One = 32767;

void reserve(SampleList& list, size_t count) {
  if (list.samples.size() >= count) return;
  list.samples.resize(count);
  list.triangles.resize(count);
}

}  // namespace

HWY_EXPORT(settleBoth);

void settle(const Winners& winners, const TexelRect& touched, SampleImage& image, SettleScratch& scratch) {
  if (touched.empty()) return;
  const size_t rowSamples = size_t(image.imageSize) * size_t(image.samples);
  reserve(scratch.single, rowSamples + kKeyPadding);
  scratch.planes.clear();
  for (const uint32_t triangle : winners.largeTriangles) scratch.planes.push_back(colourPlane(winners, triangle));
  HWY_DYNAMIC_DISPATCH(settleBoth)(winners, touched, image, scratch);
}

uint32_t packedOctahedral(glm::vec3 unit) {
  const glm::vec2 p = shared::octahedralFromUnit(unit);
  const auto x = static_cast<int16_t>(std::lround(p.x * kSnorm16One));
  const auto y = static_cast<int16_t>(std::lround(p.y * kSnorm16One));
  return static_cast<uint16_t>(x) | uint32_t{static_cast<uint16_t>(y)} << 16;
}

glm::vec3 unitFromPacked(uint32_t packed) {
  const auto x = static_cast<int16_t>(packed & 0xffff), y = static_cast<int16_t>(packed >> 16);
  return shared::unitFromOctahedral(
      glm::vec2(static_cast<float>(x) / kSnorm16One, static_cast<float>(y) / kSnorm16One));
}

}  // namespace farcell::bake
#endif
