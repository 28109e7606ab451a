#include "tests/support/synthetic_bake.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include "cache/schema/view_frame.h"
#include "shaders/shared/shading.h"

namespace farcell {
namespace {

struct Sample {
  double w = -INFINITY;
  glm::dvec3 colour{0};
  glm::dvec3 normal{0};
};

bool inGrownCube(glm::dvec3 p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= kCellGrowth; }

glm::dvec3 towards(glm::dvec3 direction, glm::dvec3 normal) {
  return glm::dot(direction, normal) < 0 ? -normal : normal;
}

// Octahedral, [0, 255] for [-1, 1], and the length.
std::array<uint8_t, 3> normalBytes(glm::dvec3 mean) {
  if (glm::length(mean) < 1e-9) return {0, 0, 0};
  const glm::vec2 p = shared::octahedralFromUnit(glm::vec3(glm::normalize(mean)));
  return {static_cast<uint8_t>(std::lround((p.x * 0.5f + 0.5f) * 255)),
          static_cast<uint8_t>(std::lround((p.y * 0.5f + 0.5f) * 255)),
          static_cast<uint8_t>(std::lround(glm::length(mean) * 255))};
}

class Image {
 public:
  Image(const ViewFrame& frame, int samplesAcross)
      : frame_(frame),
        across_(samplesAcross),
        samples_(static_cast<size_t>(samplesAcross) * static_cast<size_t>(samplesAcross)) {}

  void draw(const LocalTriangle& triangle) {
    std::array<glm::dvec3, 3> p;
    for (size_t i = 0; i < 3; ++i)
      p[i] = {sampleOf(glm::dot(triangle.corners[i], frame_.right)), sampleOf(glm::dot(triangle.corners[i], frame_.up)),
              glm::dot(triangle.corners[i], frame_.toward)};
    const double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
    if (std::abs(area) < 1e-12) return;
    const glm::dvec3 normal =
        towards(frame_.toward, glm::normalize(glm::cross(triangle.corners[1] - triangle.corners[0],
                                                         triangle.corners[2] - triangle.corners[0])));
    const auto low = [&](int axis) {
      return std::max(0, static_cast<int>(std::floor(std::min({p[0][axis], p[1][axis], p[2][axis]}))) - 1);
    };
    const auto high = [&](int axis) {
      return std::min(across_ - 1, static_cast<int>(std::ceil(std::max({p[0][axis], p[1][axis], p[2][axis]}))) + 1);
    };
    for (int y = low(1); y <= high(1); ++y)
      for (int x = low(0); x <= high(0); ++x) {
        const double px = x + 0.5, py = y + 0.5;
        const double b = ((px - p[0].x) * (p[2].y - p[0].y) - (py - p[0].y) * (p[2].x - p[0].x)) / area;
        const double c = ((p[1].x - p[0].x) * (py - p[0].y) - (p[1].y - p[0].y) * (px - p[0].x)) / area;
        const double a = 1 - b - c;
        if (a < 0 || b < 0 || c < 0) continue;
        if (!inGrownCube(a * triangle.corners[0] + b * triangle.corners[1] + c * triangle.corners[2])) continue;
        Sample& sample = samples_[static_cast<size_t>(y) * static_cast<size_t>(across_) + static_cast<size_t>(x)];
        const double w = a * p[0].z + b * p[1].z + c * p[2].z;
        if (w > sample.w) sample = {w, triangle.colour, normal};
      }
  }

  const Sample& at(int x, int y) const {
    return samples_[static_cast<size_t>(y) * static_cast<size_t>(across_) + static_cast<size_t>(x)];
  }

 private:
  double sampleOf(double u) const { return (u + kViewHalfExtent) / (2 * kViewHalfExtent) * across_; }

