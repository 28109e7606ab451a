#include "preprocess/measure/measure_cell.h"

#include <algorithm>
#include <map>

#include "cache/pack/encoded_view.h"
#include "preprocess/encode/view_image.h"

namespace farcell {
namespace {

constexpr std::array<glm::dvec3, 3> kDirections = {glm::dvec3(0.333599773, 0.891393469, 0.306804293),
                                                   glm::dvec3(-0.307701151, 0.331623480, -0.891821656),
                                                   glm::dvec3(0.890899572, -0.306274387, -0.335401180)};
constexpr int kTruthSamples = 16;  // at the finest scale
constexpr int kMeshSamples = 4;
// Of impostors, where a texel is two pixels, every fourth pixel says enough.
constexpr int kFinestStride = 2;

int edgeOf(int imageSize, size_t scale) { return static_cast<int>(imageSize * kErrorTexelPixels[scale]); }

struct Pair {
  Picture front, back;
  const Picture& side(int i) const { return i == 0 ? front : back; }
};

constexpr size_t kAlternativeScale = 1;

// Views baked for the occasion, each with its antipode, which is soon asked for.
class BakedViews {
 public:
  BakedViews(const MeasuredCell& cell, const Viewpoints& viewpoints, int imageSize, const MeasureSettings& settings)
      : cell_(cell),
        viewpoints_(viewpoints),
        imageSize_(imageSize),
        viewError_(settings.viewError),
        baker_({imageSize, settings.samples, settings.sun, settings.lighting == Lighting::relightable}, cell.textures) {
  }

  ViewImage operator()(int view) {
    if (const auto known = baked_.find(view); known != baked_.end()) return known->second;
    BakedView front, back;
    baker_.begin(viewFrame(viewpoints_.directions()[static_cast<size_t>(view)]));
    baker_.add(cell_.grown);
    baker_.finish(front, back);
    keep(front, view);
    keep(back, viewpoints_.antipode(view));
    return baked_.at(view);
  }

  double meanBytes() const {
    double bytes = 0;
    for (const auto& [number, view] : baked_)
      if (view.width > 0) bytes += static_cast<double>(encodeView(view, viewError_).stream.size());
    return bytes / static_cast<double>(baked_.size());
  }

 private:
  void keep(const BakedView& baked, int view) {
    baked_.emplace(view, quantisedView(baked, static_cast<uint32_t>(view), imageSize_));
  }

  const MeasuredCell& cell_;
  const Viewpoints& viewpoints_;
  const int imageSize_, viewError_;
  ViewBaker baker_;
  std::map<int, ViewImage> baked_;
};

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
  Pair bake(const CellSoup& soup, glm::dvec3 direction, int edge, int samples) const {
    ViewBaker baker({edge, samples, settings_.sun, false}, &soup == cell_.mesh ? cell_.meshTextures : cell_.textures);
    BakedView front, back;
    baker.begin(viewFrame(direction));
    baker.add(soup);
    baker.finish(front, back);
    return {pictureOf(front, edge), pictureOf(back, edge)};
  }

  // Where a texel is half a pixel.
  Result<> alternatives(const Pair& truth, const std::array<OwnPixels, 2>& own, glm::dvec3 direction) {
    for (size_t set = 0; set < kAlternativeViews.size(); ++set) {
      FARCELL_ASSIGN(const Viewpoints viewpoints, Viewpoints::create(kAlternativeViews[set]));
      for (size_t size = 0; size < kAlternativeSizes.size(); ++size) {
        BakedViews baked(cell_, viewpoints, kAlternativeSizes[size], settings_);
        const ViewOf view = [&](int number) { return baked(number); };
        ViewSet views(viewpoints, kAlternativeSizes[size], view);
        Alternative& sums = errors_.alternatives[set][size];
        for (int side = 0; side < 2; ++side) {
          const glm::dvec3 toward = side == 0 ? direction : -direction;
          const auto add = [&](std::span<const WeightedView> some, ErrorSum& sum) {
            sum.add(truth.side(side), impostorPicture(cell_.content, some, toward, settings_.sun, truth.front.edge),
                    own[static_cast<size_t>(side)]);
          };
          FARCELL_ASSIGN(const auto two, views.nearestTwo(toward));
          add(two, sums.depthCorrected);
          FARCELL_ASSIGN(const auto three, views.nearestThree(toward));
          add(three, sums.blended);
        }
        sums.bytes = baked.meanBytes() * kAlternativeViews[set];
      }
    }
    return {};
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
      if (settings_.alternatives && scale == kAlternativeScale && direction == glm::normalize(kDirections[0]))
        FARCELL_TRY(alternatives(truth, own, direction));
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
