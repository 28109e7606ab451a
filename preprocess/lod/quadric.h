// How far a point is from planes, squared and weighted. Garland and Heckbert, Surface Simplification Using Quadric
// Error Metrics, 1997.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace farcell::lod {

struct Quadric {
  double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;
  double x = 0, y = 0, z = 0, constant = 0;
  double weight = 0;

  void add(const Quadric& other) {
    xx += other.xx, yy += other.yy, zz += other.zz, xy += other.xy, xz += other.xz, yz += other.yz;
    x += other.x, y += other.y, z += other.z, constant += other.constant;
    weight += other.weight;
  }
  // The weighted mean of squared distances from the planes.
  double meanSquare(glm::dvec3 p) const {
    const double rx = 2 * x + xx * p.x + 2 * xy * p.y, ry = 2 * y + yy * p.y + 2 * yz * p.z,
                 rz = 2 * z + zz * p.z + 2 * xz * p.x;
    const double sum = std::abs(constant + rx * p.x + ry * p.y + rz * p.z);
    return weight > 0 ? sum / weight : 0;
  }
};

// normal: unit
inline Quadric planeQuadric(glm::dvec3 normal, glm::dvec3 point, double weight) {
  const double d = -glm::dot(normal, point);
  const glm::dvec3 n = normal * weight;
  return {n.x * normal.x, n.y * normal.y, n.z * normal.z, n.x * normal.y, n.x * normal.z, n.y * normal.z,
          n.x * d,        n.y * d,        n.z * d,        d * d * weight, weight};
}

}  // namespace farcell::lod
