#include "preprocess/measure/measure_cell.h"

#include <algorithm>
#include <map>

#include "cache/base/check.h"

namespace farcell {
namespace {

constexpr std::array<glm::dvec3, 3> kDirections = {glm::dvec3(0.333599773, 0.891393469, 0.306804293),
                                                   glm::dvec3(-0.307701151, 0.331623480, -0.891821656),
                                                   glm::dvec3(0.890899572, -0.306274387, -0.335401180)};
constexpr int kTruthSamples = 16;  // at the finest scale
constexpr int kMeshSamples = 4;
// Of impostors, where a texel is two pixels, every fourth pixel says enough.
constexpr int kFinestStride = 2;

struct Pair {
  Picture front, back;
  const Picture& side(int i) const { return i == 0 ? front : back; }
};

int edgeOf(int imageSize, size_t scale) { return static_cast<int>(imageSize * kErrorTexelPixels[scale]); }

class Measurement {
 public:
  Measurement(const MeasuredCell& cell, const ViewOf& view, const MeasureSettings& settings)
      : cell_(cell), view_(view), settings_(settings) {
    while (scales_ > 1 && edgeOf(settings.imageSize, scales_ - 1) > kMaxMeasuredEdge) --scales_;
  }

  Result<CellErrors> run() {
    for (const glm::dvec3& direction : measuredDirections()) FARCELL_TRY(alongAxis(glm::normalize(direction)));
    return errors_;
  }

 private:
  Pair bake(const CellSoup& soup, glm::dvec3 direction, int edge, int samples) const {
    ViewBaker baker({edge, samples, settings_.sun, false}, cell_.textures);
    BakedView front, back;
    baker.begin(viewFrame(direction));
    baker.add(soup);
    baker.finish(front, back);
    return {pictureOf(front, edge), pictureOf(back, edge)};
  }

  Result<> alongAxis(glm::dvec3 direction) {
    const int finest = edgeOf(settings_.imageSize, scales_ - 1);
    Pair truth = bake(cell_.grown, direction, finest, kTruthSamples);
    const Pair alone = bake(cell_.alone, direction, finest, kTruthSamples);
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

  void triangles(const Pair& truth, const std::array<OwnPixels, 2>& own, glm::dvec3 direction, size_t scale) {
    const auto add = [&](const CellSoup& soup, int samples, ErrorSum& sum) {
      const Pair picture = bake(soup, direction, truth.front.edge, samples);
      for (int side = 0; side < 2; ++side)
        sum.add(truth.side(side), picture.side(side), own[static_cast<size_t>(side)]);
    };
    add(cell_.grown, 1, errors_.single[scale]);
    if (cell_.mesh != nullptr) add(*cell_.mesh, kMeshSamples, way(ErrorWay::mesh)[scale]);
  }

  Result<> impostors(const Picture& truth, const OwnPixels& own, glm::dvec3 direction, size_t scale) {
    const int stride = kErrorTexelPixels[scale] > 1 ? kFinestStride : 1;
    const auto add = [&](std::span<const WeightedView> views, ErrorSum& sum) {
      sum.add(truth, impostorPicture(cell_.content, views, direction, truth.edge, stride), own, stride);
    };
    FARCELL_ASSIGN(const auto two, nearestTwo(direction));
    add(two, way(ErrorWay::depthCorrected)[scale]);
    FARCELL_ASSIGN(const auto three, nearestThree(direction));
    add(three, way(ErrorWay::blended)[scale]);
    return {};
  }

  std::array<ErrorSum, kErrorScales>& way(ErrorWay way) { return errors_.ways[static_cast<size_t>(way)]; }

  Result<std::array<WeightedView, 2>> nearestTwo(glm::dvec3 direction) {
    const auto [first, second] = settings_.viewpoints.nearestTwo(direction);
    FARCELL_ASSIGN(const ViewTexels* nearest, texels(first));
    FARCELL_ASSIGN(const ViewTexels* next, texels(second));
    return std::array<WeightedView, 2>{WeightedView{nearest, 0}, WeightedView{next, 0}};
  }

  // As the renderer does: empty views have no say, sets of face centres have the nearest two.
  Result<std::array<WeightedView, 3>> nearestThree(glm::dvec3 direction) {
    const auto [first, second] = settings_.viewpoints.nearestTwo(direction);
    const Viewpoints::Triple triple = settings_.viewpoints.hasTriangles()
                                          ? settings_.viewpoints.nearestThree(direction)
                                          : Viewpoints::Triple{{first, second, second}, {1, 0, 0}};
    std::array<WeightedView, 3> views;
    double sum = 0;
    for (size_t i = 0; i < views.size(); ++i) {
      FARCELL_ASSIGN(views[i].texels, texels(triple.views[i]));
      views[i].weight = views[i].texels->view.layer >= 0 ? triple.weights[i] : 0;
      sum += views[i].weight;
    }
    std::stable_partition(views.begin(), views.end(),
                          [](const WeightedView& view) { return view.texels->view.layer >= 0; });
    for (WeightedView& view : views) view.weight = sum > 0 ? view.weight / sum : 0;
    return views;
  }

  Result<const ViewTexels*> texels(int view) {
    const auto found = texels_.find(view);
    if (found != texels_.end()) return &found->second;
    FARCELL_ASSIGN(const ViewImage image, view_(view));
    const glm::dvec3 direction = settings_.viewpoints.directions()[static_cast<size_t>(view)];
    return &texels_.emplace(view, ViewTexels(image, direction, settings_.imageSize)).first->second;
  }

  const MeasuredCell& cell_;
  const ViewOf& view_;
  const MeasureSettings& settings_;
  size_t scales_ = kErrorScales;
  std::map<int, ViewTexels> texels_;
  CellErrors errors_;
};

}  // namespace

std::span<const glm::dvec3> measuredDirections() { return kDirections; }

Result<CellErrors> measureCell(const MeasuredCell& cell, const ViewOf& view, const MeasureSettings& settings) {
  return Measurement(cell, view, settings).run();
}

}  // namespace farcell
