#include "preprocess/lod/shown.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <limits>

#include "cache/schema/model.h"
#include "preprocess/lod/rings.h"
#include "preprocess/lod/triangle_tree.h"
#include "shaders/shared/shading.h"

namespace farcell::lod {
namespace {

constexpr uint32_t kNoImage = UINT32_MAX;

glm::dvec3 unpacked(uint32_t colour) { return {colour & 255, colour >> 8 & 255, colour >> 16 & 255}; }

uint32_t packed(glm::dvec3 colour) {
  const auto channel = [](double value) { return static_cast<uint32_t>(std::lround(std::clamp(value, 0.0, 255.0))); };
  return channel(colour.x) | channel(colour.y) << 8 | channel(colour.z) << 16;
}

// A triangle where it lies: twice its area and its normal, of that length.
glm::dvec3 cross(std::span<const GridPoint> places, const Triangle& t) {
  const glm::dvec3 a(places[t[0]]);
  return glm::cross(glm::dvec3(places[t[1]]) - a, glm::dvec3(places[t[2]]) - a);
}

glm::dvec3 middle(std::span<const GridPoint> places, const Triangle& t) {
  return glm::dvec3(places[t[0]] + places[t[1]] + places[t[2]]) / 3.0;
}

class ShownColours {
 public:
  ShownColours(const WeldedMesh& mesh, const Reduction& reduction, glm::vec3 sun)
      : mesh_(mesh), reduction_(reduction), sun_(sun) {
    rings_.build(reduction.triangles, reduction.places.size());
  }

  std::vector<uint32_t> find() {
    std::vector<glm::dvec4> sums(reduction_.triangles.size());
    for (size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const uint32_t image = imageOf(mesh_.triangles[t]);
      const double area = glm::length(cross(mesh_.places, mesh_.triangles[t]));
      if (image != kNoImage) sums[image] += area * glm::dvec4(colour(t), 1);
    }
    std::vector<uint32_t> colours;
    colours.reserve(sums.size());
    for (size_t t = 0; t < sums.size(); ++t)
      colours.push_back(packed(sums[t].w > 0 ? glm::dvec3(sums[t]) / sums[t].w : colour(reduction_.origins[t])));
    return colours;
  }

 private:
  // Of a triangle of the mesh.
  glm::dvec3 colour(size_t t) const {
    if (mesh_.shown[t] != kAsCorners) return unpacked(mesh_.shown[t]);
    glm::dvec3 albedo(kDefaultAlbedo[0], kDefaultAlbedo[1], kDefaultAlbedo[2]);
    if (!mesh_.colours.empty()) {
      const Triangle& corners = mesh_.corners[t];
      albedo = (unpacked(mesh_.colours[corners[0]]) + unpacked(mesh_.colours[corners[1]]) +
                unpacked(mesh_.colours[corners[2]])) /
               3.0;
    }
    const glm::dvec3 normal = cross(mesh_.places, mesh_.triangles[t]);
    const double length = glm::length(normal);
    return albedo * double{length > 0 ? shared::lightFactor(glm::vec3(normal / length), sun_) : shared::kAmbient};
  }

  // The triangle of the reduction that stands for one of the mesh: that of its own corners, where they have moved to,
  // or of those about them the nearest to its middle.
  uint32_t imageOf(const Triangle& t) const {
    const std::array<uint32_t, 3> moved = {reduction_.targets[t[0]], reduction_.targets[t[1]],
                                           reduction_.targets[t[2]]};
    const glm::dvec3 point = middle(mesh_.places, t);
    uint32_t best = kNoImage;
    double least = std::numeric_limits<double>::infinity();
    for (const uint32_t place : moved)
      for (const RingEdge& edge : rings_.of(place)) {
        const Triangle& tried = reduction_.triangles[edge.triangle];
        const double square =
            squareDistance(point, glm::dvec3(reduction_.places[tried[0]]), glm::dvec3(reduction_.places[tried[1]]),
                           glm::dvec3(reduction_.places[tried[2]]));
        if (square < least) least = square, best = edge.triangle;
      }
    return best;
  }

  const WeldedMesh& mesh_;
  const Reduction& reduction_;
  const glm::vec3 sun_;
  Rings rings_;
};

}  // namespace

std::vector<uint32_t> shownColours(const WeldedMesh& mesh, const Reduction& reduction, glm::vec3 sun) {
  return ShownColours(mesh, reduction, sun).find();
}

}  // namespace farcell::lod
