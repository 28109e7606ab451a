// What is measured of a few and known by its features of all: a line fitted to the few, robustly.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace farcell {

inline constexpr size_t kFeatures = 8;
using Features = std::array<double, kFeatures>;

// Least squares on features brought to mean 0 and deviation 1, with a little weight on small coefficients (so that few
// samples, or features that say the same, do no harm) and less for samples far from the line (Huber, Robust Estimation
// of a Location Parameter, 1964: beyond 1.345 deviations). Never beyond what was seen by more than half of its range.
class Regression {
 public:
  // REQUIRES: as many features as values, at least one.
  Regression(std::span<const Features> features, std::span<const double> values);

  double operator()(const Features& features) const;

 private:
  void solve(std::span<const Features> features, std::span<const double> values, std::span<const double> weights);
  double line(const Features& features) const;

  Features mean_{}, scale_{}, slopes_{};
  double intercept_ = 0;
  double low_ = 0, high_ = 0;
};

// Of each, what a regression of all others says. REQUIRES: at least two.
std::vector<double> leaveOneOut(std::span<const Features> features, std::span<const double> values);

}  // namespace farcell
