// Atlases of pages of triangles on the GPU, a texture each with the levels that are needed, within a byte budget.
// Portions as in geometry_store.h; those used longest ago leave first.
//
// A texture each, not layers of arrays: sizes differ, few are needed at a time, and a page of thousands of triangles is
// drawn for each change of texture. The coarsest levels are always there; finer ones as far as the budget goes.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>

#include "cache/pack/pages.h"
#include "runtime/gl/objects.h"

namespace farcell {

class AtlasStore {
 public:
  // One atlas, in its coarsest levels, is always held.
  explicit AtlasStore(uint64_t budgetBytes) : budgetBytes_(budgetBytes) {}

  // Numbers are the caller's: of pages of group 0.
  struct Resident {
    GLuint texture = 0;
    TexturePage shape;        // without texels
    uint32_t firstLevel = 0;  // the finest that is there
  };

  void beginPortion() { ++portion_; }
  // Keeps a resident atlas for this portion; null when it is not resident.
  const Resident* keep(uint32_t number);
  // Uploads and keeps; null, and nothing changed that matters, when the portion's atlases leave no room.
  const Resident* add(uint32_t number, const TexturePage& coarse);
  // How fine a resident atlas may become, of levels from `wanted` on: what there is room for beside this portion's.
  uint32_t finestLevel(uint32_t number, uint32_t wanted) const;
  // Adds the levels before those that are there. REQUIRES: finestLevel() allows them.
  const Resident* refine(uint32_t number, std::span<const TexturePage> finer);

  uint64_t usedBytes() const { return usedBytes_; }

 private:
  struct Entry {
    Resident resident;
    GlTexture texture;
    uint64_t bytes = 0;
    uint64_t portion = 0;  // last use
  };

  GlTexture create(const TexturePage& shape, uint32_t firstLevel) const;
  void makeRoom(uint64_t bytes);

  const uint64_t budgetBytes_;
  uint64_t usedBytes_ = 0;
  uint64_t portion_ = 0;
  std::unordered_map<uint32_t, Entry> entries_;
};

}  // namespace farcell
