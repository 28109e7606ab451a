#include "datasets/statue/surface_nets.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include "cache/base/parallel.h"

namespace farcell {
namespace {

constexpr int kBlock = 8;          // samples along an edge of a block that is looked at as a whole
constexpr double kFieldTrust = 2;  // blocks this many radii from the surface hold none of it
constexpr int kProjections = 3;
constexpr int kRelaxations = 5;  // towards even triangles

// Samples of a field at the corners of a lattice of cubes.
class Lattice {
 public:
  Lattice(const Field& field, double cellEdge, int threads) : field_(field), cellEdge_(cellEdge) {
    for (int axis = 0; axis < 3; ++axis)
      size_[axis] = static_cast<int>(std::ceil((field.max[axis] - field.min[axis]) / cellEdge)) + 1;
    samples_.resize(static_cast<size_t>(size_.x) * static_cast<size_t>(size_.y) * static_cast<size_t>(size_.z));
    const glm::ivec3 blocks = (size_ + kBlock - 1) / kBlock;
    parallelFor(static_cast<size_t>(blocks.z), threads, [&](size_t z, int) {
      for (int y = 0; y < blocks.y; ++y)
        for (int x = 0; x < blocks.x; ++x) sampleBlock(glm::ivec3(x, y, static_cast<int>(z)) * kBlock);
    });
  }

  glm::ivec3 size() const { return size_; }
  size_t index(glm::ivec3 at) const {
    return (static_cast<size_t>(at.z) * static_cast<size_t>(size_.y) + static_cast<size_t>(at.y)) *
               static_cast<size_t>(size_.x) +
           static_cast<size_t>(at.x);
  }
  size_t sampleCount() const { return samples_.size(); }
  glm::dvec3 place(glm::ivec3 at) const { return field_.min + glm::dvec3(at) * cellEdge_; }
  double sample(glm::ivec3 at) const { return samples_[index(at)]; }
  bool inside(glm::ivec3 at) const { return samples_[index(at)] < 0; }

  // The mean of where the edges of the cube at `cell`, which the surface passes, cut it.
  glm::dvec3 crossing(glm::ivec3 cell) const;
  // The nearest point of the surface, for a point within about a cube of it.
  glm::dvec3 onSurface(glm::dvec3 point) const;

  // Bits of the corners of a cube that are inside.
  int insideMask(glm::ivec3 cell) const;
  // Moves samples inside until in every cube both the corners inside and those outside hang together: the surface then
  // passes each cube once, and the net is closed and without edges of four faces.
  void fillAmbiguous();

 private:
  void sampleBlock(glm::ivec3 low);

