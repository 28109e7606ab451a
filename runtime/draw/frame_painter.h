// Draws a cut into the bound target: makes cells resident, in portions where they do not all fit.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <unordered_map>

#include "cache/base/result.h"
#include "cache/pack/pack_file.h"
#include "runtime/draw/atlas_store.h"
#include "runtime/draw/frame_camera.h"
#include "runtime/draw/geometry_store.h"
#include "runtime/draw/impostor_instance.h"
#include "runtime/draw/impostor_kind.h"
#include "runtime/draw/line_painter.h"
#include "runtime/draw/show.h"
#include "runtime/draw/view_store.h"
#include "runtime/gl/program.h"

namespace farcell {

struct PaintCounts {
  uint64_t impostors = 0;  // cells drawn as impostors
  uint64_t texels = 0;     // of their views
  uint64_t bytesRead = 0;  // from the pack
};

class FramePainter {
 public:
  // REQUIRES: a current context; `pack` outlives the painter.
  static Result<FramePainter> create(const PackFile& pack, uint64_t residentBytes);

  // Triangles first, opaque; then the impostors, back to front, over them; then the lines of the plan, which is this
  // cut's.
  Result<> paint(const Cut& cut, const FrameCamera& camera, ImpostorKind kind, const ShowPlan& plan,
                 PaintCounts& counts);

 private:
  struct Programs {
    std::array<GlProgram, 4> triangles;  // by trianglesOf()
    GlProgram flat;
    GlProgram depthCorrected;
    GlProgram blended;
  };
  // What one frame is painted with.
  struct Frame {
    const Cut& cut;
    const FrameCamera& camera;
    ImpostorKind kind;
    const ShowPlan& plan;
    const Programs& programs;
    PaintCounts& counts;
    std::vector<LineEnd> lines;
  };
  FramePainter(const PackFile& pack, uint64_t residentBytes);
  Result<> prepare(Look look);
  Result<Programs> loadPrograms(Look look) const;
  // Pages to be drawn together.
  struct Portion {
    std::vector<uint32_t> pages;
    std::vector<GeometryStore::Tint> tints;
    std::vector<uint32_t> atlases;  // their numbers
  };
  using Portions = std::array<Portion, 4>;  // by trianglesOf()
  // For all samples or for some of them; without or with an atlas.
  static size_t trianglesOf(bool shared, bool textured) { return (shared ? 1u : 0u) + (textured ? 2u : 0u); }
  Result<> paintTriangles(const Frame& frame);
  Result<> addAtlas(uint32_t page, const CellRecord& cell, const Frame& frame, Portions& portions);
  Result<> refineAtlas(uint32_t page, const CellRecord& cell, const Frame& frame);
  uint32_t wantedLevel(uint32_t page, const CellRecord& cell, const Frame& frame, const TexturePage& atlas) const;
  uint32_t numberOf(std::span<const PageRecord> atlas) const;  // index of its first page
  Result<TexturePage> readAtlasPage(uint32_t page, PaintCounts& counts) const;
  Result<> addPage(uint32_t index, const Frame& frame, Portions& portions);
  void drawPortions(const Frame& frame, Portions& portions);
  Result<std::optional<ImpostorViews>> residentViews(const CutEntry& entry, ImpostorKind kind, PaintCounts& counts);
  Result<> paintImpostors(Frame& frame);
  void drawImpostors(const std::vector<shared::ImpostorInstance>& instances, const ViewStore& views,
                     const Frame& frame);
  Result<> paintLines(Frame& frame);
  Result<ViewImage> readView(uint32_t cell, uint32_t view, PaintCounts& counts) const;

  const PackFile& pack_;
  std::array<std::optional<Programs>, 4> programs_;  // by look, each made with the first frame that has it
  std::optional<LinePainter> linePainter_;           // likewise
  const bool textured_;                              // some leaf has an atlas
  GeometryStore geometry_;
  AtlasStore atlases_;
  std::unordered_map<uint32_t, double> atlasEdgesPerStep_;  // of pages with an atlas that were resident
  std::map<int, ViewStore> views_;                          // by image size: of the cells of the pack that have views
  GlBuffer uniforms_;
  GlBuffer instances_;
  GlBuffer corners_;    // element indices of a box's faces, then of a rectangle
  GlVertexArray bare_;  // no attributes: corners come from gl_VertexID
};

}  // namespace farcell
