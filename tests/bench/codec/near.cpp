#include "tests/bench/codec/near.h"

#include <algorithm>
#include <cstdlib>

#include "cache/base/check.h"
#include "cache/pack/encoded_view.h"
#include "tests/bench/thread_seconds.h"

namespace farcell {
namespace {

// The nearest multiple of the step in the range.
uint8_t rounded(int value, int step, int lowest, int highest) {
  return static_cast<uint8_t>(std::clamp((value + step / 2) / step * step, lowest, highest));
}

ViewImage roundedView(ViewImage view, int maxError) {
  const int step = 2 * maxError + 1;
  for (size_t i = 0; i < view.depth.size(); ++i) {
    uint8_t* const texel = &view.rgba[4 * i];
    if (texel[3] > 0 && texel[3] < 255) texel[3] = rounded(texel[3], step, 1, 254);
    for (size_t k = 0; k < 3; ++k) texel[k] = rounded(texel[k], step, 0, texel[3]);
    if (view.depth[i] > 0) view.depth[i] = rounded(view.depth[i], step, 1, 255);
  }
  return view;
}

void addErrors(const ViewImage& view, const ViewImage& decoded, NearTotals& totals) {
  for (size_t i = 0; i < view.depth.size(); ++i) {
    for (size_t channel = 0; channel < 5; ++channel) {
      if ((channel < 4 ? view.rgba[4 * i + 3] : view.depth[i]) > 0) ++totals.texels[channel];
      const int error =
          channel < 4 ? view.rgba[4 * i + channel] - decoded.rgba[4 * i + channel] : view.depth[i] - decoded.depth[i];
      totals.worst[channel] = std::max(totals.worst[channel], std::abs(error));
      totals.squares[channel] += static_cast<uint64_t>(error * error);
    }
  }
}

}  // namespace

std::vector<NearTotals> nearWays() {
  std::vector<NearTotals> ways;
  for (const int error : {0, 1, 2, 3, 4, 6, 8}) ways.push_back({error, NearWay::insidePrediction});
  for (const int error : {1, 2, 4}) ways.push_back({error, NearWay::beforePrediction});
  return ways;
}

void addNear(const ViewImage& view, std::vector<NearTotals>& totals) {
  for (NearTotals& way : totals) {
    const bool inside = way.way == NearWay::insidePrediction;
    const double start = threadSeconds();
    const EncodedView encoded = inside ? encodeView(view, way.maxError) : encodeView(roundedView(view, way.maxError));
    const double encodedAt = threadSeconds();
    const auto page = decodeViewPage(viewPageOf(std::span(&encoded, 1)).bytes, {view.view + 1, 1024, UINT32_MAX});
    way.decodeSeconds += threadSeconds() - encodedAt;
    way.encodeSeconds += encodedAt - start;
    FARCELL_CHECK(page.has_value());
    way.bytes += encoded.stream.size();
    addErrors(view, page->views[0], way);
  }
}

}  // namespace farcell
