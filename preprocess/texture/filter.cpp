#include "preprocess/texture/filter.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/vec3.hpp>

#include "cache/base/check.h"

namespace farcell {
namespace {

// What a footprint asks for, lengths in pixels of the image.
struct Ellipse {
  float major = 0, minor = 0;
  glm::vec2 axis{0};  // the major one, in texture coordinates
};

// From the symmetric matrix of the parallelogram's sides: which way a side points does not count, so a view and its
// antipode get the same bits.
Ellipse ellipseOf(glm::vec2 alongX, glm::vec2 alongY, glm::vec2 size) {
  const glm::vec2 a = alongX * size, b = alongY * size;
  const float xx = a.x * a.x + b.x * b.x, xy = a.x * a.y + b.x * b.y, yy = a.y * a.y + b.y * b.y;
  const float mean = 0.5f * (xx + yy), half = 0.5f * (xx - yy);
  const float radius = std::sqrt(half * half + xy * xy);
  Ellipse ellipse;
  ellipse.major = std::sqrt(mean + radius);
  ellipse.minor = std::sqrt(std::max(0.0f, mean - radius));
  // Of the two forms of the eigenvector, the one that does not cancel.
  const glm::vec2 direction = half >= 0 ? glm::vec2(half + radius, xy) : glm::vec2(xy, radius - half);
  const float length = std::sqrt(direction.x * direction.x + direction.y * direction.y);
  if (length > 0) ellipse.axis = direction / length * ellipse.major / size;
  return ellipse;
}

int floorOf(float value) {
  const int towardsZero = static_cast<int>(value);
  return towardsZero - (static_cast<float>(towardsZero) > value ? 1 : 0);
}

// Into [-1, 2], where the wrap mode gives the same pixels.
float reduced(float coordinate, TextureWrap wrap) {
  if (wrap == TextureWrap::clamp) return std::clamp(coordinate, -1.0f, 2.0f);
  if (wrap == TextureWrap::repeat) return coordinate - static_cast<float>(floorOf(coordinate));
  return coordinate - 2.0f * static_cast<float>(floorOf(0.5f * coordinate));
}

// index: of a pixel next to a reduced coordinate.
uint32_t wrapped(int index, int size, TextureWrap wrap) {
  if (wrap == TextureWrap::clamp) return static_cast<uint32_t>(std::clamp(index, 0, size - 1));
  if (wrap == TextureWrap::repeat)
    return static_cast<uint32_t>(index < 0 ? index + size : index < size ? index : index - size);
  const int within = index < 0 ? -1 - index : index;
  return static_cast<uint32_t>(within < size ? within : within < 2 * size ? 2 * size - 1 - within : within - 2 * size);
}

constexpr float kLargest = 1e6f;  // of coordinates and footprints: beyond, floats hold no fraction worth looking at

glm::vec2 sane(glm::vec2 value) {
  const auto one = [](float x) { return std::isfinite(x) ? std::clamp(x, -kLargest, kLargest) : 0.0f; };
  return glm::vec2(one(value.x), one(value.y));
}

// Three channels side by side in a word, 21 bits for each, so that one product weighs all of them.
constexpr int kLaneBits = 21;
constexpr uint64_t kLanes = 1 | uint64_t{1} << kLaneBits | uint64_t{1} << 2 * kLaneBits;
// Of a distance between two pixels; a weighted channel that is weighed once more keeps 13 bits to fit its lane.
constexpr uint32_t kWhole = 256;
constexpr int kDropped = 3;

uint64_t spread(uint32_t pixel) {
  return (pixel & 0xff) | uint64_t{pixel & 0xff00} << (kLaneBits - 8) |
         uint64_t{pixel & 0xff0000} << (2 * kLaneBits - 16);
}

uint64_t between(uint32_t left, uint32_t right, uint32_t share) {
  constexpr uint64_t kKept = kLanes * ((1 << (16 - kDropped)) - 1);
  return ((spread(left) * (kWhole - share) + spread(right) * share) >> kDropped) & kKept;
}

// Display values, 1 is white.
glm::vec3 unpacked(uint64_t lanes) {
  constexpr float kUnit = static_cast<float>(1 << kDropped) / (255.0f * kWhole * kWhole);
  constexpr uint64_t kLane = (uint64_t{1} << kLaneBits) - 1;
  const auto channel = [&](int index) {
    return static_cast<float>(static_cast<int>(lanes >> index * kLaneBits & kLane));
  };
  return glm::vec3(channel(0), channel(1), channel(2)) * kUnit;
}

// Four pixels, and a place between them.
struct Square {
  std::array<uint32_t, 4> pixels;  // upper left, upper right, lower left, lower right
  uint32_t across, down;           // parts of kWhole
};

// Colours times alpha, and alpha.
glm::vec4 meanOf(const Square& square) {
  const auto& [p, across, down] = square;
  if ((p[0] & p[1] & p[2] & p[3]) >> 24 == 255) {
    const uint64_t upper = between(p[0], p[1], across), lower = between(p[2], p[3], across);
    return glm::vec4(unpacked(upper * (kWhole - down) + lower * down), 1);
  }
  std::array<uint64_t, 4> sums{};  // less than 2^40 each
  for (size_t i = 0; i < p.size(); ++i) {
    const uint64_t weight = uint64_t{i % 2 == 0 ? kWhole - across : across} * (i < 2 ? kWhole - down : down);
    const uint64_t alpha = weight * (p[i] >> 24);
    for (size_t channel = 0; channel < 3; ++channel) sums[channel] += alpha * (p[i] >> 8 * channel & 0xff);
    sums[3] += alpha;
  }
  constexpr float kUnit = 1.0f / (255.0f * kWhole * kWhole);
  const auto part = [&](size_t channel) { return static_cast<float>(sums[channel]) * kUnit; };
  return glm::vec4(glm::vec3(part(0), part(1), part(2)) / 255.0f, part(3));
}

}  // namespace

SurfaceKind PyramidSampler::surface(uint32_t texture) const {
  FARCELL_CHECK(texture < pyramids_.size());
  return pyramids_[texture].surface;
}

glm::vec4 PyramidSampler::sample(const TextureLookup& lookup) {
  FARCELL_CHECK(lookup.texture < pyramids_.size());
  const Pyramid& pyramid = pyramids_[lookup.texture];
  if (pyramid.levels.empty()) return glm::vec4(1);
  const glm::vec2 size(static_cast<float>(pyramid.levels[0].width), static_cast<float>(pyramid.levels[0].height));
  const Ellipse ellipse = ellipseOf(sane(lookup.alongX), sane(lookup.alongY), size);
  const float texelEdge = std::max({1.0f, ellipse.minor, ellipse.major / kMaxProbes});
  const int probes = std::clamp(static_cast<int>(ellipse.major / texelEdge + 0.5f), 1, kMaxProbes);
  const glm::vec2 at = sane(lookup.at);
  glm::vec4 sum(0);
  for (int i = 0; i < probes; ++i) {
    const float along = (static_cast<float>(i) + 0.5f) / static_cast<float>(probes) - 0.5f;
    sum += probe(pyramid, at + along * ellipse.axis, texelEdge);
  }
  return sum.w > 0 ? glm::vec4(glm::vec3(sum) / sum.w, sum.w / static_cast<float>(probes)) : glm::vec4(0);
}

TextureShape PyramidSampler::shape(uint32_t texture) const {
  FARCELL_CHECK(texture < pyramids_.size());
  const Pyramid& pyramid = pyramids_[texture];
  const bool plain = !pyramid.surface.hasImage && pyramid.surface.alpha == AlphaMode::opaque;
  if (pyramid.levels.empty() || plain) return {};
  return {pyramid.levels[0].width, pyramid.levels[0].height, pyramid.wrapU, pyramid.wrapV};
}

// Between the two levels whose texels are next in size to `texelEdge` >= 1.
glm::vec4 PyramidSampler::probe(const Pyramid& pyramid, glm::vec2 at, float texelEdge) {
  const auto last = pyramid.levels.size() - 1;
  const size_t level = std::bit_width(static_cast<uint64_t>(texelEdge)) - 1;
  if (level >= last) return bilinear(pyramid, pyramid.levels[last], at);
  const glm::vec4 finer = bilinear(pyramid, pyramid.levels[level], at);
  const float rest = texelEdge / static_cast<float>(uint64_t{1} << level) - 1.0f;
  if (rest == 0) return finer;
  return finer + rest * (bilinear(pyramid, pyramid.levels[level + 1], at) - finer);
}

glm::vec4 PyramidSampler::bilinear(const Pyramid& pyramid, const PyramidLevel& level, glm::vec2 at) {
  // Rows run down, v runs up. Half a pixel from the edge to its middle; then in parts of a pixel.
  const float x = reduced(at.x, pyramid.wrapU) * static_cast<float>(level.width) - 0.5f;
  const float y = reduced(1.0f - at.y, pyramid.wrapV) * static_cast<float>(level.height) - 0.5f;
  const int left = floorOf(x), top = floorOf(y);
  const auto across = static_cast<uint32_t>((x - static_cast<float>(left)) * kWhole + 0.5f);
  const auto down = static_cast<uint32_t>((y - static_cast<float>(top)) * kWhole + 0.5f);
  const uint32_t x0 = wrapped(left, level.width, pyramid.wrapU), x1 = wrapped(left + 1, level.width, pyramid.wrapU);
  const uint32_t y0 = wrapped(top, level.height, pyramid.wrapV), y1 = wrapped(top + 1, level.height, pyramid.wrapV);
  const Square square{{pixel(pyramid, level, x0, y0), pixel(pyramid, level, x1, y0), pixel(pyramid, level, x0, y1),
                       pixel(pyramid, level, x1, y1)},
                      across,
                      down};
  const glm::vec4 mean = meanOf(square);
  const bool test = pyramid.surface.alpha == AlphaMode::mask && &level == pyramid.levels.data();
  if (!test || mean.w == 0) return mean;
  return passes(pyramid.surface, mean.w) ? glm::vec4(glm::vec3(mean) / mean.w, 1) : glm::vec4(0);
}

uint32_t PyramidSampler::pixel(const Pyramid& pyramid, const PyramidLevel& level, uint32_t x, uint32_t y) {
  constexpr uint32_t kEdge = kTileEdge;
  const uint64_t tile = pyramid.firstTile + level.firstTile + y / kEdge * level.tilesAcross + x / kEdge;
  return tiles_.tile(tile)[y % kEdge * kEdge + x % kEdge];
}

}  // namespace farcell
