#include "preprocess/measure/baked_views.h"

#include "cache/pack/encoded_view.h"
#include "preprocess/encode/view_image.h"

namespace farcell {

BakedViews::BakedViews(const MeasuredCell& cell, const Viewpoints& viewpoints, int imageSize,
                       const MeasureSettings& settings)
    : cell_(cell),
      viewpoints_(viewpoints),
      imageSize_(imageSize),
      viewError_(settings.viewError),
      baker_({imageSize, settings.samples, settings.sun, settings.lighting == Lighting::relightable}, cell.textures) {}

const ViewImage& BakedViews::operator()(int view) {
  if (const auto known = baked_.find(view); known != baked_.end()) return known->second;
  BakedView front, back;
  baker_.begin(viewFrame(viewpoints_.directions()[static_cast<size_t>(view)]));
  baker_.add(cell_.grown);
  baker_.finish(front, back);
  keep(front, view);
  keep(back, viewpoints_.antipode(view));
  return baked_.at(view);
}

double BakedViews::bytes() const {
  double bytes = 0;
  for (const auto& [number, view] : baked_)
    if (view.width > 0) bytes += static_cast<double>(encodeView(view, viewError_).stream.size());
  return bytes;
}

void BakedViews::keep(const BakedView& baked, int view) {
  baked_.emplace(view, quantisedView(baked, static_cast<uint32_t>(view), imageSize_));
}

}  // namespace farcell