  const Field& field_;
  double cellEdge_;
  glm::ivec3 size_{0};
  std::vector<float> samples_;
};

// Most blocks are far from the surface: one sample tells the side of all.
void Lattice::sampleBlock(glm::ivec3 low) {
  const glm::ivec3 end = glm::min(low + kBlock, size_);
  const double radius = 0.5 * std::sqrt(3.0) * kBlock * cellEdge_;
  const double middle = field_.distance(place(low) + 0.5 * kBlock * cellEdge_);
  const bool isFar = std::abs(middle) > kFieldTrust * radius;
  for (int z = low.z; z < end.z; ++z)
    for (int y = low.y; y < end.y; ++y)
      for (int x = low.x; x < end.x; ++x) {
        const glm::ivec3 at(x, y, z);
        samples_[index(at)] = static_cast<float>(isFar ? middle : field_.distance(place(at)));
      }
}

glm::ivec3 corner(glm::ivec3 cell, int i) { return cell + glm::ivec3(i & 1, i >> 1 & 1, i >> 2); }

int Lattice::insideMask(glm::ivec3 cell) const {
  int mask = 0;
  for (int i = 0; i < 8; ++i) mask |= inside(corner(cell, i)) ? 1 << i : 0;
  return mask;
}

// Whether all corners of a mask can be reached from one another along a cube's edges.
bool hangsTogether(int mask) {
  int reached = mask & -mask;
  for (int before = 0; before != reached;) {
    before = reached;
    for (int i = 0; i < 8; ++i)
      if (before >> i & 1) reached |= (1 << (i ^ 1) | 1 << (i ^ 2) | 1 << (i ^ 4)) & mask;
  }
  return reached == mask;
}

void Lattice::fillAmbiguous() {
  std::array<bool, 256> isPlain{};
  for (int mask = 0; mask < 256; ++mask)
    isPlain[static_cast<size_t>(mask)] = hangsTogether(mask) && hangsTogether(255 - mask);
  for (bool changed = true; changed;) {
    changed = false;
    for (int z = 0; z + 1 < size_.z; ++z)
      for (int y = 0; y + 1 < size_.y; ++y)
        for (int x = 0; x + 1 < size_.x; ++x) {
          if (isPlain[static_cast<size_t>(insideMask({x, y, z}))]) continue;
          float* nearest = nullptr;
          for (int i = 0; i < 8; ++i) {
            float& sample = samples_[index(corner({x, y, z}, i))];
            if (sample >= 0 && (nearest == nullptr || sample < *nearest)) nearest = &sample;
          }
          *nearest = static_cast<float>(-1e-3 * cellEdge_);
          changed = true;
        }
  }
}

glm::dvec3 Lattice::crossing(glm::ivec3 cell) const {
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
  return sum / static_cast<double>(crossings);
}

glm::dvec3 Lattice::onSurface(glm::dvec3 point) const {
  const double h = 1e-3 * cellEdge_;
  for (int i = 0; i < kProjections; ++i) {
    const double distance = field_.distance(point);
    glm::dvec3 gradient;
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 beside = point;
      beside[axis] += h;
      gradient[axis] = (field_.distance(beside) - distance) / h;
    }
    const double steepness = glm::dot(gradient, gradient);
    if (steepness < 1e-2) break;
    point -= gradient * (distance / steepness);
  }
  return point;
}

// The quad across the lattice edge from `at` along `axis`: the four cubes around it.
std::array<glm::ivec3, 4> cubesAround(glm::ivec3 at, int axis, bool fromInside) {
  glm::ivec3 u(0), v(0);
  u[(axis + 1) % 3] = 1;
  v[(axis + 2) % 3] = 1;
  if (!fromInside) std::swap(u, v);
  return {at, at - u, at - u - v, at - v};
}

using Quad = std::array<uint32_t, 4>;

struct Net {
  std::vector<glm::dvec3> positions;
  std::vector<Quad> quads;
};

Net makeNet(const Lattice& lattice) {
  const glm::ivec3 size = lattice.size();
  std::vector<uint32_t> numbers(lattice.sampleCount());  // of the vertices, by their cube's lowest corner
  std::vector<glm::ivec3> cells;
  Net net;
  for (int z = 0; z + 1 < size.z; ++z)
    for (int y = 0; y + 1 < size.y; ++y)
      for (int x = 0; x + 1 < size.x; ++x) {
        const int mask = lattice.insideMask({x, y, z});
        if (mask == 0 || mask == 255) continue;
        numbers[lattice.index({x, y, z})] = static_cast<uint32_t>(cells.size());
        cells.push_back({x, y, z});
        net.positions.push_back(lattice.crossing({x, y, z}));
      }
  for (const glm::ivec3& cell : cells)
    for (int axis = 0; axis < 3; ++axis) {
      glm::ivec3 next = cell;
      ++next[axis];
      if (lattice.inside(cell) == lattice.inside(next)) continue;
      const auto around = cubesAround(cell, axis, lattice.inside(cell));
      Quad quad;
      for (size_t i = 0; i < 4; ++i) quad[i] = numbers[lattice.index(around[i])];
      net.quads.push_back(quad);
    }
  return net;
}

// Half way to the mean of its neighbours, then back onto the surface.
void relax(Net& net, const Lattice& lattice, int threads) {
  std::vector<glm::dvec4> sums(net.positions.size(), glm::dvec4(0));
  for (const Quad& quad : net.quads)
    for (size_t i = 0; i < 4; ++i) {
      sums[quad[i]] += glm::dvec4(net.positions[quad[(i + 1) % 4]], 1);
      sums[quad[i]] += glm::dvec4(net.positions[quad[(i + 3) % 4]], 1);
    }
  parallelFor(net.positions.size(), threads, [&](size_t i, int) {
    net.positions[i] = lattice.onSurface(glm::mix(net.positions[i], glm::dvec3(sums[i]) / sums[i].w, 0.5));
  });
}

}  // namespace

Result<BaseMesh> surfaceNets(const Field& field, double cellEdge, int threads) {
  Lattice lattice(field, cellEdge, threads);
  lattice.fillAmbiguous();
  Net net = makeNet(lattice);
  for (int i = 0; i < kRelaxations; ++i) relax(net, lattice, threads);
  std::vector<std::array<uint8_t, 3>> colours(net.positions.size());
  parallelFor(colours.size(), threads, [&](size_t i, int) { colours[i] = field.colour(net.positions[i]); });
  BaseMeshBuilder builder;
  for (const Quad& quad : net.quads) {
    const auto diagonal = [&](size_t i) { return glm::length(net.positions[quad[i]] - net.positions[quad[i + 2]]); };
    const size_t first = diagonal(0) <= diagonal(1) ? 0 : 1;  // cut along the shorter one
    for (size_t last = 2; last < 4; ++last) {
      const Quad corners = {quad[first], quad[(first + last - 1) % 4], quad[(first + last) % 4]};
      FARCELL_TRY(builder.add({net.positions[corners[0]], net.positions[corners[1]], net.positions[corners[2]]},
                              {colours[corners[0]], colours[corners[1]], colours[corners[2]]}));
    }
  }
  return std::move(builder).finish();
}

}  // namespace farcell
