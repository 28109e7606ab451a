#include "preprocess/mesh/vertices.h"

#include <array>

#include "cache/schema/model.h"

namespace farcell {
namespace {
uint32_t byteFromUnit(double value) {
  if (!(value > 0)) return 0;
  return value >= 1 ? 255u : static_cast<uint32_t>(value * 255 + 0.5);
}
constexpr VertexShape kWidest{true, true, true, true};
}  // namespace

void VertexShape::put(const Vertex& vertex, std::byte* row) const {
  if (isWide) {
    std::memcpy(row, &vertex.position, sizeof(glm::dvec3));
  } else {
    const glm::vec3 rounded(vertex.position);
    std::memcpy(row, &rounded, sizeof(rounded));
  }
  if (hasColours) std::memcpy(row + positionBytes(), &vertex.colour, sizeof(vertex.colour));
  if (hasNormals) std::memcpy(row + normalOffset(), &vertex.normal, sizeof(vertex.normal));
  if (hasTextureCoordinates)
    std::memcpy(row + textureOffset(), &vertex.textureCoordinates, sizeof(vertex.textureCoordinates));
}

Result<Vertices> Vertices::loaded(std::shared_ptr<ReadMemory> memory, VertexShape shape, uint64_t count,
                                  PagedRows::Load load) {
  FARCELL_ASSIGN(auto rows, PagedRows::loaded(std::move(memory), shape.rowBytes(), count, std::move(load)));
  return Vertices(shape, std::move(rows));
}

Result<> Vertices::append(const Vertex& vertex) {
  std::array<std::byte, kWidest.rowBytes()> row;
  shape_.put(vertex, row.data());
  return rows_->append(row.data());
}

Result<> Vertices::recolour(const std::function<uint32_t(uint32_t)>& colourOf) {
  FARCELL_CHECK(shape_.hasColours);
  for (uint64_t i = 0; i < count() && !failure(); ++i) {
    const uint32_t before = load<uint32_t>(rows_->row(i) + shape_.positionBytes());
    const uint32_t after = colourOf(before);
    if (after != before) std::memcpy(rows_->change(i) + shape_.positionBytes(), &after, sizeof(after));
  }
  if (failure()) return tl::unexpected<Error>(*failure());
  return {};
}

uint32_t packColour(double red, double green, double blue) {
  return byteFromUnit(red) | byteFromUnit(green) << 8 | byteFromUnit(blue) << 16;
}

uint32_t defaultColour() {
  return uint32_t{kDefaultAlbedo[0]} | uint32_t{kDefaultAlbedo[1]} << 8 | uint32_t{kDefaultAlbedo[2]} << 16;
}

}  // namespace farcell
