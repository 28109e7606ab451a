#include "preprocess/encode/vertex_colours.h"

#include <glm/geometric.hpp>
#include <unordered_map>

#include "cache/base/check.h"
#include "cache/base/hash.h"

namespace farcell {
namespace {

struct Place {
  GridPoint position;
  uint32_t texture;
  glm::vec2 coordinates;
  bool operator==(const Place&) const = default;
};
static_assert(sizeof(Place) == 24, "no padding: it is hashed as bytes");

struct PlaceHash {
  size_t operator()(const Place& place) const { return hashBytes(std::as_bytes(std::span(&place, 1))); }
};

struct Mean {
  glm::dvec3 sum{0};
  double weight = 0;

  // What is transparent colours nothing.
  void add(double area, glm::vec4 colour) {
    sum += area * double{colour.w} * glm::dvec3(colour);
    weight += area * double{colour.w};
  }
};

// Equal numbers with equal bits.
glm::vec2 hashable(glm::vec2 value) { return value + 0.0f; }

Place placeOf(const GridTriangle& triangle, const TriangleTexture& texture, size_t k) {
  return {triangle.corners[k], texture.texture, hashable(texture.coordinates[k])};
}

// The part of the triangle at corner k that is `share` as long along both sides.
TextureLookup partAt(const TriangleTexture& texture, size_t k, float share) {
  const glm::vec2 corner = texture.coordinates[k];
  const glm::vec2 a = share * (texture.coordinates[(k + 1) % 3] - corner);
  const glm::vec2 b = share * (texture.coordinates[(k + 2) % 3] - corner);
  // A square as large as the part, about its middle.
  constexpr float kSide = 0.70710678f;
  return {texture.texture, corner + (a + b) / 3.0f, kSide * a, kSide * b};
}

double areaSteps(const GridTriangle& triangle) {
  const glm::dvec3 a(triangle.corners[1] - triangle.corners[0]), b(triangle.corners[2] - triangle.corners[0]);
  return glm::length(glm::cross(a, b));
}

uint32_t multiplied(uint32_t colour, const Mean& mean) {
  uint32_t product = colour & ~0xffffffu;
  for (int channel = 0; channel < 3; ++channel) {
    const double value = (colour >> 8 * channel & 0xff) * mean.sum[channel] / mean.weight;
    product |= static_cast<uint32_t>(value + 0.5) << 8 * channel;
  }
  return product;
}

template <class Visit>
void forEachCorner(const GridTriangles& list, const Visit& visit) {
  for (size_t i = 0; i < list.size(); ++i)
    for (size_t k = 0; k < 3 && list.textures[i].texture != kNoTexture; ++k) visit(i, k);
}

}  // namespace

std::vector<GridTriangle> withTexturesAsColours(GridTriangles list, TextureSampler* textures) {
  if (list.textures.empty()) return std::move(list.triangles);
  FARCELL_CHECK(textures != nullptr);
  std::unordered_map<Place, Mean, PlaceHash> means;
  // Of what shows at a corner; beside a hole, of what the triangles show elsewhere.
  for (const float share : {0.5f, 1.0f}) {
    std::unordered_map<Place, Mean, PlaceHash> found;
    forEachCorner(list, [&](size_t i, size_t k) {
      const Place place = placeOf(list.triangles[i], list.textures[i], k);
      if (means.contains(place)) return;
      const double area = areaSteps(list.triangles[i]);  // not zero: degenerate triangles were left out
      found[place].add(area, textures->sample(partAt(list.textures[i], k, share)));
    });
    std::erase_if(found, [](const auto& entry) { return entry.second.weight == 0; });
    means.merge(found);
  }
  forEachCorner(list, [&](size_t i, size_t k) {
    const auto mean = means.find(placeOf(list.triangles[i], list.textures[i], k));
    uint32_t& colour = list.triangles[i].colours[k];
    if (mean != means.end()) colour = multiplied(colour, mean->second);
  });
  return std::move(list.triangles);
}

}  // namespace farcell
