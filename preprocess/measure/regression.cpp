#include "preprocess/measure/regression.h"

#include <algorithm>
#include <cmath>

#include "cache/base/check.h"

namespace farcell {
namespace {

constexpr double kRidge = 2;  // samples' worth of weight
constexpr int kRounds = 8;
constexpr double kHuber = 1.345;
constexpr double kDeviationOfMedian = 1.4826;  // of a normal distribution
constexpr double kLeastDeviation = 1e-6;

constexpr size_t kUnknowns = kFeatures + 1;
using Row = std::array<double, kUnknowns>;

// By elimination: the matrix is symmetric and positive, no pivot is needed.
Row solved(std::array<Row, kUnknowns> matrix, Row right) {
  for (size_t k = 0; k < kUnknowns; ++k) {
    for (size_t i = k + 1; i < kUnknowns; ++i) {
      const double factor = matrix[i][k] / matrix[k][k];
      for (size_t j = k; j < kUnknowns; ++j) matrix[i][j] -= factor * matrix[k][j];
      right[i] -= factor * right[k];
    }
  }
  for (size_t k = kUnknowns; k-- > 0;) {
    for (size_t j = k + 1; j < kUnknowns; ++j) right[k] -= matrix[k][j] * right[j];
    right[k] /= matrix[k][k];
  }
  return right;
}

double medianOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

Regression::Regression(std::span<const Features> features, std::span<const double> values) {
  FARCELL_CHECK(!values.empty() && features.size() == values.size());
  const auto count = static_cast<double>(values.size());
  for (size_t j = 0; j < kFeatures; ++j) {
    for (const Features& sample : features) mean_[j] += sample[j] / count;
    double squares = 0;
    for (const Features& sample : features) squares += (sample[j] - mean_[j]) * (sample[j] - mean_[j]) / count;
    scale_[j] = squares > 1e-12 ? 1 / std::sqrt(squares) : 0;
  }
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double beyond = 0.5 * (*high - *low);
  low_ = *low - beyond;
  high_ = *high + beyond;
  std::vector<double> weights(values.size(), 1), distances(values.size());
  for (int round = 0; round < kRounds; ++round) {
    solve(features, values, weights);
    for (size_t i = 0; i < values.size(); ++i) distances[i] = std::abs(values[i] - line(features[i]));
    const double deviation = std::max(kDeviationOfMedian * medianOf(distances), kLeastDeviation);
    for (size_t i = 0; i < values.size(); ++i)
      weights[i] = std::min(1.0, kHuber * deviation / std::max(distances[i], 1e-300));
  }
}

void Regression::solve(std::span<const Features> features, std::span<const double> values,
                       std::span<const double> weights) {
  std::array<Row, kUnknowns> matrix{};
  Row right{};
  for (size_t i = 0; i < values.size(); ++i) {
    Row row;
    for (size_t j = 0; j < kFeatures; ++j) row[j] = (features[i][j] - mean_[j]) * scale_[j];
    row[kFeatures] = 1;
    for (size_t j = 0; j < kUnknowns; ++j) {
      for (size_t k = 0; k < kUnknowns; ++k) matrix[j][k] += weights[i] * row[j] * row[k];
      right[j] += weights[i] * row[j] * values[i];
    }
  }
  for (size_t j = 0; j < kFeatures; ++j) matrix[j][j] += kRidge;
  const Row solution = solved(matrix, right);
  std::copy_n(solution.begin(), kFeatures, slopes_.begin());
  intercept_ = solution[kFeatures];
}

double Regression::line(const Features& features) const {
  double value = intercept_;
  for (size_t j = 0; j < kFeatures; ++j) value += slopes_[j] * (features[j] - mean_[j]) * scale_[j];
  return value;
}

double Regression::operator()(const Features& features) const { return std::clamp(line(features), low_, high_); }

std::vector<double> leaveOneOut(std::span<const Features> features, std::span<const double> values) {
  FARCELL_CHECK(values.size() >= 2);
  std::vector<double> predicted;
  for (size_t out = 0; out < values.size(); ++out) {
    std::vector<Features> others(features.begin(), features.end());
    std::vector<double> theirs(values.begin(), values.end());
    others.erase(others.begin() + static_cast<ptrdiff_t>(out));
    theirs.erase(theirs.begin() + static_cast<ptrdiff_t>(out));
    predicted.push_back(Regression(others, theirs)(features[out]));
  }
  return predicted;
}

}  // namespace farcell
