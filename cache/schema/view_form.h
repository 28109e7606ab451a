// How the impostor of a cell is baked.
#pragma once

#include <bit>

#include "cache/schema/viewpoints.h"

namespace farcell {

inline constexpr int kMinImageSize = 16;
inline constexpr int kMaxImageSize = 1024;

struct ViewForm {
  int views = 42;       // size of the viewpoint set, see viewpoints.h
  int imageSize = 128;  // texels along a view's edge: a power of two, kMinImageSize..kMaxImageSize
  bool operator==(const ViewForm&) const = default;
};

inline bool isImageSize(int size) {
  return size >= kMinImageSize && size <= kMaxImageSize && std::has_single_bit(static_cast<unsigned>(size));
}
inline bool isViewForm(const ViewForm& form) { return Viewpoints::exists(form.views) && isImageSize(form.imageSize); }

}  // namespace farcell
