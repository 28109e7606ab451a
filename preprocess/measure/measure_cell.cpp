#include "preprocess/measure/measure_cell.h"

#include <algorithm>

namespace farcell {
namespace {

constexpr std::array<glm::dvec3, 3> kDirections = {glm::dvec3(0.333599773, 0.891393469, 0.306804293),
                                                   glm::dvec3(-0.307701151, 0.331623480, -0.891821656),
                                                   glm::dvec3(0.890899572, -0.306274387, -0.335401180)};
// Of impostors, where a texel is two pixels, every fourth pixel says enough.
constexpr int kFinestStride = 2;

class Measurement {
 public:
  Measurement(const MeasuredCell& cell, const ViewOf& view, const MeasureSettings& settings)
      : cell_(cell), settings_(settings), views_(settings.viewpoints, settings.imageSize, view) {
    while (scales_ > 1 && edgeOf(settings.imageSize, scales_ - 1) > kMaxMeasuredEdge) --scales_;
  }

  Result<CellErrors> run() {
    for (const glm::dvec3& direction : measuredDirections()) FARCELL_TRY(alongAxis(glm::normalize(direction)));
    return errors_;
  }

 private:
  static int edgeOf(int imageSize, size_t scale) { return static_cast<int>(imageSize * kErrorTexelPixels[scale]); }

  PicturePair take(const CellSoup& soup, glm::dvec3 direction, int edge, int samples) const {
    TextureSampler* textures = &soup == cell_.mesh ? cell_.meshTextures : cell_.textures;
    return takePair(soup, textures, settings_.sun, direction, edge, samples);
  }

  Result<> alongAxis(glm::dvec3 direction) {
    const int finest = edgeOf(settings_.imageSize, scales_ - 1);
    PicturePair truth = take(cell_.grown, direction, finest, kTruthSamples);
    const PicturePair alone = take(cell_.alone, direction, finest, kTruthSamples);
    const std::array<OwnPixels, 2> own = {OwnPixels(alone.front, truth.front), OwnPixels(alone.back, truth.back)};
    for (size_t scale = scales_; scale-- > 0;) {
      triangles(truth, own, direction, scale);
      for (int side = 0; side < 2; ++side)
        FARCELL_TRY(
            impostors(truth.side(side), own[static_cast<size_t>(side)], side == 0 ? direction : -direction, scale));
      if (scale > 0) truth = {halved(truth.front), halved(truth.back)};
    }
    return {};
  }

  void triangles(const PicturePair& truth, const std::array<OwnPixels, 2>& own, glm::dvec3 direction, size_t scale) {
    const auto add = [&](const CellSoup& soup, int samples, ErrorSum& sum) {
      const PicturePair picture = take(soup, direction, truth.front.edge, samples);
      for (int side = 0; side < 2; ++side)
        sum.add(truth.side(side), picture.side(side), own[static_cast<size_t>(side)]);
    };
    add(cell_.grown, 1, errors_.single[scale]);
    if (cell_.mesh != nullptr) add(*cell_.mesh, kMeshSamples, way(ErrorWay::mesh)[scale]);
  }

  Result<> impostors(const Picture& truth, const OwnPixels& own, glm::dvec3 direction, size_t scale) {
    const int stride = kErrorTexelPixels[scale] > 1 ? kFinestStride : 1;
    const auto add = [&](std::span<const WeightedView> views, ErrorSum& sum) {
      sum.add(truth, impostorPicture(cell_.content, views, direction, settings_.sun, truth.edge, stride), own, stride);
    };
    FARCELL_ASSIGN(const auto two, views_.nearestTwo(direction));
    add(two, way(ErrorWay::depthCorrected)[scale]);
    FARCELL_ASSIGN(const auto three, views_.nearestThree(direction));
    add(three, way(ErrorWay::blended)[scale]);
    return {};
  }

  std::array<ErrorSum, kErrorScales>& way(ErrorWay way) { return errors_.ways[static_cast<size_t>(way)]; }

  const MeasuredCell& cell_;
  const MeasureSettings& settings_;
  size_t scales_ = kErrorScales;
  ViewSet views_;
  CellErrors errors_;
};

}  // namespace

std::span<const glm::dvec3> measuredDirections() { return kDirections; }

Result<CellErrors> measureCell(const MeasuredCell& cell, const ViewOf& view, const MeasureSettings& settings) {
  return Measurement(cell, view, settings).run();
}

}  // namespace farcell
