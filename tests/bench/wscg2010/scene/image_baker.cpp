#include "tests/bench/wscg2010/scene/image_baker.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "preprocess/bake/settle.h"
#include "tests/bench/wscg2010/scene/polygon.h"

namespace farcell::wscg {
namespace {

constexpr double kRadius = kViewHalfExtent;  // of the enclosed sphere, in the content's coordinates

// The frame of points that are already along the image's axes.
const ViewFrame kImageAxes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

uint8_t unorm8(float value) { return static_cast<uint8_t>(std::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f); }

// Along the image's axes: x right, y up, z towards the viewer.
Triangle alongAxes(const Triangle& triangle, const ViewFrame& frame) {
  Triangle result = triangle;
  for (glm::vec3& corner : result.corners) {
    const glm::dvec3 p(corner);
    corner = glm::vec3(glm::dot(p, frame.right), glm::dot(p, frame.up), glm::dot(p, frame.toward));
  }
  return result;
}

void append(CellSoup& soup, const std::array<glm::vec3, 3>& corners, const Triangle& triangle) {
  const uint32_t normal = bake::packedOctahedral(triangle.normal);
  for (size_t k = 0; k < 3; ++k) {
    soup.x[k].push_back(corners[k].x);
    soup.y[k].push_back(corners[k].y);
    soup.z[k].push_back(corners[k].z);
    soup.colours[k].push_back(triangle.colours[k]);
    soup.normals[k].push_back(normal);
  }
}

double eyeDistance(double fovRad) { return kRadius / std::sin(fovRad / 2); }

// The view volume: what the image shows, between the planes that touch the sphere before and behind it.
std::array<Plane, 6> volumePlanes(double fovRad) {
  auto planes = cubePlanes(kRadius);
  if (fovRad == 0) return planes;
  const double slope = std::tan(fovRad / 2);
  for (size_t side = 0; side < 4; ++side) {  // slope * (eye - z) +- x >= 0
    planes[side].normal.z = -slope;
    planes[side].offset = slope * eyeDistance(fovRad);
  }
  return planes;
}

// Onto the plane through the centre, scaled to the baker's image; z rises towards the viewer.
struct Perspective {
  double eye, scale;

  explicit Perspective(double fovRad)
      : eye(eyeDistance(fovRad)), scale(kViewHalfExtent / (kRadius * imageHalfWidth(fovRad))) {}
  glm::vec3 operator()(glm::vec3 p) const {
    const double nearness = eye / (eye - static_cast<double>(p.z));
    return glm::vec3(glm::dvec3(p.x * nearness * scale, p.y * nearness * scale, nearness));
  }
};

CellImage imageOf(const BakedView& view) {
  CellImage image{view.x0, view.y0, view.width, view.height, {}};
  image.rgba.resize(view.rgba.size());
  std::transform(view.rgba.begin(), view.rgba.end(), image.rgba.begin(), unorm8);
  return image;
}

}  // namespace

double imageHalfWidth(double fovRad) { return fovRad == 0 ? 1 : 1 / std::cos(fovRad / 2); }

ImageBaker::ImageBaker(const ImageSettings& settings, glm::vec3 sun)
    : settings_(settings), baker_(BakeSettings{settings.size, settings.samples, sun, false}) {}

void ImageBaker::addOrthographic(const CellContent& content, const ViewFrame& frame) {
  baker_.begin(frame);
  baker_.add(content.soup);
  soup_.clear();
  const auto planes = volumePlanes(0);
  std::vector<Triangle> parts;
  for (size_t i = content.insideCount; i < content.triangles.size(); ++i) {
    parts.clear();
    appendClipped(alongAxes(content.triangles[i], frame), planes, parts);
    for (Triangle& part : parts) {
      for (glm::vec3& corner : part.corners) {
        const glm::dvec3 p(corner);
        corner = glm::vec3(frame.right * p.x + frame.up * p.y + frame.toward * p.z);
      }
      append(soup_, part.corners, part);
    }
  }
  if (soup_.size() > 0) baker_.add(soup_);
}

void ImageBaker::addPerspective(const CellContent& content, const ViewFrame& frame) {
  const Perspective perspective(settings_.fovRad);
  const auto planes = volumePlanes(settings_.fovRad);
  baker_.begin(kImageAxes);
  soup_.clear();
  std::vector<Triangle> parts;
  for (size_t i = 0; i < content.triangles.size(); ++i) {
    const Triangle along = alongAxes(content.triangles[i], frame);
    parts.clear();
    if (i < content.insideCount) {
      parts.push_back(along);
    } else {
      appendClipped(along, planes, parts);
    }
    for (const Triangle& part : parts) {
      std::array<glm::vec3, 3> mapped{};
      for (size_t k = 0; k < 3; ++k) mapped[k] = perspective(part.corners[k]);
      append(soup_, mapped, part);
    }
  }
  baker_.add(soup_);
}

CellImage ImageBaker::bake(const CellContent& content, glm::dvec3 direction) {
  const ViewFrame frame = viewFrame(direction);
  settings_.fovRad == 0 ? addOrthographic(content, frame) : addPerspective(content, frame);
  BakedView view, antipode;
  baker_.finish(view, antipode);
  return imageOf(view);
}

}  // namespace farcell::wscg
