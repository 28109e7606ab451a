// Views coded one by one and put together to pages later, without coding them again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cache/base/result.h"
#include "cache/pack/pages.h"
#include "cache/pack/view_planes.h"

namespace farcell {

// One view as a page stores it: its header and its stream. The fields are those of ViewImage.
struct EncodedView {
  uint32_t view = 0;
  uint32_t x0 = 0, y0 = 0;
  uint32_t width = 0, height = 0;
  float depthMin = 0;
  float depthMax = 0;
  ViewCoding coding = 0;
  uint32_t decodedBytes = 0;      // of its planes; 0: nothing is seen from here
  std::vector<std::byte> stream;  // empty when decodedBytes is 0
  bool operator==(const EncodedView&) const = default;
};

// Deterministic, and alone of all views: what a page holds besides does not matter. `maxError` as in
// BuildSettings::viewError; 0: what is decoded equals the image. Expects a valid image (CHECK).
EncodedView encodeView(const ViewImage& image, int maxError = 0);

// The same texels in fewer bytes if there is a way: filters are tried and deflate takes its time, some twenty times
// that of encodeView. What it cannot make smaller it gives back. REQUIRES: a view of viewsOfPage.
Result<EncodedView> smallerView(const EncodedView& view);

struct EncodedViewPage {
  std::vector<std::byte> bytes;
  uint32_t duplicates = 0;      // views whose stream equals an earlier one's, which they share
  uint64_t duplicateBytes = 0;  // what their streams would have taken
};

// REQUIRES: rising views; all that are not empty with normals, or all without.
EncodedViewPage viewPageOf(std::span<const EncodedView> views);

// PageRecord::decodedBytes of the page of these views.
uint32_t decodedSizeBytes(std::span<const EncodedView> views);

// The inverse of viewPageOf: headers are checked, streams are not decoded. Also the way to keep a single view in a
// file: as a page of one.
Result<std::vector<EncodedView>> viewsOfPage(std::span<const std::byte> bytes, const ViewLimits& limits);

}  // namespace farcell
