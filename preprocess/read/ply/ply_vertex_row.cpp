#include "preprocess/read/ply/ply_vertex_row.h"

namespace farcell {
namespace {

// What a full channel is in a type: 1 for reals, the largest value for the two unsigned types that are colours in
// practice; other integers hold bytes.
double fullChannel(PlyType type) {
  if (isReal(type)) return 1;
  return type == PlyType::uint16 ? 65535 : 255;
}

}  // namespace

std::optional<PlyVertexRow::Columns> PlyVertexRow::findColumns(const PlyElement& element,
                                                               std::array<std::string_view, 3> names) {
  Columns columns;
  for (size_t i = 0; i < 3; ++i) {
    const std::optional<size_t> found = element.find(names[i]);
    if (!found || element.properties[*found].countType) return std::nullopt;
    columns[i] = {*found, 0, element.properties[*found].type};
    for (size_t before = 0; before < *found; ++before) columns[i].offset += sizeBytes(element.properties[before].type);
  }
  return columns;
}

Result<PlyVertexRow> PlyVertexRow::of(const InputFile& file, const PlyElement& element) {
  PlyVertexRow row;
  const std::optional<Columns> position = findColumns(element, {"x", "y", "z"});
  if (!position)
    return corrupt(file.path(), 0, "properties x, y and z of element 'vertex', one number each",
                   fmt::format("{} properties without them", element.properties.size()));
  row.position_ = *position;
  row.colour_ = findColumns(element, {"red", "green", "blue"});
  row.normal_ = findColumns(element, {"nx", "ny", "nz"});
  row.shape_.hasColours = row.colour_.has_value();
  row.shape_.hasNormals = row.normal_.has_value();
  for (const Column& column : row.position_)
    row.shape_.isWide |= column.type == PlyType::float64 || column.type == PlyType::int32 ||
                         column.type == PlyType::uint32;  // what does not fit a float
  for (size_t i = 0; row.colour_ && i < 3; ++i) row.colourScale_[i] = 1 / fullChannel((*row.colour_)[i].type);
  row.fileRowBytes_ = element.rowBytes();
  return row;
}

std::optional<size_t> PlyVertexRow::target(size_t property) const {
  for (size_t i = 0; i < 3; ++i) {
    if (position_[i].property == property) return i;
    if (colour_ && (*colour_)[i].property == property) return 3 + i;
    if (normal_ && (*normal_)[i].property == property) return 6 + i;
  }
  return std::nullopt;
}

Vertex PlyVertexRow::vertex(const Values& v) const {
  Vertex vertex;
  vertex.position = glm::dvec3(v[0], v[1], v[2]);
  if (colour_) vertex.colour = packColour(v[3] * colourScale_[0], v[4] * colourScale_[1], v[5] * colourScale_[2]);
  if (normal_) vertex.normal = glm::vec3(glm::dvec3(v[6], v[7], v[8]));
  return vertex;
}

// Whether the values stand in the file as in the row: floats side by side, and three bytes of a colour.
bool PlyVertexRow::isPlain() const {
  const auto areSideBySide = [](const Columns& columns, PlyType type) {
    const size_t step = sizeBytes(type);
    return columns[0].type == type && columns[1].type == type && columns[2].type == type &&
           columns[1].offset == columns[0].offset + step && columns[2].offset == columns[1].offset + step;
  };
  return areSideBySide(position_, PlyType::float32) && (!colour_ || areSideBySide(*colour_, PlyType::uint8)) &&
         (!normal_ || areSideBySide(*normal_, PlyType::float32));
}

void PlyVertexRow::copyPlain(const std::byte* in, size_t count, std::byte* out) const {
  const size_t rowBytes = shape_.rowBytes();
  for (size_t i = 0; i < count; ++i, in += fileRowBytes_, out += rowBytes) {
    std::memcpy(out, in + position_[0].offset, sizeof(glm::vec3));
    if (colour_) {
      const std::byte* channels = in + (*colour_)[0].offset;
      const auto channel = [&](size_t c) { return std::to_integer<uint32_t>(channels[c]) << (8 * c); };
      const uint32_t colour = channel(0) | channel(1) | channel(2);
      std::memcpy(out + sizeof(glm::vec3), &colour, sizeof(colour));
    }
    if (normal_) std::memcpy(out + shape_.normalOffset(), in + (*normal_)[0].offset, sizeof(glm::vec3));
  }
}

template <bool kSwap>
void PlyVertexRow::load(const std::byte* in, const Columns& columns, double* values) const {
  for (size_t i = 0; i < 3; ++i) values[i] = loadAs<double, kSwap>(columns[i].type, in + columns[i].offset);
}

template <bool kSwap>
void PlyVertexRow::decode(const std::byte* in, size_t count, std::byte* out) const {
  if (!kSwap && isPlain()) return copyPlain(in, count, out);
  Values values{};
  for (size_t i = 0; i < count; ++i, in += fileRowBytes_, out += shape_.rowBytes()) {
    load<kSwap>(in, position_, &values[0]);
    if (colour_) load<kSwap>(in, *colour_, &values[3]);
    if (normal_) load<kSwap>(in, *normal_, &values[6]);
    shape_.put(vertex(values), out);
  }
}
template void PlyVertexRow::decode<false>(const std::byte*, size_t, std::byte*) const;
template void PlyVertexRow::decode<true>(const std::byte*, size_t, std::byte*) const;

}  // namespace farcell
