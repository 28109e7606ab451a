#include "datasets/city/terrain.h"

#include <cmath>

#include "datasets/random/random.h"

namespace farcell::city {
namespace {
double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }
}  // namespace

double smoothNoise(uint64_t key, double x, double y, double scaleM) {
  const double cellX = std::floor(x / scaleM);
  const double cellY = std::floor(y / scaleM);
  const auto i = static_cast<int64_t>(cellX);
  const auto j = static_cast<int64_t>(cellY);
  const double u = fade(x / scaleM - cellX);
  const double v = fade(y / scaleM - cellY);
  const auto corner = [&](int64_t a, int64_t b) { return unitOf(keyOf(key, i + a, j + b)); };
  const double low = corner(0, 0) + (corner(1, 0) - corner(0, 0)) * u;
  const double high = corner(0, 1) + (corner(1, 1) - corner(0, 1)) * u;
  return low + (high - low) * v;
}

double groundHeight(uint64_t seed, double x, double y) {
  constexpr int64_t kHills = 1;
  constexpr int64_t kSwells = 2;
  return 18 * smoothNoise(keyOf(seed, kHills), x, y, 900) + 2.5 * smoothNoise(keyOf(seed, kSwells), x, y, 260);
}

}  // namespace farcell::city
