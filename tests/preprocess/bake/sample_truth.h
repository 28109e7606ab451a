// What a sample may hold, decided in double from every triangle of the soup.
#pragma once

#include <algorithm>
#include <cmath>

#include "tests/preprocess/bake/bake_scenes.h"

namespace farcell::test {

// A sample nearer than this to a triangle's edge may count as inside or outside (half sides of the cell): float
// positions of the image have a step of about half of it.
inline constexpr double kEdgeTolerance = 1e-6;
inline constexpr double kDepthTolerance = 1e-5;

struct SampleTruth {
  bool mustHit = false;   // some triangle holds the sample with a margin
  bool mayHit = false;    // some triangle comes near it
  double leastW = -1e30;  // nothing farther may win
  bool wExplained = false;
};

// One triangle in the view's coordinates.
struct ProjectedTriangle {
  glm::dvec3 p[3];  // u, v, w

  ProjectedTriangle(const CellSoup& soup, size_t triangle, const ViewFrame& frame) {
    for (size_t k = 0; k < 3; ++k) {
      const glm::dvec3 local(corner(soup, k, triangle));
      p[k] = glm::dvec3(glm::dot(local, frame.right), glm::dot(local, frame.up), glm::dot(local, frame.toward));
    }
  }

  // Distance of (u, v) to the nearest edge's line: positive inside; very negative without area.
  double inside(double u, double v) const {
    const double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
    double least = 1e30;
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 a = p[k], edge = p[(k + 1) % 3] - a;
      const double length = std::hypot(edge.x, edge.y);
      const double away = (edge.x * (v - a.y) - edge.y * (u - a.x)) / (length > 0 ? length : 1);
      least = std::min(least, area >= 0 ? away : -away);
    }
    return least;
  }

  double wMin() const { return std::min({p[0].z, p[1].z, p[2].z}); }
  double wMax() const { return std::max({p[0].z, p[1].z, p[2].z}); }

  struct Depth {
    double w, tolerance;
  };
  // On the plane, within the triangle's own range; and how far it moves within the edge tolerance.
  Depth depth(double u, double v) const {
    const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
    const double range = wMax() - wMin();
    if (normal.z == 0) return {(wMin() + wMax()) / 2, range + kDepthTolerance};
    const double w = p[0].z - (normal.x * (u - p[0].x) + normal.y * (v - p[0].y)) / normal.z;
    const double slope = std::hypot(normal.x, normal.y) / std::abs(normal.z);
    return {std::clamp(w, wMin(), wMax()), std::min(range, 2 * slope * kEdgeTolerance) + kDepthTolerance};
  }
};

// Whether a baked depth (kNothing: nothing hit) at (u, v) is one that exact arithmetic allows.
inline bool truthAllows(const CellSoup& soup, const ViewFrame& frame, double u, double v, double baked) {
  SampleTruth truth;
  for (size_t i = 0; i < soup.size(); ++i) {
    const ProjectedTriangle triangle(soup, i, frame);
    const double inside = triangle.inside(u, v);
    if (inside < -kEdgeTolerance) continue;
    truth.mayHit = true;
    const auto [w, tolerance] = triangle.depth(u, v);
    truth.wExplained |= std::abs(baked - w) <= tolerance;
    if (inside <= kEdgeTolerance) continue;
    truth.mustHit = true;
    truth.leastW = std::max(truth.leastW, w - tolerance);
  }
  if (baked == double{kNothing}) return !truth.mustHit;
  return truth.mayHit && truth.wExplained && baked >= truth.leastW;
}

// Centre of a texel along u or v.
inline double texelCentre(int index, int imageSize) { return (index + 0.5) * texelSize(imageSize) - kViewHalfExtent; }

}  // namespace farcell::test
