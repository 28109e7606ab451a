#include "preprocess/measure/expect_errors.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "cache/schema/view_frame.h"

namespace farcell {
namespace {

constexpr double kLeastMeanError = 1e-3;  // of a pixel: less is nothing

// Logarithm of the mean error of a pixel. Scales that were not measured are like the next coarser.
std::optional<double> logError(const std::array<ErrorSum, kErrorScales>& sums, size_t scale) {
  while (scale > 0 && sums[scale].covered == 0) --scale;
  if (sums[scale].covered <= 0) return std::nullopt;
  return std::log2(std::max(sums[scale].mean(), kLeastMeanError));
}

// What is known of one way at one scale.
class Expectation {
 public:
  Expectation(std::span<const Features> features, const std::map<uint32_t, CellErrors>& measured, size_t way,
              size_t scale)
      : features_(features) {
    for (const auto& [cell, errors] : measured) {
      const std::optional<double> value = logError(errors.ways[way], scale);
      if (!value) continue;
      measured_[cell] = *value;
      inputs_.push_back(features[cell]);
      values_.push_back(*value);
    }
    if (!values_.empty()) regression_.emplace(inputs_, values_);
  }

  bool known() const { return regression_.has_value(); }
  double of(uint32_t cell) const {
    const auto found = measured_.find(cell);
    return found != measured_.end() ? found->second : (*regression_)(features_[cell]);
  }

  ExpectedApart apart() const {
    ExpectedApart result{values_.size(), 0, 0};
    if (values_.size() < 2) return result;
    std::vector<double> off = leaveOneOut(inputs_, values_);
    for (size_t i = 0; i < off.size(); ++i) off[i] = std::abs(std::exp2(off[i] - values_[i]) - 1);
    std::sort(off.begin(), off.end());
    result.median = off[off.size() / 2];
    result.ninetieth = off[off.size() * 9 / 10];
    return result;
  }

 private:
  const std::span<const Features> features_;
  std::map<uint32_t, double> measured_;
  std::vector<Features> inputs_;
  std::vector<double> values_;
  std::optional<Regression> regression_;
};

// Geometric mean of full geometry's at one sample a pixel.
double unitOf(const std::map<uint32_t, CellErrors>& measured) {
  double sum = 0;
  size_t count = 0;
  for (const auto& [cell, errors] : measured)
    for (size_t scale = 0; scale < kErrorScales; ++scale)
      if (const std::optional<double> value = logError(errors.single, scale)) {
        sum += *value;
        ++count;
      }
  return count > 0 ? std::exp2(sum / static_cast<double>(count)) : 0;
}

bool has(ErrorWay way, const CellRecord& cell, const ViewFigures& views) {
  return way == ErrorWay::mesh ? cell.meshTriangles > 0 : views.views > 0;
}

double logOf(double value) { return std::log2(std::max(value, 1e-9)); }

}  // namespace

Features featuresOf(const Model& model, const CellRecord& cell, const ViewFigures& views) {
  const double texel = texelSize(cell.form.imageSize);  // half sides
  const double halfSide = cellHalfSide(model.grid, cell.key);
  const double covered = std::max(views.coveredTexels, 1.0);
  const glm::dvec3 size = glm::dvec3(cell.content.max - cell.content.min) * (model.grid.step() / halfSide);
  const double box = (size.x * size.y + size.y * size.z + size.z * size.x) / 2;
  return {logOf(static_cast<double>(cell.triangles) / covered),
          views.edgeTexels / covered,
          logOf(views.bytes / covered),
          logOf(covered),
          logOf(covered * texel * texel / std::max(box, texel * texel)),
          static_cast<double>(cell.key.level),
          logOf(cell.geometricError / halfSide / texel + 1.0 / 64),
          logOf(static_cast<double>(cell.triangles) / static_cast<double>(std::max<uint64_t>(cell.meshTriangles, 1)))};
}

ExpectedErrors expectErrors(const Model& model, std::span<const CellRecord> cells, std::span<const ViewFigures> views,
                            const std::map<uint32_t, CellErrors>& measured) {
  ExpectedErrors result;
  result.tables.resize(cells.size());
  result.unit = unitOf(measured);
  if (result.unit <= 0) return result;
  std::vector<Features> features;
  for (size_t cell = 0; cell < cells.size(); ++cell) features.push_back(featuresOf(model, cells[cell], views[cell]));
  for (size_t way = 0; way < kErrorWays; ++way) {
    for (size_t scale = 0; scale < kErrorScales; ++scale) {
      const Expectation expectation(features, measured, way, scale);
      if (!expectation.known()) continue;
      result.apart[way][scale] = expectation.apart();
      for (uint32_t cell = 0; cell < cells.size(); ++cell)
        if (has(static_cast<ErrorWay>(way), cells[cell], views[cell]))
          result.tables[cell].codes[way][scale] = codeFromError(std::exp2(expectation.of(cell)) / result.unit);
    }
  }
  return result;
}

}  // namespace farcell
