// Pictures of a cell by parallel rays: what views show of it is compared with what its triangles do.
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "preprocess/bake/view_baker.h"

namespace farcell {

// A square picture over the same part of a ViewFrame's plane as a view of the cell, edge x edge pixels.
struct Picture {
  explicit Picture(int pixels) : edge(pixels), rgba(static_cast<size_t>(pixels) * static_cast<size_t>(pixels)) {}

  int edge;
  std::vector<glm::vec4> rgba;  // [0, 1], premultiplied by coverage; row 0 is the lowest
};

// From a direction and from its antipode.
struct PicturePair {
  Picture front, back;
  const Picture& side(int i) const { return i == 0 ? front : back; }
};

// Of lit triangles.
PicturePair takePair(const CellSoup& soup, TextureSampler* textures, glm::vec3 sun, glm::dvec3 direction, int edge,
                     int samples);
Picture pictureOf(const BakedView& baked, int edge);
// Each pixel the mean of four. REQUIRES: an even edge.
Picture halved(const Picture& picture);

// Pixels where the same content was seen with and without what lies around it: what does not differ is the cell's own.
// Of a coarser picture, those whose every part is.
class OwnPixels {
 public:
  OwnPixels(const Picture& alone, const Picture& amongOthers);
  bool at(int edge, int x, int y) const;  // of a picture of so many pixels, the finest's edge divided by a power of two

 private:
  std::vector<std::vector<bool>> levels_;  // each of half the edge
  int edge_;
};

// Sums over own pixels, both over the background that pictures are evaluated on.
struct ErrorSum {
  double error = 0;    // |dR| + |dG| + |dB|, 0-255
  double covered = 0;  // pixels of the truth, by coverage

  // stride: only each so many-th row and column counts.
  double mean() const { return covered > 0 ? error / covered : 0; }
  void add(const ErrorSum& other) {
    error += other.error;
    covered += other.covered;
  }
  void add(const Picture& truth, const Picture& picture, const OwnPixels& own, int stride = 1);
};
inline constexpr glm::vec3 kMeasureBackground(179.0f / 255, 204.0f / 255, 230.0f / 255);

}  // namespace farcell
