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
  putNext(triangle.corners, record);
  if (colours) putNext(triangle.colours, record);
  if (normals) putNext(triangle.normals, record);
  if (textures) putNext(texture, record);
}

GridTriangle RecordFormat::triangle(const std::byte* record) const {
  GridTriangle triangle;
  triangle.colours.fill(kAlbedo);
  triangle.normals.fill(0);
  getNext(triangle.corners, record);
  if (colours) getNext(triangle.colours, record);
  if (normals) getNext(triangle.normals, record);
  return triangle;
}

TriangleTexture RecordFormat::texture(const std::byte* record) const {
  TriangleTexture texture;
  if (textures) std::memcpy(&texture, record + bytes() - sizeof(texture), sizeof(texture));
  return texture;
}

}  // namespace farcell
