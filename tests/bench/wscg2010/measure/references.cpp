#include "tests/bench/wscg2010/measure/references.h"

#include <algorithm>
#include <cmath>

#include "cache/base/parallel.h"
#include "tools/evaluate/reference/tracer.h"

namespace farcell::wscg {
namespace {

// Faces are shaded flat: no normals are given.
LocalTriangles localTriangles(const Scene& scene) {
  LocalTriangles local;
  local.min = glm::dvec3(scene.min);
  local.max = glm::dvec3(scene.max);
  local.positions.reserve(3 * scene.triangles.size() + 1);
  for (const Triangle& triangle : scene.triangles) {
    const auto first = static_cast<uint32_t>(local.positions.size());
    local.positions.insert(local.positions.end(), triangle.corners.begin(), triangle.corners.end());
    local.colours.insert(local.colours.end(), triangle.colours.begin(), triangle.colours.end());
    local.triangles.emplace_back(first, first + 1, first + 2);
  }
  return local;
}

struct Window {
  int x0, y0, x1, y1;  // pixels; x1 and y1 exclusive
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
};

Window usedWindow(const ReferenceImage& reference, const FrameImage& frame) {
  Window window{reference.width, reference.height, 0, 0};
  for (int y = 0; y < reference.height; ++y) {
    for (int x = 0; x < reference.width; ++x) {
      const size_t pixel = static_cast<size_t>(y) * static_cast<size_t>(reference.width) + static_cast<size_t>(x);
      if (reference.coverage[pixel] <= 0 && frame.rgba[4 * pixel + 3] == 0) continue;
      window = {std::min(window.x0, x), std::min(window.y0, y), std::max(window.x1, x + 1), std::max(window.y1, y + 1)};
    }
  }
  if (window.x0 >= window.x1) return {0, 0, 1, 1};
  return window;
}

template <class Value>
std::vector<Value> cropped(const std::vector<Value>& values, size_t channels, int width, const Window& window) {
  std::vector<Value> result;
  const size_t rowValues = channels * static_cast<size_t>(window.width());
  result.reserve(rowValues * static_cast<size_t>(window.height()));
  for (int y = window.y0; y < window.y1; ++y) {
    const size_t from =
        channels * (static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(window.x0));
    result.insert(result.end(), values.begin() + static_cast<ptrdiff_t>(from),
                  values.begin() + static_cast<ptrdiff_t>(from + rowValues));
  }
  return result;
}

}  // namespace

FullGeometry::FullGeometry(VertexBuffer triangles, EmbreeDevice device, TracedGeometry traced, glm::vec3 sun)
    : triangles_(std::move(triangles)), device_(std::move(device)), traced_(std::move(traced)), sun_(sun) {}

Result<FullGeometry> FullGeometry::create(const Scene& scene) {
  FARCELL_ASSIGN(EmbreeDevice device, createEmbreeDevice(0));
  FARCELL_ASSIGN(TracedGeometry traced, buildTracedGeometry(device.get(), localTriangles(scene)));
  return FullGeometry(uploadTriangles(scene.triangles, scene.sun), std::move(device), std::move(traced), scene.sun);
}

FrameImage FullGeometry::draw(Painter& painter, const Camera& camera) const {
  painter.begin(camera);
  painter.drawTriangles(triangles_);
  return painter.read();
}

ReferenceImage FullGeometry::trace(const Camera& camera, int width, int height, int samples) const {
  SampleImage image(referenceView(camera, width, height), static_cast<int>(std::lround(std::sqrt(samples))), sun_);
  image.trace({&traced_, 1}, threadCount(0));
  return image.finish();
}

ReferenceImage referenceOf(const FrameImage& image) {
  ReferenceImage reference{image.width, image.height, {}, {}};
  for (size_t i = 0; i < image.rgba.size(); i += 4) {
    for (size_t c = 0; c < 3; ++c) reference.rgb.push_back(image.rgba[i + c]);
    reference.coverage.push_back(static_cast<float>(image.rgba[i + 3]) / 255);
  }
  return reference;
}

Metrics measureFrame(const ReferenceImage& reference, const FrameImage& frame) {
  const Window window = usedWindow(reference, frame);
  const ReferenceImage part{window.width(), window.height(), cropped(reference.rgb, 3, reference.width, window),
                            cropped(reference.coverage, 1, reference.width, window)};
  const std::vector<uint8_t> own = cropped(frame.rgba, 4, reference.width, window);
  return measure(part, {part.width, part.height, own, {}}, kBackground);
}

}  // namespace farcell::wscg
