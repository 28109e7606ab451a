#include "preprocess/measure/view_set.h"

#include <algorithm>

namespace farcell {

Result<std::array<WeightedView, 2>> ViewSet::nearestTwo(glm::dvec3 direction) {
  const auto [first, second] = viewpoints_.nearestTwo(direction);
  FARCELL_ASSIGN(const ViewTexels* nearest, texels(first));
  FARCELL_ASSIGN(const ViewTexels* next, texels(second));
  return std::array<WeightedView, 2>{WeightedView{nearest, 0}, WeightedView{next, 0}};
}

Result<std::array<WeightedView, 3>> ViewSet::nearestThree(glm::dvec3 direction) {
  const auto [first, second] = viewpoints_.nearestTwo(direction);
  const Viewpoints::Triple triple = viewpoints_.hasTriangles() ? viewpoints_.nearestThree(direction)
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

Result<const ViewTexels*> ViewSet::texels(int view) {
  const auto found = texels_.find(view);
  if (found != texels_.end()) return &found->second;
  FARCELL_ASSIGN(const ViewImage image, view_(view));
  const glm::dvec3 direction = viewpoints_.directions()[static_cast<size_t>(view)];
  return &texels_.emplace(view, ViewTexels(image, direction, imageSize_)).first->second;
}

}  // namespace farcell
