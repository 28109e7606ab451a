// Views of a cell that are baked for the occasion, each with its antipode, which is soon asked for.
#pragma once

#include <map>

#include "cache/schema/viewpoints.h"
#include "preprocess/measure/measure_cell.h"

namespace farcell {

class BakedViews {
 public:
  // All must outlive it.
  BakedViews(const MeasuredCell& cell, const Viewpoints& viewpoints, int imageSize, const MeasureSettings& settings);

  const ViewImage& operator()(int view);

  size_t count() const { return baked_.size(); }
  double bytes() const;  // of all that were baked, coded

 private:
  void keep(const BakedView& baked, int view);

  const MeasuredCell& cell_;
  const Viewpoints& viewpoints_;
  const int imageSize_, viewError_;
  ViewBaker baker_;
  std::map<int, ViewImage> baked_;
};

}  // namespace farcell
