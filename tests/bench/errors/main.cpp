// How well a pack's expected image errors tell what measuring gives: of one model two packs, built with --measure sample
// and with --measure all.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cache/pack/pack_file.h"

using namespace farcell;

namespace {

constexpr std::array<const char*, kErrorWays> kWays = {"mesh", "A", "B"};

double quantile(std::vector<double>& values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<size_t>(share * static_cast<double>(values.size() - 1))];
}

// Cells whose errors differ were not in the sample (a code is 4 % wide, so that some of them agree by chance).
void compare(const Directory& expected, const Directory& measured, size_t way, size_t scale) {
  std::vector<double> off, spread;
  double mean = 0;
  for (size_t cell = 0; cell < expected.cells.size(); ++cell) {
    const uint8_t known = measured.cells[cell].errors.codes[way][scale];
    const uint8_t told = expected.cells[cell].errors.codes[way][scale];
    if (known == 0 || told == 0) continue;
    mean += std::log2(errorFromCode(known));
    spread.push_back(std::log2(errorFromCode(known)));
    if (expected.cells[cell].errors == measured.cells[cell].errors) continue;
    off.push_back(std::abs(errorFromCode(told) / errorFromCode(known) - 1));
  }
  if (off.empty()) return;
  mean = std::exp2(mean / static_cast<double>(spread.size()));
  const double low = std::exp2(quantile(spread, 0.1)), high = std::exp2(quantile(spread, 0.9));
  fmt::print("| {} | {} | {} | {:.3f} | {:.3f} to {:.3f} | {:.0f} % | {:.0f} % |\n", kWays[way],
             kErrorTexelPixels[scale], off.size(), mean, low, high, 100 * quantile(off, 0.5), 100 * quantile(off, 0.9));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "usage: bench_errors <pack of a sample> <pack of all>\n");
    return 2;
  }
  const Result<PackFile> sample = PackFile::open(argv[1]), all = PackFile::open(argv[2]);
  if (!sample || !all) {
    fmt::print(stderr, "{}\n", (sample ? all : sample).error().message);
    return 1;
  }
  fmt::print("| way | texel, px | cells | mean error | 10 to 90 % | median off | 90 % off |\n|---|---|---|---|---|---|---|\n");
  for (size_t way = 0; way < kErrorWays; ++way)
    for (size_t scale = 0; scale < kErrorScales; ++scale) compare(sample->directory(), all->directory(), way, scale);
  return 0;
}
