// Pages of geometry on the GPU, within a byte budget; those used longest ago leave first.
//
// A frame is drawn in portions: what was asked for since `beginPortion` stays until the next one. When `add` refuses,
// the caller draws what it has, begins a new portion and adds again.
#pragma once

#include <array>
#include <cstdint>
#include <list>
#include <unordered_map>
#include <vector>

#include "runtime/draw/gpu_mesh.h"
#include "runtime/draw/range_allocator.h"
#include "runtime/gl/objects.h"

namespace farcell {

class GeometryStore {
 public:
  // One page is always held, also when it alone is larger than the budget. textured: pages may have an atlas.
  explicit GeometryStore(uint64_t budgetBytes, bool textured = false);

  void beginPortion() { ++portion_; }
  // Keeps a resident page for this portion; false when it is not resident.
  bool keep(uint32_t page);
  // Uploads and keeps. False, and nothing changed that matters, when the portion's pages leave no room.
  bool add(uint32_t page, const GpuMesh& mesh);
  // Draws resident pages kept in this portion, with the bound program: one multi-draw for each buffer they lie in.
  // `tints`: of each page, at location 3: a colour and the shares of the cut (hand_over.h) that it is for; empty: the
  // program asks for none.
  // `atlases`: the texture of each page, which has an atlas: bound to unit 3, coordinates at location 4; empty: the
  // program asks for none.
  using Tint = std::array<uint8_t, 4>;
  void draw(const std::vector<uint32_t>& pages, const std::vector<Tint>& tints, const std::vector<GLuint>& atlases);

  uint64_t usedBytes() const { return usedBytes_; }

 private:
  // One vertex and one index buffer, shared by many pages.
  struct Chunk {
    GlBuffer vertices;
    GlBuffer indices;
    GlBuffer coordinates;  // of textured stores
    RangeAllocator vertexRanges;
    RangeAllocator indexRanges;
    uint64_t sizeBytes;
  };
  using ChunkIterator = std::list<Chunk>::iterator;
  struct Resident {
    ChunkIterator chunk;
    uint32_t firstVertex, vertexCount;
    uint32_t firstIndex, indexCount;
    uint64_t portion;  // last use
  };

  bool place(uint32_t page, const GpuMesh& mesh);
  void addChunk(const GpuMesh& mesh);
  bool evictOldest();
  void bindChunk(const Chunk& chunk, bool coordinates);
  void bindTints(const std::vector<Tint>& tints);

  uint64_t budgetBytes_;
  bool textured_;
  uint64_t vertexBytes_;
  uint64_t usedBytes_ = 0;
  uint64_t portion_ = 0;
  std::list<Chunk> chunks_;
  std::unordered_map<uint32_t, Resident> residents_;
  GlVertexArray layout_;
  GlBuffer commands_;
  GlBuffer tints_;
};

}  // namespace farcell