  ViewFrame frame_;
  int across_;
  std::vector<Sample> samples_;
};

struct Texel {
  glm::dvec4 rgba{0};
  glm::dvec3 normal{0};  // a sum, then the mean
  double w = -INFINITY;
};

std::vector<Texel> averaged(const Image& image, int imageSize, int samplesPerEdge, double texel) {
  std::vector<Texel> texels(static_cast<size_t>(imageSize) * static_cast<size_t>(imageSize));
  for (int y = 0; y < imageSize; ++y)
    for (int x = 0; x < imageSize; ++x) {
      Texel& out = texels[static_cast<size_t>(y * imageSize + x)];
      double front = -INFINITY, sum = 0;
      int count = 0, covered = 0;
      for (int pass = 0; pass < 2; ++pass)
        for (int s = 0; s < samplesPerEdge * samplesPerEdge; ++s) {
          const Sample& sample =
              image.at(x * samplesPerEdge + s % samplesPerEdge, y * samplesPerEdge + s / samplesPerEdge);
          if (!std::isfinite(sample.w)) continue;
          if (pass == 0) {
            ++covered;
            front = std::max(front, sample.w);
            out.normal += sample.normal;
            out.rgba += glm::dvec4(sample.colour, 1.0) / static_cast<double>(samplesPerEdge * samplesPerEdge);
          } else if (sample.w >= front - 3 * texel) {
            sum += sample.w;
            ++count;
          }
        }
      if (count > 0) out.w = sum / count;
      if (covered > 0) out.normal /= covered;
    }
  return texels;
}

// Known depth grows by one texel into its empty neighbours.
std::vector<double> dilated(const std::vector<Texel>& texels, int size) {
  std::vector<double> result(texels.size());
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      double& w = result[static_cast<size_t>(y * size + x)];
      w = texels[static_cast<size_t>(y * size + x)].w;
      if (std::isfinite(w)) continue;
      for (int n = 0; n < 9; ++n) {
        const int nx = x + n % 3 - 1, ny = y + n / 3 - 1;
        if (nx >= 0 && ny >= 0 && nx < size && ny < size)
          w = std::max(w, texels[static_cast<size_t>(ny * size + nx)].w);
      }
    }
  return result;
}

}  // namespace

ViewImage bakeSynthetic(const std::vector<LocalTriangle>& triangles, glm::dvec3 direction,
                        const SyntheticView& wanted) {
  const auto [view, imageSize, samplesPerEdge, relightable] = wanted;
  Image image(viewFrame(direction), imageSize * samplesPerEdge);
  for (const LocalTriangle& triangle : triangles) image.draw(triangle);
  const std::vector<Texel> texels = averaged(image, imageSize, samplesPerEdge, texelSize(imageSize));
  const std::vector<double> depth = dilated(texels, imageSize);
  ViewImage result{.view = view, .rgba = {}, .depth = {}, .normal = {}};
  int x0 = imageSize, y0 = imageSize, x1 = -1, y1 = -1;
  double low = INFINITY, high = -INFINITY;
  for (int y = 0; y < imageSize; ++y)
    for (int x = 0; x < imageSize; ++x) {
      const double w = depth[static_cast<size_t>(y * imageSize + x)];
      if (!std::isfinite(w)) continue;
      x0 = std::min(x0, x), x1 = std::max(x1, x), y0 = std::min(y0, y), y1 = std::max(y1, y);
      low = std::min(low, w), high = std::max(high, w);
    }
  if (x1 < 0) return result;
  result.x0 = static_cast<uint32_t>(x0), result.y0 = static_cast<uint32_t>(y0);
  result.width = static_cast<uint32_t>(x1 - x0 + 1), result.height = static_cast<uint32_t>(y1 - y0 + 1);
  result.depthMin = static_cast<float>(low), result.depthMax = static_cast<float>(high);
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const size_t i = static_cast<size_t>(y * imageSize + x);
      for (int channel = 0; channel < 4; ++channel)
        result.rgba.push_back(static_cast<uint8_t>(std::lround(texels[i].rgba[channel] * 255)));
      const double value = high > low ? std::round((depth[i] - low) / (high - low) * 254) : 0;
      result.depth.push_back(std::isfinite(depth[i]) ? static_cast<uint8_t>(1 + value) : uint8_t{0});
      const std::array<uint8_t, 3> normal = normalBytes(texels[i].normal);
      if (relightable) result.normal.insert(result.normal.end(), normal.begin(), normal.end());
    }
  return result;
}

}  // namespace farcell
