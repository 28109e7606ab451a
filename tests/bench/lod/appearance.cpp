#include "tests/bench/lod/appearance.h"

#include <cmath>

#include "cache/schema/model.h"
#include "cache/schema/viewpoints.h"

namespace farcell::bench {
namespace {

constexpr float kBackground = 0.5f;

struct Image {
  int size;
  std::vector<float> rgba;
  explicit Image(int edge, const BakedView& view) : size(edge), rgba(size_t(4) * size_t(edge) * size_t(edge)) {
    for (int y = 0; y < view.height; ++y)
      for (int x = 0; x < view.width * 4; ++x)
        rgba[size_t(4 * ((view.y0 + y) * size + view.x0) + x)] = view.rgba[size_t(4 * y * view.width + x)];
  }
};

struct Sums {
  double full = 0, simplified = 0, difference = 0, texels = 0;
  void add(const Image& a, const Image& b) {
    for (size_t i = 0; i < a.rgba.size(); i += 4) {
      const float *p = &a.rgba[i], *q = &b.rgba[i];
      full += p[3];
      simplified += q[3];
      if (p[3] == 0 && q[3] == 0) continue;
      ++texels;
      for (int channel = 0; channel < 3; ++channel)
        difference += std::abs(p[channel] - q[channel] + kBackground * (q[3] - p[3])) * 255 / 3;
    }
  }
};

}  // namespace

CellSoup cellSoup(const Grid& grid, const CellKey& cell, const LodMesh& mesh) {
  const GridBox box = cellBox(grid, cell);
  const glm::dvec3 centre = 0.5 * (glm::dvec3(box.min) + glm::dvec3(box.max));
  const double half = 0.5 * (box.max.x - box.min.x);
  CellSoup soup;
  for (size_t i = 0; i < mesh.indices.size(); ++i) {
    const uint32_t vertex = mesh.indices[i];
    const glm::vec3 p((glm::dvec3(mesh.positions[vertex]) - centre) / half);
    soup.x[i % 3].push_back(p.x);
    soup.y[i % 3].push_back(p.y);
    soup.z[i % 3].push_back(p.z);
    soup.colours[i % 3].push_back(mesh.colours.empty() ? 0xc0c8cc : mesh.colours[vertex]);
  }
  return soup;
}

Appearance compare(const CellSoup& full, const CellSoup& simplified, int imageSize) {
  BakeSettings settings;
  settings.imageSize = imageSize;
  settings.samples = 16;
  settings.sun = sunDirection(UpAxis::z, Sun{});
  ViewBaker baker(settings);
  const Viewpoints viewpoints = Viewpoints::create(42).value();
  const auto bake = [&](const CellSoup& soup, int view) {
    std::array<BakedView, 2> views;
    baker.begin(viewFrame(viewpoints.directions()[size_t(view)]));
    baker.add(soup);
    baker.finish(views[0], views[1]);
    return views;
  };
  Sums sums;
  for (int view = 0; view < viewpoints.count(); ++view) {
    if (view > viewpoints.antipode(view)) continue;
    const auto a = bake(full, view), b = bake(simplified, view);
    for (size_t side = 0; side < 2; ++side) sums.add(Image(imageSize, a[side]), Image(imageSize, b[side]));
  }
  return {sums.simplified / sums.full, sums.texels > 0 ? sums.difference / sums.texels : 0};
}

}  // namespace farcell::bench
