#include "preprocess/partition/record_format.h"

#include "cache/schema/model.h"

namespace farcell {
namespace {

constexpr uint32_t kAlbedo = kDefaultAlbedo[0] | kDefaultAlbedo[1] << 8 | kDefaultAlbedo[2] << 16;

template <class T>
void putNext(const T& value, std::byte*& at) {
  std::memcpy(at, &value, sizeof(T));
  at += sizeof(T);
}

template <class T>
void getNext(T& value, const std::byte*& at) {
  std::memcpy(&value, at, sizeof(T));
  at += sizeof(T);
}

}  // namespace

void RecordFormat::put(const GridTriangle& triangle, const TriangleTexture& texture, std::byte* record) const {
  std::array<uint32_t, 9> words;
  for (int i = 0; i < 9; ++i) {
    const uint32_t channel = triangle.colours[i / 3] >> 8 * (i % 3) & 0xff;
    words[i] = static_cast<uint32_t>(triangle.corners[i / 3][i % 3]) | channel << 24;
  }
  putNext(words, record);
  if (normals) putNext(triangle.normals, record);
  if (textures) putNext(texture, record);
}

GridTriangle RecordFormat::triangle(const std::byte* record) const {
  GridTriangle triangle;
  triangle.colours.fill(colours ? 0 : kAlbedo);
  triangle.normals.fill(0);
  std::array<uint32_t, 9> words;
  getNext(words, record);
  for (int i = 0; i < 9; ++i) {
    triangle.corners[i / 3][i % 3] = static_cast<int32_t>(words[i] & kCoordinateMask);
    if (colours) triangle.colours[i / 3] |= words[i] >> 24 << 8 * (i % 3);
  }
  if (normals) getNext(triangle.normals, record);
  return triangle;
}

TriangleTexture RecordFormat::texture(const std::byte* record) const {
  TriangleTexture texture;
  if (textures) std::memcpy(&texture, record + bytes() - sizeof(texture), sizeof(texture));
  return texture;
}

}  // namespace farcell
