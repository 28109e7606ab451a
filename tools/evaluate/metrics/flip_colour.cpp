#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "tools/evaluate/metrics/flip_stages.h"
#include "tools/evaluate/metrics/metrics.h"

namespace farcell {
namespace {

constexpr float kQc = 0.7f, kPc = 0.4f, kPt = 0.95f;

// A Gaussian of a contrast sensitivity function: a * exp(-b * f^2) over frequencies f, cycles per degree.
struct Sensitivity {
  double a, b;
};
constexpr Sensitivity kAchromatic = {1, 0.0047}, kRedGreen = {1, 0.0053};
constexpr Sensitivity kBlueYellow[] = {{34.1, 0.04}, {13.5, 0.025}};
constexpr double kWidest = 0.04;  // b: every filter reaches as far as this one

// X, Y, Z relative to the white point from linear R, G, B of sRGB.
glm::dmat3 whiteFromRgb() {
  const glm::dmat3 rows(glm::dvec3(10135552, 8788810, 4435075) / 24577794.0,
                        glm::dvec3(2613072, 8788810, 887015) / 12288897.0,
                        glm::dvec3(1425312, 8788810, 70074185) / 73733382.0);
  const glm::dvec3 white = glm::dvec3(1) * rows;
  return glm::transpose(glm::dmat3(rows[0] / white.x, rows[1] / white.y, rows[2] / white.z));
}
const glm::mat3 kWhiteFromRgb(whiteFromRgb());
const glm::mat3 kRgbFromWhite(glm::inverse(whiteFromRgb()));

float linearFromDisplay(float value) {
  const float s = std::clamp(value / 255, 0.0f, 1.0f);
  return s > 0.04045f ? std::pow((s + 0.055f) / 1.055f, 2.4f) : s / 12.92f;
}

double sigmaPixels(double b) { return kFlipPixelsPerDegree * std::sqrt(b / 2) / std::numbers::pi; }

Kernel kernelOf(const Sensitivity& sensitivity) {
  return gaussian(sigmaPixels(sensitivity.b), static_cast<int>(std::ceil(3 * sigmaPixels(kWidest))));
}

Plane filtered(const Plane& plane, const Sensitivity& sensitivity) {
  const Kernel kernel = normalised(kernelOf(sensitivity));
  return alongColumns(alongRows(plane, kernel), kernel);
}

// What filtered() divides by: the Gaussian's weight in a sum of two.
double weightOf(const Sensitivity& sensitivity) {
  double sum = 0;
  for (const double weight : kernelOf(sensitivity)) sum += weight;
  return sensitivity.a * std::sqrt(std::numbers::pi / sensitivity.b) * sum * sum;
}

Plane filteredBlueYellow(const Plane& plane) {
  const double weights[] = {weightOf(kBlueYellow[0]), weightOf(kBlueYellow[1])};
  const double share = weights[0] / (weights[0] + weights[1]);
  Plane result = filtered(plane, kBlueYellow[0]);
  const Plane second = filtered(plane, kBlueYellow[1]);
  for (size_t i = 0; i < result.values.size(); ++i)
    result.values[i] = share * result.values[i] + (1 - share) * second.values[i];
  return result;
}

float labCurve(float t) {
  constexpr float kDelta = 6.0f / 29;
  return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0f / 29;
}

// Hunt: colours are less colourful where they are dark.
glm::vec3 huntLab(const glm::vec3& rgb) {
  const glm::vec3 white = kWhiteFromRgb * rgb;
  const float x = labCurve(white.x), y = labCurve(white.y), z = labCurve(white.z), lightness = 116 * y - 16;
  return {lightness, 0.01f * lightness * 500 * (x - y), 0.01f * lightness * 200 * (y - z)};
}

// HyAB (Abasi, Amani Tehran, Fairchild, Distance metrics for very large color differences, 2019) to the power of q_c.
float distance(const glm::vec3& a, const glm::vec3& b) {
  const float da = a.y - b.y, db = a.z - b.z;
  return std::pow(std::abs(a.x - b.x) + std::sqrt(da * da + db * db), kQc);
}

}  // namespace

OpponentImage opponentFromDisplay(std::span<const float> rgb, int width, int height) {
  const Plane empty{width, height, std::vector<double>(rgb.size() / 3)};
  OpponentImage image{empty, empty, empty};
  for (size_t i = 0; i < empty.values.size(); ++i) {
    const glm::vec3 white = kWhiteFromRgb * glm::vec3(linearFromDisplay(rgb[3 * i]), linearFromDisplay(rgb[3 * i + 1]),
                                                      linearFromDisplay(rgb[3 * i + 2]));
    image.y.values[i] = white.y;
    image.cx.values[i] = white.x - white.y;
    image.cz.values[i] = white.y - white.z;
  }
  return image;
}

std::vector<glm::vec3> perceived(const OpponentImage& image) {
  const Plane y = filtered(image.y, kAchromatic), cx = filtered(image.cx, kRedGreen);
  const Plane cz = filteredBlueYellow(image.cz);
  std::vector<glm::vec3> colours(y.values.size());
  for (size_t i = 0; i < colours.size(); ++i) {
    const glm::dvec3 white(y.values[i] + cx.values[i], y.values[i], y.values[i] - cz.values[i]);
    colours[i] = huntLab(glm::clamp(kRgbFromWhite * glm::vec3(white), 0.0f, 1.0f));
  }
  return colours;
}

// No two colours of sRGB are further apart than green and blue. Small distances get most of [0, 1].
float colourError(const glm::vec3& a, const glm::vec3& b) {
  static const float kMost = distance(huntLab({0, 1, 0}), huntLab({0, 0, 1}));
  const float d = distance(a, b), knee = kPc * kMost;
  return std::min(d < knee ? kPt / knee * d : kPt + (d - knee) / (kMost - knee) * (1 - kPt), 1.0f);
}

}  // namespace farcell
