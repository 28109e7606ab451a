// bench_near_pattern [grid]: moves of the usual rotated grid of four samples, one a pass, that place the samples of the
// first passes as well as can be found: each next move is the one, of all on a grid, that leaves the least mean square
// error of the coverage of half planes. Samples that leave the pixel come in again on its other side.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <random>
#include <vector>

namespace {

struct Point {
  double x, y;
};
constexpr std::array<Point, 4> kSamples = {{{.375, .125}, {.875, .375}, {.125, .625}, {.625, .875}}};
constexpr std::array<Point, 4> kSmallMoves = {
    {{-1.5 / 16, 0.5 / 16}, {-0.5 / 16, -1.5 / 16}, {0.5 / 16, 1.5 / 16}, {1.5 / 16, -0.5 / 16}}};
constexpr size_t kHalfPlanes = 20000, kPasses = 16;

// Where a x + b y < d.
struct HalfPlane {
  double a, b, d;
  bool holds(Point p) const { return a * p.x + b * p.y < d; }
};

double squared(double v) { return v > 0 ? v * v : 0; }

// Of the unit square.
double coverage(HalfPlane half) {
  const double a = std::abs(half.a), b = std::abs(half.b);
  const double d = half.d - std::min(half.a, 0.0) - std::min(half.b, 0.0);
  if (a < 1e-6 || b < 1e-6) return std::clamp(d / std::max(a, b), 0.0, 1.0);
  return (squared(d) - squared(d - a) - squared(d - b) + squared(d - a - b)) / (2 * a * b);
}

std::vector<HalfPlane> halfPlanes() {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit;
  std::vector<HalfPlane> result(kHalfPlanes);
  for (HalfPlane& half : result) {
    const double angle = 2 * std::numbers::pi * unit(random);
    half = {std::cos(angle), std::sin(angle), 0};
    const double low = std::min(half.a, 0.0) + std::min(half.b, 0.0);
    half.d = low + unit(random) * (std::abs(half.a) + std::abs(half.b));
  }
  return result;
}

double wrapped(double v) { return v - std::floor(v); }

std::vector<float> countsOf(const std::vector<HalfPlane>& halves, Point move, bool wrap) {
  std::vector<float> counts;
  for (const HalfPlane& half : halves) {
    float count = 0;
    for (const Point& sample : kSamples) {
      const Point p{sample.x + move.x, sample.y + move.y};
      count += half.holds(wrap ? Point{wrapped(p.x), wrapped(p.y)} : p) ? 1.0f : 0.0f;
    }
    counts.push_back(count);
  }
  return counts;
}

double meanSquare(const std::vector<float>& sums, const std::vector<float>& more, const std::vector<float>& truth,
                  size_t samples) {
  double sum = 0;
  const float share = 1.0f / static_cast<float>(samples);
  for (size_t i = 0; i < sums.size(); ++i) {
    const float error = (sums[i] + more[i]) * share - truth[i];
    sum += error * error;
  }
  return sum / static_cast<double>(sums.size());
}

void addTo(std::vector<float>& sums, const std::vector<float>& more) {
  for (size_t i = 0; i < sums.size(); ++i) sums[i] += more[i];
}

bool onBorder(Point move) {
  return std::any_of(kSamples.begin(), kSamples.end(), [&](const Point& sample) {
    return wrapped(sample.x + move.x) == 0 || wrapped(sample.y + move.y) == 0;
  });
}

}  // namespace

int main(int argc, char** argv) {
  const int grid = argc > 1 ? std::max(8, std::atoi(argv[1])) : 64;
  const std::vector<HalfPlane> halves = halfPlanes();
  std::vector<float> truth;
  for (const HalfPlane& half : halves) truth.push_back(static_cast<float>(coverage(half)));
  std::vector<float> sums(halves.size()), small(halves.size());
  const std::vector<float> none(halves.size());
  for (const Point& move : kSmallMoves) addTo(small, countsOf(halves, move, false));
  std::printf("4 small moves: rms error %.4f\n", std::sqrt(meanSquare(small, none, truth, 16)));
  for (size_t pass = 0; pass < kPasses; ++pass) {
    Point best{0, 0};
    double least = 1e9;
    for (int y = 0; y < grid && (pass > 0 || y == 0); ++y)
      for (int x = 0; x < grid && (pass > 0 || x == 0); ++x) {
        const Point move{static_cast<double>(x) / grid, static_cast<double>(y) / grid};
        if (onBorder(move)) continue;
        const double error = meanSquare(sums, countsOf(halves, move, true), truth, 4 * (pass + 1));
        if (error < least) {
          least = error;
          best = move;
        }
      }
    addTo(sums, countsOf(halves, best, true));
    std::printf("{%g / %d, %g / %d}  %zu samples: rms error %.4f\n", best.x * grid, grid, best.y * grid, grid,
                4 * (pass + 1), std::sqrt(least));
  }
}
