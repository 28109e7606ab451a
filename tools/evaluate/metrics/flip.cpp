// Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem, Fairchild, FLIP: A Difference Evaluator for Alternating
// Images, 2020. Constants here and in the stages carry the paper's names.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "cache/base/check.h"
#include "tools/evaluate/metrics/flip_stages.h"
#include "tools/evaluate/metrics/metrics.h"

namespace farcell {
namespace {

// To the power of q_f = 1/2, which makes much of little: the reason why filters are in double.
float featureError(const Features& a, const Features& b, size_t pixel) {
  const double difference =
      std::max(std::abs(a.edges[pixel] - b.edges[pixel]), std::abs(a.points[pixel] - b.points[pixel]));
  return static_cast<float>(std::sqrt(std::min(difference / std::numbers::sqrt2, 1.0)));
}

}  // namespace

std::vector<float> flipErrors(std::span<const float> a, std::span<const float> b, int width, int height) {
  const size_t pixels = static_cast<size_t>(width) * static_cast<size_t>(height);
  FARCELL_CHECK_EQ(a.size(), 3 * pixels);
  FARCELL_CHECK_EQ(b.size(), 3 * pixels);
  if (pixels == 0) return {};
  const OpponentImage imageA = opponentFromDisplay(a, width, height), imageB = opponentFromDisplay(b, width, height);
  const Features featuresA = detectFeatures(imageA.y), featuresB = detectFeatures(imageB.y);
  const std::vector<glm::vec3> coloursA = perceived(imageA), coloursB = perceived(imageB);
  std::vector<float> errors(pixels);
  for (size_t i = 0; i < pixels; ++i)
    errors[i] = std::pow(colourError(coloursA[i], coloursB[i]), 1 - featureError(featuresA, featuresB, i));
  return errors;
}

}  // namespace farcell
