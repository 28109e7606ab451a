// Cells to time bakers on, in cell-local coordinates.
#pragma once

#include <filesystem>
#include <string>

#include "cache/base/result.h"
#include "preprocess/bake/view_baker.h"

namespace farcell::bench {

struct BenchCell {
  std::string name;
  CellSoup soup;
};

// A mesh file scaled into [-1, 1]^3 and simplified to about `triangles`, colours varying from vertex to vertex.
Result<BenchCell> statueCell(const std::filesystem::path& path, size_t triangles);
// A wavy sheet of 2 x edge x edge triangles across the cube: nearly all of them are seen, colours vary.
BenchCell reliefCell(int edge);
// Axis-aligned blocks on a ground plane, 12 triangles each, most many texels large, one colour a block; and the ground.
BenchCell blockCell(int blocks);

}  // namespace farcell::bench
