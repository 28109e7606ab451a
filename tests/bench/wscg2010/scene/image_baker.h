// Images of a cell, orthographic and perspective, by farcell's own baker.
//
// A perspective image is baked as an orthographic one: dividing by the distance to the eye's plane maps planes to
// planes and lines to lines, so triangles stay triangles; the depth that goes with it, 1 / distance, keeps their order.
// Shading must not see the mapped shape: every triangle brings its own normal. Colours are linear across the mapped
// triangle, as OpenGL's "noperspective": no difference where a triangle has one colour, and little within a small one.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "preprocess/bake/view_baker.h"
#include "tests/bench/wscg2010/scene/cells.h"

namespace farcell::wscg {

// RGBA8, colour premultiplied by coverage (all or nothing at one sample a texel), cropped to what is covered. Row 0 is
// the lowest.
struct CellImage {
  int x0 = 0, y0 = 0, width = 0, height = 0;  // texels; width == 0: nothing is seen
  std::vector<uint8_t> rgba;
  bool operator==(const CellImage&) const = default;
};

struct ImageSettings {
  double fovRad =
      0;            // 0: orthographic; else the camera stands R / sin(fov / 2) from the centre of a sphere of radius R
  int size = 128;   // texels along the edge
  int samples = 1;  // per texel
  bool operator==(const ImageSettings&) const = default;
};

// Half the width of an image on the plane through the cell's centre, over the radius of the enclosed sphere.
double imageHalfWidth(double fovRad);

// Reused from image to image; one per thread.
class ImageBaker {
 public:
  ImageBaker(const ImageSettings& settings, glm::vec3 sun);

  // The image from `direction` (unit, from the centre to the viewer), with the axes of viewFrame(direction).
  CellImage bake(const CellContent& content, glm::dvec3 direction);

 private:
  void addOrthographic(const CellContent& content, const ViewFrame& frame);
  void addPerspective(const CellContent& content, const ViewFrame& frame);

  ImageSettings settings_;
  ViewBaker baker_;
  CellSoup soup_;  // scratch
};

}  // namespace farcell::wscg
