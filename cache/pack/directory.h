// What a pack holds, as its readers and writers see it. The bytes are described in FORMAT.md.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "cache/pack/error_table.h"
#include "cache/schema/grid.h"
#include "cache/schema/model.h"

namespace farcell {

inline constexpr uint32_t kNone = 0xffffffffu;

enum class PageKind : uint32_t { geometry = 1, views = 2, texture = 3 };

struct PageRecord {
  PageKind kind = PageKind::geometry;
  uint32_t cell = 0;  // index into Directory::cells
  // views: the viewpoint group (Viewpoints::group) this page holds; geometry: its part; texture: see kAtlasGroups
  uint32_t group = 0;
  uint64_t offsetBytes = 0;   // from the start of the file
  uint32_t storedBytes = 0;   // as stored
  uint32_t decodedBytes = 0;  // what it occupies in memory once decoded: budgets are charged with this
  uint64_t checksum = 0;      // XXH3-64 of the stored bytes
};

struct CellRecord {
  CellKey key;
  uint32_t parent = kNone;      // index into Directory::cells; kNone for the root
  uint32_t firstChild = kNone;  // children lie one after the other in Morton order
  uint32_t childCount = 0;      // 0: a leaf
  GridBox content;              // tight around the surface inside the cube
  uint64_t triangles = 0;       // full-resolution triangles inside the cube (clipped pieces)
  // The cell's mesh: the full triangles of a leaf, the simplified mesh of an inner cell, which may have none.
  uint64_t meshTriangles = 0;
  double geometricError =
      0;  // of the mesh: no point of it or of the full surface is farther from the other; model units
  uint32_t firstGeometryPage = kNone;  // pages of the mesh, by part
  uint32_t geometryPageCount = 0;
  uint32_t firstViewPage = kNone;  // pages of views, by rising group; kNone when no views were kept
  uint32_t viewPageCount = 0;
  // Pages of the atlases of a leaf, by rising group; kNone when it has none. They may be those of a cell before it
  // whose atlases are the same: PageRecord::cell says whose they are.
  uint32_t firstTexturePage = kNone;
  uint32_t texturePageCount = 0;
  ViewForm form = {};      // of its views, also where it has none
  ErrorTable errors = {};  // of its mesh and of its views, where they are there and were measured
};

// A mesh of more triangles than fit in one page is cut into parts: each but the last has exactly as many as these.
inline constexpr uint64_t kPartTriangles = uint64_t{1} << 17;
inline uint64_t partCount(uint64_t triangles) { return (triangles + kPartTriangles - 1) / kPartTriangles; }
inline uint64_t partTriangles(uint64_t triangles, uint64_t part) {
  return std::min(kPartTriangles, triangles - part * kPartTriangles);
}

// How the input was taken and what the build made of it; contract of `build --json` and `info --json`.
struct BuildReport {
  uint64_t inputTriangles = 0;  // accepted, after triangulation
  uint64_t inputVertices = 0;
  std::map<std::string, uint64_t> skipped;  // triangles by reason
  uint64_t viewsBaked = 0;
  uint64_t viewsKept = 0;
  std::map<std::string, uint64_t> viewsLeftOut;  // by reason
  std::map<std::string, uint64_t> bytesLeftOut;  // by the same reasons: what those of them that were coded would take
  uint64_t impostorBytes = 0;                    // stored
  uint64_t impostorRawBytes = 0;                 // cropped, before coding
  uint64_t geometryBytes = 0;                    // stored
  uint64_t textureBytes = 0;                     // stored
  bool operator==(const BuildReport&) const = default;
};

// Cells lie in order of level, then Morton code: the root first, children after parents.
struct Directory {
  Model model;
  std::string sourceName;   // file name of the mesh or scene, of several the first, without its path
  uint64_t sourceHash = 0;  // of the files it was built from, see FORMAT.md
  BuildReport report;
  std::vector<CellRecord> cells;
  std::vector<PageRecord> pages;  // by rising offset
};

}  // namespace farcell
