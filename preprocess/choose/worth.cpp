#include "preprocess/choose/worth.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace farcell {
namespace {

constexpr int kSamplesPerOctave = 2;
constexpr int kOctavesBeyondRoot = 2;

// Octaves of how fine its texels are: views of a cell are first drawn as far as the finest are by fewer octaves.
int finenessOf(const CellRecord& cell) {
  return static_cast<int>(cell.key.level) + std::bit_width(static_cast<unsigned>(cell.form.imageSize));
}

}  // namespace

Worth::Worth(std::span<const CellRecord> cells, std::span<const float> meanTexels)
    : cells_(cells), meanTexels_(meanTexels), kept_(cells.size()) {
  for (const CellRecord& cell : cells) finest_ = std::max(finest_, finenessOf(cell));
  if (!cells.empty()) samples_ = kSamplesPerOctave * (finest_ - finenessOf(cells[0]) + kOctavesBeyondRoot);
  costs_.resize(cells.size() * static_cast<size_t>(samples_));
  for (auto cell = static_cast<uint32_t>(cells.size()); cell-- > 0;)
    for (int sample = 0; sample < samples_; ++sample) cost(cell, sample) = without(cell, sample);
}

int Worth::first(uint32_t cell) const {
  return kSamplesPerOctave * (finest_ - finenessOf(cells_[cell]));
}

double Worth::texelPixels(uint32_t cell, int sample) const {
  return kWorthTexelPixels * std::exp2(double(first(cell) - sample) / kSamplesPerOctave);
}

double Worth::pixels(uint32_t cell, int sample) const {
  const double texel = texelPixels(cell, sample);
  return double(meanTexels_[cell]) * texel * texel;
}

double Worth::error(uint32_t cell, ErrorWay way, int sample, double unknown) const {
  const ErrorTable& errors = cells_[cell].errors;
  return errors.knows(way) ? expectedError(errors, way, texelPixels(cell, sample)) : unknown;
}

double Worth::impostor(uint32_t cell, int sample) const {
  const double error = Worth::error(cell, ErrorWay::depthCorrected, sample, kCosts.impostorError);
  const double perPixel = kCosts.pixelUs + kCosts.errorUs * error;
  return kCosts.impostorUs + 2 * kCosts.texelUs * double(meanTexels_[cell]) + perPixel * pixels(cell, sample);
}

double Worth::without(uint32_t index, int sample) const {
  const CellRecord& cell = cells_[index];
  if (cell.triangles == 0) return 0;
  if (cell.childCount == 0)
    return kCosts.meshUs + kCosts.triangleUs * static_cast<double>(cell.triangles) +
           kCosts.errorUs * error(index, ErrorWay::mesh, sample, kCosts.triangleError) * pixels(index, sample);
  double sum = 0;
  for (uint32_t child = cell.firstChild; child < cell.firstChild + cell.childCount; ++child)
    sum += costs_[static_cast<size_t>(child) * static_cast<size_t>(samples_) + static_cast<size_t>(sample)];
  return sum;
}

double Worth::between(uint32_t cell, int end) const {
  double saved = 0;
  for (int sample = first(cell); sample < end; ++sample) saved += without(cell, sample) - impostor(cell, sample);
  return saved / kSamplesPerOctave;
}

double Worth::total() const {
  double sum = 0;
  if (!cells_.empty())
    for (int sample = 0; sample < samples_; ++sample) sum += costs_[static_cast<size_t>(sample)];
  return sum / kSamplesPerOctave;
}

void Worth::keep(uint32_t cell) {
  kept_[cell] = true;
  for (int sample = first(cell); sample < samples_; ++sample) cost(cell, sample) = impostor(cell, sample);
  for (uint32_t above = cells_[cell].parent; above != kNone; above = cells_[above].parent)
    for (int sample = 0; sample < (kept_[above] ? first(above) : samples_); ++sample)
      cost(above, sample) = without(above, sample);
}

}  // namespace farcell
