#include "preprocess/atlas/packing.h"

#include <algorithm>
#include <cmath>

// The library's sort may leave equal rectangles in any order.
namespace farcell {
namespace {
template <class Compare>
void sortRectangles(void* base, size_t count, size_t size, Compare compare);
}
}  // namespace farcell
#define STBRP_STATIC
#define STBRP_SORT(base, count, size, compare) farcell::sortRectangles(base, static_cast<size_t>(count), size, compare)
#define STB_RECT_PACK_IMPLEMENTATION
#include <stb/stb_rect_pack.h>

namespace farcell {
namespace {

template <class Compare>
void sortRectangles(void* base, size_t count, size_t, Compare compare) {
  const std::span<stbrp_rect> rectangles(static_cast<stbrp_rect*>(base), count);
  std::stable_sort(rectangles.begin(), rectangles.end(),
                   [&](const stbrp_rect& a, const stbrp_rect& b) { return compare(&a, &b) < 0; });
}

std::optional<Packing> packedInto(std::span<const glm::uvec2> sizes, uint32_t width, uint32_t maxEdge) {
  std::vector<stbrp_rect> rectangles(sizes.size());
  for (size_t i = 0; i < sizes.size(); ++i)
    rectangles[i] = {
        static_cast<int>(i), static_cast<stbrp_coord>(sizes[i].x), static_cast<stbrp_coord>(sizes[i].y), 0, 0, 0};
  std::vector<stbrp_node> nodes(width);
  stbrp_context context;
  stbrp_init_target(&context, static_cast<int>(width), static_cast<int>(maxEdge), nodes.data(),
                    static_cast<int>(width));
  if (stbrp_pack_rects(&context, rectangles.data(), static_cast<int>(rectangles.size())) == 0) return std::nullopt;
  Packing packing;
  for (const stbrp_rect& rectangle : rectangles) {
    const glm::uvec2 place(static_cast<uint32_t>(rectangle.x), static_cast<uint32_t>(rectangle.y));
    packing.size.x = std::max(packing.size.x, place.x + static_cast<uint32_t>(rectangle.w));
    packing.size.y = std::max(packing.size.y, place.y + static_cast<uint32_t>(rectangle.h));
    packing.places.push_back(place);
  }
  return packing;
}

}  // namespace

std::optional<Packing> packed(std::span<const glm::uvec2> sizes, uint32_t maxEdge) {
  uint64_t area = 0;
  uint32_t width = 1;
  for (const glm::uvec2& size : sizes) {
    if (std::max(size.x, size.y) > maxEdge) return std::nullopt;
    area += uint64_t{size.x} * size.y;
    width = std::max(width, size.x);
  }
  if (area > uint64_t{maxEdge} * maxEdge) return std::nullopt;
  // From a square that would just do to wider ones, until it is no higher than wide.
  width = std::max(width, static_cast<uint32_t>(std::ceil(std::sqrt(static_cast<double>(area)))));
  std::optional<Packing> best;
  for (;; width = std::min(maxEdge, width + width / 8 + 1)) {
    if (std::optional<Packing> packing = packedInto(sizes, width, maxEdge)) {
      const auto texels = [](const Packing& p) { return uint64_t{p.size.x} * p.size.y; };
      if (!best || texels(*packing) < texels(*best)) best = std::move(packing);
      if (best->size.y <= width) return best;
    }
    if (width == maxEdge) return best;
  }
}

}  // namespace farcell
