// Views on the GPU: one layer each of a colour array (RGBA8 with mips), a depth array (R8) and, of relightable packs,
// an array of normals (RGBA8 signed, with mips), within a byte budget. Portions as in geometry_store.h; the views used
// longest ago leave first.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "cache/pack/view_space.h"
#include "runtime/gl/objects.h"

namespace farcell {

class ViewStore {
 public:
  // REQUIRES: a current context. Three layers, an impostor's, are always held.
  // withNormals: of relightable packs.
  ViewStore(int imageSize, uint64_t budgetBytes, bool withNormals);

  void beginPortion();
  // Keeps a known view for this portion; null when it has to be added.
  const ResidentView* keep(uint32_t cell, uint32_t view);
  // Uploads and keeps; an empty image (width 0) costs no layer. Null when the portion's views leave no room.
  const ResidentView* add(uint32_t cell, uint32_t view, const ViewImage& image);
  // Colours to texture unit 0, depths to unit 1, normals to unit 2. REQUIRES: an added view that is not empty.
  void bind() const;

  uint64_t usedBytes() const;

 private:
  using Key = std::pair<uint32_t, uint32_t>;
  struct Entry {
    ResidentView view;
    uint64_t portion;
  };
  int takeLayer();
  void grow(int layers);
  bool evictOldest();
  void upload(int layer, const ViewImage& image) const;

  int imageSize_;
  bool withNormals_;
  int maxLayers_;
  int layers_ = 0;
  bool wantsAllLayers_ = false;  // a portion was refused for want of room to copy while growing
  uint64_t portion_ = 0;
  GlTexture colours_;
  GlTexture depths_;
  GlTexture normals_;
  std::vector<int> freeLayers_;
  std::map<Key, Entry> entries_;
};

}  // namespace farcell
