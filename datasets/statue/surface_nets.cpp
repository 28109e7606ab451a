#include "datasets/statue/surface_nets.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "cache/base/parallel.h"

namespace farcell {
namespace {

constexpr int kProjections = 4;
constexpr double kCellMargin = 0.04;  // vertices keep off their cube's faces: no two meet

// Samples of a field at the corners of a lattice of cubes.
class Lattice {
 public:
  Lattice(const Field& field, double cellEdge, int threads) : field_(field), cellEdge_(cellEdge) {
    for (int axis = 0; axis < 3; ++axis)
      size_[axis] = static_cast<int>(std::ceil((field.max[axis] - field.min[axis]) / cellEdge)) + 1;
    samples_.resize(static_cast<size_t>(size_.x) * static_cast<size_t>(size_.y) * static_cast<size_t>(size_.z));
    parallelFor(static_cast<size_t>(size_.z), threads, [&](size_t z, int) {
      for (int y = 0; y < size_.y; ++y)
        for (int x = 0; x < size_.x; ++x) {
          const glm::ivec3 at(x, y, static_cast<int>(z));
          samples_[index(at)] = static_cast<float>(field_.distance(place(at)));
        }
    });
  }

  glm::ivec3 size() const { return size_; }
  size_t index(glm::ivec3 at) const {
    return (static_cast<size_t>(at.z) * static_cast<size_t>(size_.y) + static_cast<size_t>(at.y)) *
               static_cast<size_t>(size_.x) +
           static_cast<size_t>(at.x);
  }
  glm::dvec3 place(glm::ivec3 at) const { return field_.min + glm::dvec3(at) * cellEdge_; }
  double sample(glm::ivec3 at) const { return samples_[index(at)]; }
  bool inside(glm::ivec3 at) const { return samples_[index(at)] < 0; }

  // On the surface inside the cube at `cell`, which it passes.
  glm::dvec3 vertex(glm::ivec3 cell) const;

 private:
  const Field& field_;
  double cellEdge_;
  glm::ivec3 size_{0};
  std::vector<float> samples_;
};

glm::ivec3 corner(glm::ivec3 cell, int i) { return cell + glm::ivec3(i & 1, i >> 1 & 1, i >> 2); }

glm::dvec3 Lattice::vertex(glm::ivec3 cell) const {
  glm::dvec3 sum(0);
  int crossings = 0;
  for (int i = 0; i < 8; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      if (i >> axis & 1) continue;
      const glm::ivec3 from = corner(cell, i);
      const glm::ivec3 to = corner(cell, i | 1 << axis);
      if (inside(from) == inside(to)) continue;
      sum += glm::mix(place(from), place(to), sample(from) / (sample(from) - sample(to)));
      ++crossings;
    }
  glm::dvec3 result = sum / static_cast<double>(crossings);
  const glm::dvec3 low = place(cell) + kCellMargin * cellEdge_;
  const glm::dvec3 high = place(cell) + (1 - kCellMargin) * cellEdge_;
  const double h = 1e-3 * cellEdge_;
  for (int i = 0; i < kProjections; ++i) {
    const double distance = field_.distance(result);
    glm::dvec3 gradient;
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 beside = result;
      beside[axis] += h;
      gradient[axis] = (field_.distance(beside) - distance) / h;
    }
    const double steepness = glm::dot(gradient, gradient);
    if (steepness < 1e-6) break;
    result = glm::clamp(result - gradient * (distance / steepness), low, high);
  }
  return result;
}

struct NetVertex {
  glm::dvec3 position;
  std::array<uint8_t, 3> colour;
};

Result<> addQuad(BaseMeshBuilder& builder, const std::array<NetVertex, 4>& quad) {
  const auto length2 = [&](size_t a, size_t b) {
    const glm::dvec3 d = quad[a].position - quad[b].position;
    return glm::dot(d, d);
  };
  const size_t first = length2(0, 2) <= length2(1, 3) ? 0 : 1;  // the shorter diagonal
  for (const std::array<size_t, 3>& offsets : {std::array<size_t, 3>{0, 1, 2}, std::array<size_t, 3>{0, 2, 3}}) {
    std::array<glm::dvec3, 3> corners;
    std::array<std::array<uint8_t, 3>, 3> colours;
    for (size_t i = 0; i < 3; ++i) {
      const NetVertex& vertex = quad[(first + offsets[i]) % 4];
      corners[i] = vertex.position;
      colours[i] = vertex.colour;
    }
    FARCELL_TRY(builder.add(corners, colours));
  }
  return {};
}

// The quad across the lattice edge from `at` along `axis`: the four cubes around it.
std::array<glm::ivec3, 4> cubesAround(glm::ivec3 at, int axis, bool fromInside) {
  glm::ivec3 u(0), v(0);
  u[(axis + 1) % 3] = 1;
  v[(axis + 2) % 3] = 1;
  if (!fromInside) std::swap(u, v);
  return {at, at - u, at - u - v, at - v};
}

}  // namespace

Result<BaseMesh> surfaceNets(const Field& field, double cellEdge, int threads) {
  const Lattice lattice(field, cellEdge, threads);
  const glm::ivec3 size = lattice.size();
  // Vertices of the cubes that the surface passes, by the cube's lowest corner.
  std::vector<uint32_t> numbers(static_cast<size_t>(size.x) * static_cast<size_t>(size.y) *
                                static_cast<size_t>(size.z));
  std::vector<glm::ivec3> cells;
  for (int z = 0; z + 1 < size.z; ++z)
    for (int y = 0; y + 1 < size.y; ++y)
      for (int x = 0; x + 1 < size.x; ++x) {
        int insideCorners = 0;
        for (int i = 0; i < 8; ++i) insideCorners += lattice.inside(corner({x, y, z}, i)) ? 1 : 0;
        if (insideCorners == 0 || insideCorners == 8) continue;
        numbers[lattice.index({x, y, z})] = static_cast<uint32_t>(cells.size());
        cells.push_back({x, y, z});
      }
  std::vector<NetVertex> vertices(cells.size());
  parallelFor(cells.size(), threads, [&](size_t i, int) {
    const glm::dvec3 position = lattice.vertex(cells[i]);
    vertices[i] = {position, field.colour(position)};
  });
  BaseMeshBuilder builder;
  for (const glm::ivec3& cell : cells)
    for (int axis = 0; axis < 3; ++axis) {
      glm::ivec3 next = cell;
      ++next[axis];
      if (lattice.inside(cell) == lattice.inside(next)) continue;
      std::array<NetVertex, 4> quad;
      const auto around = cubesAround(cell, axis, lattice.inside(cell));
      for (size_t i = 0; i < 4; ++i) quad[i] = vertices[numbers[lattice.index(around[i])]];
      FARCELL_TRY(addQuad(builder, quad));
    }
  return std::move(builder).finish();
}

}  // namespace farcell
