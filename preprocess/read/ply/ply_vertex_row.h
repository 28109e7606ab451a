// One row of the vertex element of a PLY file: which of its properties are used, and what they make of a vertex.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "preprocess/mesh/vertices.h"
#include "preprocess/read/ply/ply_source.h"

namespace farcell {

class PlyVertexRow {
 public:
  // A row's values that are used, in the order x y z, r g b, nx ny nz; 0 for what is not there.
  using Values = std::array<double, 9>;

  // Colours: red, green, blue, any integer, or a real in 0..1. corrupt when x, y or z is missing or a list.
  static Result<PlyVertexRow> of(const InputFile& file, const PlyElement& element);

  const VertexShape& shape() const { return shape_; }
  uint64_t fileRowBytes() const { return fileRowBytes_; }  // REQUIRES, as decode does: an element without lists
  // Which of the values a property gives; none where it is not used.
  std::optional<size_t> target(size_t property) const;
  Vertex vertex(const Values& values) const;
  // `count` rows of a binary file, one after the other, as rows of Vertices.
  template <bool kSwap>
  void decode(const std::byte* in, size_t count, std::byte* out) const;

 private:
  // A value in the file's rows.
  struct Column {
    size_t property = 0;
    size_t offset = 0;
    PlyType type = PlyType::float32;
  };
  using Columns = std::array<Column, 3>;

  static std::optional<Columns> findColumns(const PlyElement& element, std::array<std::string_view, 3> names);
  bool isPlain() const;
  void copyPlain(const std::byte* in, size_t count, std::byte* out) const;
  template <bool kSwap>
  void load(const std::byte* in, const Columns& columns, double* values) const;

  Columns position_;
  std::optional<Columns> colour_;
  std::optional<Columns> normal_;
  std::array<double, 3> colourScale_{};
  VertexShape shape_;
  uint64_t fileRowBytes_ = 0;
};

}  // namespace farcell
