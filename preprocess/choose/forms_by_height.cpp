#include "preprocess/choose/forms_by_height.h"

#include <algorithm>
#include <array>
#include <vector>

#include "cache/base/check.h"

namespace farcell {
namespace {

// Each holds the directions of the one before.
constexpr std::array kSets = {12, 42, 162, 642};

}  // namespace

bool isBaseOfHeights(const ViewForm& base) {
  return std::find(kSets.begin() + 1, kSets.end() - 1, base.views) != kSets.end() - 1 &&
         isImageSize(2 * base.imageSize);
}

void setFormsByHeight(const ViewForm& base, std::span<CellRecord> cells) {
  FARCELL_CHECK(isBaseOfHeights(base));
  const auto set = std::find(kSets.begin(), kSets.end(), base.views);
  const std::array<ViewForm, 4> forms = {
      {{set[-1], 2 * base.imageSize}, base, {base.views, 2 * base.imageSize}, {set[1], 2 * base.imageSize}}};
  std::vector<size_t> heights(cells.size(), 0);
  for (size_t i = cells.size(); i-- > 0;) {
    cells[i].form = forms[std::min(heights[i], forms.size() - 1)];
    if (cells[i].parent != kNone) heights[cells[i].parent] = std::max(heights[cells[i].parent], heights[i] + 1);
  }
}

}  // namespace farcell
