#include "preprocess/read/ply/ply_vertices.h"

#include <cmath>

#include "preprocess/read/ply/ply_lists.h"

namespace farcell {
namespace {

std::optional<std::array<size_t, 3>> findColumns(const PlyElement& element, std::array<std::string_view, 3> names) {
  std::array<size_t, 3> columns{};
  for (size_t i = 0; i < 3; ++i) {
    const std::optional<size_t> column = element.find(names[i]);
    if (!column || element.properties[*column].countType) return std::nullopt;
    columns[i] = *column;
  }
  return columns;
}

// What a full channel is in a type: 1 for reals, the largest value for the two unsigned types that are colours in
// practice; other integers hold bytes.
double fullChannel(PlyType type) {
  if (isReal(type)) return 1;
  return type == PlyType::uint16 ? 65535 : 255;
}

// A row's values that are used, in the order x y z, r g b, nx ny nz; 0 for what is not there.
using RowValues = std::array<double, 9>;
// For each property of the element: where its value goes, or kUnused.
using Targets = std::vector<uint8_t>;
constexpr uint8_t kUnused = 255;

Targets targetsOf(const PlyElement& element, const PlyVertexLayout& layout) {
  Targets targets(element.properties.size(), kUnused);
  const auto set = [&](const std::array<size_t, 3>& columns, uint8_t first) {
    for (size_t i = 0; i < 3; ++i) targets[columns[i]] = static_cast<uint8_t>(first + i);
  };
  if (layout.colour) set(*layout.colour, 3);
  if (layout.normal) set(*layout.normal, 6);
  set(layout.position, 0);
  return targets;
}

template <class Source>
bool readRow(Source& source, const PlyElement& element, const Targets& targets, RowValues& values) {
  for (size_t i = 0; i < targets.size(); ++i) {
    const PlyProperty& property = element.properties[i];
    const bool read =
        targets[i] == kUnused ? skipProperty(source, property) : source.real(property.type, values[targets[i]]);
    if (!read) return false;
  }
  return true;
}

Vertices allocate(const PlyElement& element, const PlyVertexLayout& layout) {
  Vertices vertices;
  const auto count = static_cast<size_t>(element.count);
  vertices.isWide = layout.isWide;
  (layout.isWide ? vertices.wide.reserve(count) : vertices.narrow.reserve(count));
  if (layout.colour) vertices.colours.reserve(count);
  if (layout.normal) vertices.normals.reserve(count);
  return vertices;
}

}  // namespace

Result<PlyVertexLayout> plyVertexLayout(const InputFile& file, const PlyElement& element) {
  PlyVertexLayout layout;
  const auto position = findColumns(element, {"x", "y", "z"});
  if (!position)
    return corrupt(file.path(), 0, "properties x, y and z of element 'vertex', one number each",
                   fmt::format("{} properties without them", element.properties.size()));
  layout.position = *position;
  layout.colour = findColumns(element, {"red", "green", "blue"});
  layout.normal = findColumns(element, {"nx", "ny", "nz"});
  for (const size_t column : layout.position) {
    const PlyType type = element.properties[column].type;
    layout.isWide |= type == PlyType::float64 || type == PlyType::int32 || type == PlyType::uint32;
  }
  return layout;
}

template <class Source>
Result<Vertices> readPlyVertices(Source& source, const PlyElement& element, const PlyVertexLayout& layout) {
  Vertices vertices = allocate(element, layout);
  const Targets targets = targetsOf(element, layout);
  std::array<double, 3> colourScale{};
  for (size_t i = 0; layout.colour && i < 3; ++i)
    colourScale[i] = 1 / fullChannel(element.properties[(*layout.colour)[i]].type);
  RowValues v{};
  for (uint64_t row = 0; row < element.count; ++row) {
    if (!readRow(source, element, targets, v))
      return tl::unexpected<Error>(source.error(fmt::format("row {} of {} of element 'vertex'", row, element.count)));
    vertices.allFinite &= std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
    if (layout.isWide)
      vertices.wide.emplace_back(v[0], v[1], v[2]);
    else
      vertices.narrow.emplace_back(static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]));
    if (layout.colour)
      vertices.colours.push_back(packColour(v[3] * colourScale[0], v[4] * colourScale[1], v[5] * colourScale[2]));
    if (layout.normal)
      vertices.normals.emplace_back(static_cast<float>(v[6]), static_cast<float>(v[7]), static_cast<float>(v[8]));
  }
  return vertices;
}

template Result<Vertices> readPlyVertices(PlyBinarySource<false>&, const PlyElement&, const PlyVertexLayout&);
template Result<Vertices> readPlyVertices(PlyBinarySource<true>&, const PlyElement&, const PlyVertexLayout&);
template Result<Vertices> readPlyVertices(PlyTextSource&, const PlyElement&, const PlyVertexLayout&);

}  // namespace farcell
