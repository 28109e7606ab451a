#include "datasets/ply/ply_output.h"

#include <bit>
#include <cstring>
#include <limits>

namespace farcell {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr size_t kColourBytes = 3;
constexpr size_t kFaceBytes = 13;

size_t vertexBytes(bool isWide) { return 3 * (isWide ? sizeof(double) : sizeof(float)) + kColourBytes; }

template <class Scalar>
void putVertex(const PlyVertex& vertex, std::byte* at) {
  const std::array<Scalar, 3> position = {static_cast<Scalar>(vertex.position.x),
                                          static_cast<Scalar>(vertex.position.y),
                                          static_cast<Scalar>(vertex.position.z)};
  std::memcpy(at, position.data(), sizeof(position));
  std::memcpy(at + sizeof(position), vertex.colour.data(), kColourBytes);
}

}  // namespace

Result<> checkPlyLayout(const PlyLayout& layout) {
  constexpr uint64_t kMaxVertices = std::numeric_limits<uint32_t>::max();
  if (layout.vertices <= kMaxVertices) return {};
  return fail(ErrorKind::unsupported, "{} triangles have {} vertices; a PLY file can name at most {}", layout.triangles,
              layout.vertices, kMaxVertices);
}

std::string plyHeader(const PlyLayout& layout) {
  constexpr uint64_t kMaxInt = std::numeric_limits<int32_t>::max();
  const char* scalar = layout.isWide ? "double" : "float";
  return fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment {}\nelement vertex {}\nproperty {} x\nproperty {} y\n"
      "property {} z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
      "element face {}\nproperty list uchar {} vertex_indices\nend_header\n",
      layout.comment, layout.vertices, scalar, scalar, scalar, layout.triangles,
      layout.vertices > kMaxInt ? "uint" : "int");
}

uint64_t plyBytes(const PlyLayout& layout) {
  return plyHeader(layout).size() + layout.vertices * vertexBytes(layout.isWide) + layout.triangles * kFaceBytes;
}

void putPlyVertices(std::span<const PlyVertex> vertices, bool isWide, std::vector<std::byte>& out) {
  const size_t stride = vertexBytes(isWide);
  const size_t start = out.size();
  out.resize(start + vertices.size() * stride);
  std::byte* at = out.data() + start;
  for (const PlyVertex& vertex : vertices) {
    if (isWide) putVertex<double>(vertex, at);
    if (!isWide) putVertex<float>(vertex, at);
    at += stride;
  }
}

void putPlyFaces(std::span<const std::array<uint32_t, 3>> faces, uint64_t firstVertex, std::vector<std::byte>& out) {
  const size_t start = out.size();
  out.resize(start + faces.size() * kFaceBytes);
  std::byte* at = out.data() + start;
  for (std::array<uint32_t, 3> face : faces) {
    for (uint32_t& index : face) index += static_cast<uint32_t>(firstVertex);
    *at = std::byte{3};
    std::memcpy(at + 1, face.data(), sizeof(face));
    at += kFaceBytes;
  }
}

}  // namespace farcell
