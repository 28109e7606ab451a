// What the renderer's impostors of a cell show, drawn on the CPU by the shader's own look-up (shaders/shared/look.h).
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "cache/pack/view_space.h"
#include "preprocess/measure/picture.h"

namespace farcell {

// A view as images, as textures hold it.
struct ViewTexels {
  ViewTexels(const ViewImage& image, glm::dvec3 direction, int imageSize);

  int imageSize;
  ResidentView view;
  glm::dvec3 direction;
  std::vector<std::vector<uint8_t>> colours;  // buildColourMips; none for an empty view
  std::vector<std::vector<int8_t>> normals;   // buildNormalMips; none where colours are lit
  std::vector<uint8_t> depths;
};

// A view that has a say, and how much: weights count where three are blended.
struct WeightedView {
  const ViewTexels* texels = nullptr;
  double weight = 0;
};

// The content box, cell-local.
struct LocalBox {
  glm::vec3 min{0}, max{0};
};

// From far away in the direction `toward` (unit), a pixel 2 kViewHalfExtent / edge half sides, four rays each as beside
// triangles of four samples. views: two, the nearest first (kind A); or three by falling weight (kind B). They may be
// empty. `light`, as in shading.h, is that of relightable views. `stride`: of the pixels' rows and columns only each so
// many-th is drawn, from 0; the others stay empty.
Picture impostorPicture(const LocalBox& content, std::span<const WeightedView> views, glm::dvec3 toward,
                        glm::vec3 light, int edge, int stride = 1);

}  // namespace farcell
