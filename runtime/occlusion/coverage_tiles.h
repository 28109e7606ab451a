// Which part of a picture is surely covered, and how far away at most: tiles of 64 samples, of which a mask says which
// are covered and two depths how far the covering surface may reach (Hasselgren, Andersson, Akenine-Moeller, Masked
// Software Occlusion Culling, HPG 2016, with the samples of the picture itself in place of a coarser grid).
//
// Depths are 1 / distance along the view axis: larger is nearer, and linear over a triangle's picture. A tile's
// depth is that of the farthest point, in the tile, of what covers it.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace farcell {

// That an edge may be drawn off its place: GPUs snap vertices to 1/256 of a pixel, along each axis.
inline constexpr double kSnapPixels = 1.0 / 128;

class CoverageTiles {
 public:
  // samples: where each lies in its pixel, [0, 1)^2, y up; 1 (tiles of 8 x 8 pixels) or 4 (of 4 x 4).
  CoverageTiles(int width, int height, std::span<const glm::vec2> samples);

  // x, y in pixels, y up; z: depth, > 0. Triangles had best come nearest first. inner: of the edge from each corner to
  // the next, whether another triangle is drawn from just this edge on to its other side; if so, samples on it are
  // covered, else those nearer to it than kSnapPixels are not.
  void add(const std::array<glm::dvec3, 3>& corners, const std::array<bool, 3>& inner);

  // Whether every sample of the rectangle, cut to the picture, is covered by what is nearer than `depth` everywhere.
  // True where it lies beside the picture.
  bool covers(glm::dvec2 min, glm::dvec2 max, double depth) const;

  uint64_t tilesTouched() const { return tilesTouched_; }  // by what was added

 private:
  struct Tile {
    uint64_t mask = 0;  // of samples covered by the layer in the making
    float layer = 0;    // its depth
    float depth = 0;    // of the last layer that was whole; 0: none
  };
  struct Edge {
    double a, b, c;  // inside where a x + b y + c >= 0; (a, b) unit
  };
  uint64_t maskOf(const std::array<Edge, 3>& edges, double x, double y) const;

  int tileEdge_;
  int columns_;
  int rows_;
  std::vector<Tile> tiles_;
  std::array<float, 64> sampleX_{}, sampleY_{};  // from the tile's lower left corner, pixels
  uint64_t tilesTouched_ = 0;
};

}  // namespace farcell
