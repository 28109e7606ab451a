// Views of a cell from one set of viewpoints and of one size, as a renderer chooses among them.
#pragma once

#include <array>
#include <functional>
#include <map>

#include "cache/base/result.h"
#include "cache/schema/viewpoints.h"
#include "preprocess/measure/impostor_picture.h"

namespace farcell {

using ViewOf = std::function<Result<ViewImage>(int view)>;

class ViewSet {
 public:
  // view: gives one by its number, asked once. All must outlive the set.
  ViewSet(const Viewpoints& viewpoints, int imageSize, const ViewOf& view)
      : viewpoints_(viewpoints), imageSize_(imageSize), view_(view) {}

  // Kind A from a direction (unit): the nearest view, and the next.
  Result<std::array<WeightedView, 2>> nearestTwo(glm::dvec3 direction);
  // Kind B: empty views have no say; of sets without triangles, the nearest two.
  Result<std::array<WeightedView, 3>> nearestThree(glm::dvec3 direction);

 private:
  Result<const ViewTexels*> texels(int view);

  const Viewpoints& viewpoints_;
  const int imageSize_;
  const ViewOf& view_;
  std::map<int, ViewTexels> texels_;
};

}  // namespace farcell
