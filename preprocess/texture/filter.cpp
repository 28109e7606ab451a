#include "preprocess/texture/filter.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

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

// Into [-1, 2], where the wrap mode gives the same pixels.
float reduced(float coordinate, TextureWrap wrap) {
  if (wrap == TextureWrap::clamp) return std::clamp(coordinate, -1.0f, 2.0f);
  const float period = wrap == TextureWrap::repeat ? 1.0f : 2.0f;
  return coordinate - period * std::floor(coordinate / period);
}

uint32_t wrapped(int index, int size, TextureWrap wrap) {
  if (wrap == TextureWrap::clamp) return static_cast<uint32_t>(std::clamp(index, 0, size - 1));
  const int period = wrap == TextureWrap::repeat ? size : 2 * size;
  const int within = ((index % period) + period) % period;
  return static_cast<uint32_t>(within < size ? within : period - 1 - within);
}

constexpr float kLargest = 1e6f;  // of coordinates and footprints: beyond, floats hold no fraction worth looking at

glm::vec2 sane(glm::vec2 value) {
  const auto one = [](float x) { return std::isfinite(x) ? std::clamp(x, -kLargest, kLargest) : 0.0f; };
  return glm::vec2(one(value.x), one(value.y));
}

glm::vec3 unpack(uint32_t pixel) {
  return glm::vec3(static_cast<float>(pixel & 255), static_cast<float>(pixel >> 8 & 255),
                   static_cast<float>(pixel >> 16 & 255));
}

}  // namespace

glm::vec3 PyramidSampler::sample(const TextureLookup& lookup) {
  FARCELL_CHECK(lookup.texture < pyramids_.size());
  const Pyramid& pyramid = pyramids_[lookup.texture];
  if (pyramid.levels.empty()) return glm::vec3(1);
  const glm::vec2 size(static_cast<float>(pyramid.levels[0].width), static_cast<float>(pyramid.levels[0].height));
  const Ellipse ellipse = ellipseOf(sane(lookup.alongX), sane(lookup.alongY), size);
  const float texelEdge = std::max({1.0f, ellipse.minor, ellipse.major / kMaxProbes});
  const int probes = std::clamp(static_cast<int>(std::ceil(ellipse.major / texelEdge)), 1, kMaxProbes);
  const glm::vec2 at = sane(lookup.at);
  glm::vec3 sum(0);
  for (int i = 0; i < probes; ++i) {
    const float along = (static_cast<float>(i) + 0.5f) / static_cast<float>(probes) - 0.5f;
    sum += probe(pyramid, at + along * ellipse.axis, texelEdge);
  }
  return sum / (255.0f * static_cast<float>(probes));
}

// Between the two levels whose texels are next in size to `texelEdge` >= 1.
glm::vec3 PyramidSampler::probe(const Pyramid& pyramid, glm::vec2 at, float texelEdge) {
  const auto last = pyramid.levels.size() - 1;
  const auto level = static_cast<size_t>(std::ilogb(texelEdge));
  if (level >= last) return bilinear(pyramid, pyramid.levels[last], at);
  const glm::vec3 finer = bilinear(pyramid, pyramid.levels[level], at);
  const float rest = std::ldexp(texelEdge, -static_cast<int>(level)) - 1.0f;
  if (rest == 0) return finer;
  return finer + rest * (bilinear(pyramid, pyramid.levels[level + 1], at) - finer);
}

glm::vec3 PyramidSampler::bilinear(const Pyramid& pyramid, const PyramidLevel& level, glm::vec2 at) {
  // Rows run down, v runs up.
  const float x = reduced(at.x, pyramid.wrapU) * static_cast<float>(level.width) - 0.5f;
  const float y = reduced(1.0f - at.y, pyramid.wrapV) * static_cast<float>(level.height) - 0.5f;
  const float left = std::floor(x), top = std::floor(y);
  const auto ix = static_cast<int>(left), iy = static_cast<int>(top);
  const uint32_t x0 = wrapped(ix, level.width, pyramid.wrapU), x1 = wrapped(ix + 1, level.width, pyramid.wrapU);
  const uint32_t y0 = wrapped(iy, level.height, pyramid.wrapV), y1 = wrapped(iy + 1, level.height, pyramid.wrapV);
  const glm::vec3 upper = glm::mix(pixel(pyramid, level, x0, y0), pixel(pyramid, level, x1, y0), x - left);
  const glm::vec3 lower = glm::mix(pixel(pyramid, level, x0, y1), pixel(pyramid, level, x1, y1), x - left);
  return glm::mix(upper, lower, y - top);
}

glm::vec3 PyramidSampler::pixel(const Pyramid& pyramid, const PyramidLevel& level, uint32_t x, uint32_t y) {
  constexpr uint32_t kEdge = kTileEdge;
  const uint64_t tile = level.firstTile + y / kEdge * level.tilesAcross() + x / kEdge;
  return unpack(tiles_.tile(pyramid.firstTile + tile)[y % kEdge * kEdge + x % kEdge]);
}

}  // namespace farcell
