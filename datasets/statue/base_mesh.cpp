#include "datasets/statue/base_mesh.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <unordered_map>

#include "datasets/random/random.h"

namespace farcell {
namespace {

constexpr size_t kMaxTriangles = size_t{1} << 31;
// Cosines between a corner's normal and its triangles': creases are not rounded.
constexpr double kCreaseCosine = 0.64;
constexpr double kSmoothCosine = 0.87;

struct PlaceHash {
  size_t operator()(const glm::dvec3& p) const {
    const auto bits = [](double value) { return std::bit_cast<int64_t>(value); };
    return keyOf(0, bits(p.x), bits(p.y), bits(p.z));
  }
};

glm::dvec3 unitOrZero(glm::dvec3 v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : glm::dvec3(0);
}

void scaleToUnit(BaseMesh& mesh, glm::dvec3 min, glm::dvec3 max) {
  mesh.middle = min * 0.5 + max * 0.5;
  mesh.diagonal = glm::length(max - min);
  for (glm::dvec3& position : mesh.positions) position = (position - mesh.middle) / mesh.diagonal;
}

// Its length is twice the triangle's area. REQUIRES: scaled to unit, or those of a model in micrometres would
// underflow.
glm::dvec3 areaNormal(const BaseMesh& mesh, const BaseMesh::Triangle& triangle) {
  const glm::dvec3 a = mesh.positions[triangle[0]];
  return glm::cross(mesh.positions[triangle[1]] - a, mesh.positions[triangle[2]] - a);
}

void addNormals(BaseMesh& mesh) {
  mesh.normals.assign(mesh.positions.size(), glm::dvec3(0));
  for (const BaseMesh::Triangle& triangle : mesh.triangles)
    for (const uint32_t corner : triangle) mesh.normals[corner] += areaNormal(mesh, triangle);
  for (glm::dvec3& normal : mesh.normals) normal = unitOrZero(normal);
}

void addRoundness(BaseMesh& mesh) {
  std::vector<float> least(mesh.positions.size(), 1.0f);
  for (const BaseMesh::Triangle& triangle : mesh.triangles) {
    const glm::dvec3 normal = unitOrZero(areaNormal(mesh, triangle));
    for (const uint32_t corner : triangle)
      least[corner] = std::min(least[corner], static_cast<float>(glm::dot(normal, mesh.normals[corner])));
  }
  mesh.roundness.reserve(least.size());
  for (const float cosine : least)
    mesh.roundness.push_back(
        static_cast<float>(glm::smoothstep(kCreaseCosine, kSmoothCosine, static_cast<double>(cosine))));
}

// Sides sorted by their edge: each run of equal ones is one edge.
void addEdges(BaseMesh& mesh) {
  struct Side {
    uint64_t edge;  // lower corner, higher corner
    uint64_t place;
  };
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (size_t t = 0; t < mesh.triangles.size(); ++t)
    for (size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(mesh.triangles[t][i], mesh.triangles[t][(i + 1) % 3]);
      sides.push_back({uint64_t{low} << 32 | high, 3 * t + i});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& l, const Side& r) { return l.edge < r.edge; });
  mesh.sides.resize(mesh.triangles.size());
  for (size_t i = 0; i < sides.size(); ++i) {
    if (i == 0 || sides[i].edge != sides[i - 1].edge)
      mesh.edges.push_back({static_cast<uint32_t>(sides[i].edge >> 32), static_cast<uint32_t>(sides[i].edge)});
    mesh.sides[sides[i].place / 3][sides[i].place % 3] = static_cast<uint32_t>(mesh.edges.size() - 1);
  }
}

}  // namespace

struct BaseMeshBuilder::Impl {
  uint32_t indexOf(glm::dvec3 place, std::array<uint8_t, 3> colour);

  BaseMesh mesh;
  glm::dvec3 min{INFINITY};
  glm::dvec3 max{-INFINITY};
  std::unordered_map<glm::dvec3, uint32_t, PlaceHash> indices;
};

uint32_t BaseMeshBuilder::Impl::indexOf(glm::dvec3 place, std::array<uint8_t, 3> colour) {
  place += 0.0;  // -0 becomes 0: one place, one key
  const auto [found, isNew] = indices.try_emplace(place, static_cast<uint32_t>(mesh.positions.size()));
  if (isNew) {
    mesh.positions.push_back(place);
    mesh.colours.push_back(colour);
    min = glm::min(min, place);
    max = glm::max(max, place);
  }
  return found->second;
}

BaseMeshBuilder::BaseMeshBuilder() : impl_(std::make_unique<Impl>()) {}
BaseMeshBuilder::BaseMeshBuilder(BaseMeshBuilder&&) noexcept = default;
BaseMeshBuilder::~BaseMeshBuilder() = default;

Result<> BaseMeshBuilder::add(const std::array<glm::dvec3, 3>& corners,
                              const std::array<std::array<uint8_t, 3>, 3>& colours) {
  if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) return {};
  if (impl_->mesh.triangles.size() >= kMaxTriangles || impl_->mesh.positions.size() + 3 > kMaxTriangles)
    return fail(ErrorKind::exhausted, "a statue grows from at most {} triangles", kMaxTriangles);
  BaseMesh::Triangle triangle;
  for (size_t i = 0; i < 3; ++i) triangle[i] = impl_->indexOf(corners[i], colours[i]);
  impl_->mesh.triangles.push_back(triangle);
  return {};
}

Result<BaseMesh> BaseMeshBuilder::finish() && {
  BaseMesh mesh = std::move(impl_->mesh);
  impl_->indices.clear();
  if (mesh.triangles.empty()) return fail(ErrorKind::corrupt, "there is no triangle to grow a statue from");
  if (!std::isfinite(glm::length(impl_->max - impl_->min)) || !(glm::length(impl_->max - impl_->min) > 0))
    return fail(ErrorKind::unsupported, "the model is too large or too small for its size to be a number");
  scaleToUnit(mesh, impl_->min, impl_->max);
  addNormals(mesh);
  addRoundness(mesh);
  addEdges(mesh);
  return mesh;
}

}  // namespace farcell
