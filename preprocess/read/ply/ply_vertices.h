// The vertex element of a PLY file: which of its properties are used, and their values.
#pragma once

#include <array>
#include <optional>

#include "preprocess/mesh/vertices.h"
#include "preprocess/read/ply/ply_source.h"

namespace farcell {

// Columns of the element, by index into its properties.
struct PlyVertexLayout {
  std::array<size_t, 3> position{};
  std::optional<std::array<size_t, 3>> colour;  // red, green, blue: any integer, or a real in 0..1
  std::optional<std::array<size_t, 3>> normal;
  bool isWide = false;  // a coordinate's type does not fit a float
};

// corrupt when x, y or z is missing or a list.
Result<PlyVertexLayout> plyVertexLayout(const InputFile& file, const PlyElement& element);

// All rows of the element, starting at the source's place. Explicitly instantiated for the three sources.
template <class Source>
Result<Vertices> readPlyVertices(Source& source, const PlyElement& element, const PlyVertexLayout& layout);

}  // namespace farcell
