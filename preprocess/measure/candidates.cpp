#include "preprocess/measure/candidates.h"

#include "preprocess/measure/baked_views.h"

namespace farcell {
namespace {

constexpr double kViewHeaderBytes = 32;

class CandidateMeasurement {
 public:
  CandidateMeasurement(const MeasuredCell& cell, const MeasureSettings& settings) : cell_(cell), settings_(settings) {}

  Result<CellCandidates> run() {
    for (const glm::dvec3& direction : measuredDirections()) FARCELL_TRY(along(glm::normalize(direction)));
    for (size_t i = 0; i < kCandidates; ++i) {
      const Baked& baked = baked_[i / kCandidateViews.size()];
      result_.forms[i].bytes =
          candidateForm(i).views * (baked.bytes / static_cast<double>(baked.views) + kViewHeaderBytes);
    }
    return result_;
  }

 private:
  // Of all axes, of a size.
  struct Baked {
    double bytes = 0;
    size_t views = 0;
  };
  struct Truths {
    std::array<std::optional<PicturePair>, kPictureEdges.size()> pictures;
    std::array<OwnPixels, 2> own;
  };

  Truths truthsAlong(glm::dvec3 direction) const {
    constexpr size_t kFinest = kPictureEdges.size() - 1;
    PicturePair truth =
        takePair(cell_.grown, cell_.textures, settings_.sun, direction, kPictureEdges[kFinest], kTruthSamples);
    const PicturePair alone =
        takePair(cell_.alone, cell_.textures, settings_.sun, direction, kPictureEdges[kFinest], kTruthSamples);
    Truths truths{{}, {OwnPixels(alone.front, truth.front), OwnPixels(alone.back, truth.back)}};
    for (size_t edge = kFinest;; --edge) {
      truths.pictures[edge] = truth;
      if (edge == 0) return truths;
      truth = {halved(truth.front), halved(truth.back)};
    }
  }

  Result<> along(glm::dvec3 direction) {
    const Truths truths = truthsAlong(direction);
    for (size_t edge = 0; edge < kPictureEdges.size(); ++edge) {
      const auto add = [&](const CellSoup& soup, int samples, ErrorSum& sum) {
        const PicturePair pair = takePair(soup, cell_.textures, settings_.sun, direction, kPictureEdges[edge], samples);
        for (int side = 0; side < 2; ++side)
          sum.add(truths.pictures[edge]->side(side), pair.side(side), truths.own[static_cast<size_t>(side)]);
      };
      add(cell_.grown, 1, result_.single[edge]);
      add(cell_.alone, kMeshSamples, result_.triangles[edge]);
    }
    for (size_t size = 0; size < kCandidateSizes.size(); ++size) FARCELL_TRY(ofSize(size, truths, direction));
    return {};
  }

  // Sets are nested: the views of the largest are those of all, by the same numbers.
  Result<> ofSize(size_t size, const Truths& truths, glm::dvec3 direction) {
    const int imageSize = kCandidateSizes[size];
    BakedViews baked(cell_, Viewpoints::of(kCandidateViews.back()), imageSize, settings_);
    const ViewOf view = [&](int number) -> Result<ViewImage> { return baked(number); };
    for (size_t set = 0; set < kCandidateViews.size(); ++set) {
      ViewSet views(Viewpoints::of(kCandidateViews[set]), imageSize, view);
      CandidateErrors& errors = result_.forms[size * kCandidateViews.size() + set];
      for (int side = 0; side < 2; ++side) {
        const glm::dvec3 toward = side == 0 ? direction : -direction;
        FARCELL_ASSIGN(const auto two, views.nearestTwo(toward));
        FARCELL_ASSIGN(const auto three, views.nearestThree(toward));
        for (size_t edge = 0; edge < kPictureEdges.size() && 2 * kPictureEdges[edge] <= imageSize; ++edge) {
          const auto add = [&](std::span<const WeightedView> some, ErrorSum& sum) {
            const Picture& truth = truths.pictures[edge]->side(side);
            sum.add(truth, impostorPicture(cell_.content, some, toward, settings_.sun, truth.edge),
                    truths.own[static_cast<size_t>(side)]);
          };
          add(two, errors.depthCorrected[edge]);
          add(three, errors.blended[edge]);
        }
      }
    }
    baked_[size].bytes += baked.bytes();
    baked_[size].views += baked.count();
    return {};
  }

  const MeasuredCell& cell_;
  const MeasureSettings& settings_;
  std::array<Baked, kCandidateSizes.size()> baked_{};
  CellCandidates result_;
};

}  // namespace

ViewForm candidateForm(size_t candidate) {
  return {kCandidateViews[candidate % kCandidateViews.size()], kCandidateSizes[candidate / kCandidateViews.size()]};
}

Result<CellCandidates> measureCandidates(const MeasuredCell& cell, const MeasureSettings& settings) {
  return CandidateMeasurement(cell, settings).run();
}

}  // namespace farcell
