#include "datasets/statue/moai.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "datasets/random/random.h"

namespace farcell {
namespace {

using glm::dvec3;

// Stones, display values.
constexpr dvec3 kTuff{176, 162, 138}, kScoria{158, 84, 62}, kCoral{238, 234, 220}, kObsidian{38, 32, 34},
    kBasalt{112, 108, 106};
constexpr double kPassageM = 0.035;

// Distances of simple bodies and their smooth joins (Quilez, Modeling with Distance Functions, 2008).
double ellipsoid(dvec3 p, dvec3 centre, dvec3 radii) {
  p -= centre;
  const double outer = glm::length(p / radii);
  const double inner = glm::length(p / (radii * radii));
  return inner > 0 ? outer * (outer - 1) / inner : -std::min({radii.x, radii.y, radii.z});
}

double roundedBox(dvec3 p, dvec3 centre, dvec3 half, double radius) {
  const dvec3 q = glm::abs(p - centre) - (half - radius);
  return glm::length(glm::max(q, dvec3(0))) + std::min(std::max({q.x, q.y, q.z}), 0.0) - radius;
}

double capsule(dvec3 p, dvec3 a, dvec3 b, double radiusA, double radiusB) {
  const double t = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
  return glm::length(p - glm::mix(a, b, t)) - std::lerp(radiusA, radiusB, t);
}

double drum(dvec3 p, double low, double high, double radius, double rounding) {
  const double across = std::sqrt(p.x * p.x + p.y * p.y) - (radius - rounding);
  const double along = std::abs(p.z - (low + high) / 2) - ((high - low) / 2 - rounding);
  return glm::length(glm::dvec2(std::max(across, 0.0), std::max(along, 0.0))) + std::min(std::max(across, along), 0.0) -
         rounding;
}

double joined(double a, double b, double softness) {
  const double h = std::max(softness - std::abs(a - b), 0.0) / softness;
  return std::min(a, b) - h * h * softness / 4;
}

double carved(double body, double tool, double softness) { return -joined(-body, tool, softness); }

// Wider below than above: the distance of a box after its sides lean in.
double leaningBox(dvec3 p, dvec3 centre, dvec3 half, double radius, double lean) {
  const double widen = 1 - lean * (p.z - centre.z) / half.z;
  return roundedBox({centre.x + (p.x - centre.x) / widen, p.y, p.z}, centre, half, radius) * std::min(widen, 1.0);
}

double platform(dvec3 p) {
  const double upper = roundedBox(p, {0, 0, -0.14}, {1.45, 0.98, 0.17}, 0.05);
  const double lower = roundedBox(p, {0, -0.05, -0.42}, {1.8, 1.32, 0.18}, 0.06);
  return joined(upper, lower, 0.06);
}

double hands(dvec3 p) {
  double result = 1e9;
  for (int finger = 0; finger < 4; ++finger) {
    const double z = 0.22 + 0.085 * finger;
    result = std::min(result, capsule(p, {0.62, -0.60, z + 0.05}, {0.07, -0.72, z - 0.03}, 0.048, 0.03));
  }
  return result;
}

// A rope around a body at one height, of which `d` is the distance.
double rope(double d, double height, double radius) { return std::sqrt(d * d + height * height) - radius; }

// x is the distance from the plane of symmetry in all that follows.
double torso(dvec3 p, double bellyM) {
  double d = leaningBox(p, {0, 0, 0.80}, {0.86, 0.52, 0.86}, 0.34, 0.10);
  d = joined(d, ellipsoid(p, {0, -0.28, 0.62}, {0.66, bellyM, 0.62}), 0.22);
  d = joined(d, capsule(p, {-0.62, 0.04, 1.50}, {0.62, 0.04, 1.50}, 0.36, 0.36), 0.22);
  d = joined(d, ellipsoid(p, {0.40, -0.44, 1.28}, {0.34, 0.16, 0.24}), 0.14);
  d = joined(d, capsule(p, {0.92, 0.04, 1.46}, {1.00, -0.04, 0.52}, 0.21, 0.17), 0.07);
  d = joined(d, capsule(p, {1.00, -0.06, 0.50}, {0.60, -0.58, 0.34}, 0.17, 0.13), 0.07);
  d = joined(d, hands(p), 0.035);
  d = carved(d, ellipsoid(p, {0, -0.78, 0.72}, {0.06, 0.10, 0.06}), 0.05);
  return joined(d, rope(d, p.z - 0.10, 0.05), 0.03);  // a loin cloth's
}

struct FaceProportions {
  double jawM, noseM, browM, earM;
};

double skull(dvec3 p, const FaceProportions& face) {
  double d = roundedBox(p, {0, 0.02, 1.95}, {0.46, 0.42, 0.45}, 0.28);                    // neck
  d = joined(d, leaningBox(p, {0, -0.04, 2.98}, {0.62, 0.56, 1.06}, 0.26, -0.02), 0.20);  // head
  d = joined(d, ellipsoid(p, {0, -0.60, 2.06}, {face.jawM, 0.26, 0.24}), 0.16);           // chin
  d = joined(d, ellipsoid(p, {0.40, -0.46, 2.42}, {0.22, 0.20, 0.42}), 0.16);             // cheek
  return joined(d, capsule(p, {0, -0.60, 3.44}, {0.52, -0.50, 3.38}, face.browM, face.browM * 0.8), 0.10);
}

double mouth(dvec3 p, double d) {
  p.z += 0.35 * p.x * p.x;  // drooping corners
  d = joined(d, ellipsoid(p, {0, -0.64, 2.36}, {0.34, 0.16, 0.20}), 0.10);
  d = carved(d, capsule(p, {-0.27, -0.83, 2.355}, {0.27, -0.83, 2.355}, 0.040, 0.040), 0.02);
  d = joined(d, capsule(p, {-0.24, -0.76, 2.435}, {0.24, -0.76, 2.435}, 0.058, 0.058), 0.03);
  return joined(d, capsule(p, {-0.22, -0.76, 2.270}, {0.22, -0.76, 2.270}, 0.056, 0.056), 0.03);
}

double nose(dvec3 p, const FaceProportions& face) {
  // The bridge is hollow in profile.
  const double along = std::clamp((p.z - 2.66) / 0.74, 0.0, 1.0);
  const double hollow = 0.28 * along * (1 - along);
  const dvec3 q = p + dvec3(0, -hollow, 0);
  double d = capsule(q, {0, -0.62, 3.42}, {0, -0.86, 2.76}, 0.105, face.noseM);
  d = joined(d, ellipsoid(p, {0.16, -0.74, 2.72}, {0.115, 0.16, 0.10}), 0.06);
  return carved(d, ellipsoid(p, {0.12, -0.84, 2.63}, {0.055, 0.06, 0.05}), 0.03);
}

double eye(dvec3 p) { return ellipsoid(p, {0.30, -0.54, 3.17}, {0.165, 0.10, 0.085}); }

dvec3 eyeColour(dvec3 p) {
  const double fromPupilM = glm::length(p - dvec3(0.30, -0.64, 3.17)) - 0.052;
  return glm::mix(kObsidian, kCoral, glm::smoothstep(-0.012, 0.012, fromPupilM));
}

double head(dvec3 p, const FaceProportions& face) {
  double d = skull(p, face);
  d = carved(d, ellipsoid(p, {0.31, -0.72, 3.17}, {0.24, 0.20, 0.145}), 0.08);  // eye socket
  d = joined(d, nose(p, face), 0.06);
  d = mouth(p, d);
  const double ear = leaningBox(p, {0.655, 0.02, 2.86}, {0.085, 0.17, face.earM}, 0.08, 0.12);
  d = joined(d, ear, 0.04);
  return carved(d, roundedBox(p, {0.76, 0.0, 2.90}, {0.035, 0.09, face.earM * 0.72}, 0.03), 0.03);
}

double topknot(dvec3 p, double radiusM) {
  const dvec3 q = p - dvec3(0, -0.06, 0);
  const double body = drum(q, 3.98, 4.56, radiusM, 0.10);
  return joined(body, drum(q, 4.40, 4.86, radiusM * 0.52, 0.12), 0.08);
}

dvec3 mirrored(dvec3 p) { return {std::abs(p.x), p.y, p.z}; }

}  // namespace

Moai::Moai(uint64_t seed) {
  Random random(keyOf(seed, 2));
  jawM_ = random.range(0.50, 0.60);
  noseM_ = random.range(0.15, 0.19);
  browM_ = random.range(0.13, 0.17);
  earM_ = random.range(0.46, 0.60);
  bellyM_ = random.range(0.40, 0.50);
  topknotM_ = random.range(0.58, 0.70);
}

double Moai::distance(dvec3 point) const {
  const dvec3 p = mirrored(point);
  const double body = joined(torso(p, bellyM_), head(p, {jawM_, noseM_, browM_, earM_}), 0.16);
  double d = joined(body, eye(p), 0.03);
  d = joined(d, topknot(p, topknotM_), 0.05);
  return joined(d, platform(p), 0.04);
}

std::array<uint8_t, 3> Moai::colour(dvec3 point) const {
  const dvec3 p = mirrored(point);
  const double body = joined(torso(p, bellyM_), head(p, {jawM_, noseM_, browM_, earM_}), 0.16);
  const double hat = topknot(p, topknotM_), base = platform(p), ball = eye(p);
  // One stone passes into the next over a few centimetres: what is coarser than a vertex would be jagged.
  const std::array<double, 4> distances = {body, hat, base, ball};
  const std::array<dvec3, 4> stones = {kTuff, kScoria, kBasalt, eyeColour(p)};
  const double least = *std::min_element(distances.begin(), distances.end());
  dvec3 sum(0);
  double weights = 0;
  for (size_t i = 0; i < distances.size(); ++i) {
    const double share = std::max(0.0, 1 - (distances[i] - least) / kPassageM);
    const double weight = share * share;
    sum += weight * stones[i];
    weights += weight;
  }
  sum = sum / weights + 0.5;
  return {static_cast<uint8_t>(sum.x), static_cast<uint8_t>(sum.y), static_cast<uint8_t>(sum.z)};
}

}  // namespace farcell
