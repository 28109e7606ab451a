#include "preprocess/read/gltf/draco_mesh.h"

#ifdef FARCELL_HAS_DRACO
#include <draco/compression/decode.h>

#include <cstring>
#endif

namespace farcell {

#ifndef FARCELL_HAS_DRACO

const bool kHasDraco = false;

Result<> decodeDraco(const GltfPlace& place, const ByteRange&, GltfBuffers&, DracoMesh&) {
  return place.failed(ErrorKind::unsupported, "a build with libdraco", "a primitive compressed by it");
}

#else

const bool kHasDraco = true;

namespace {

// Draco allocates by what the bytes claim: 71 bytes a face with positions alone. No ratio is sure; a flat grid of two
// million triangles reaches 40 faces a byte, and this is far beyond it.
constexpr uint64_t kFreeFaces = uint64_t{1} << 16;
constexpr uint64_t kMaxFacesPerByte = 256;
constexpr uint64_t kDecoderBytesPerFace = 112;  // with normals and texture coordinates
constexpr uint64_t kMaxFaces = uint64_t{16} << 20;

struct DracoClaims {
  uint64_t faces = 0;
  std::optional<uint64_t> points;  // of the sequential method; the other one finds out while it decodes
};

// The start of a stream of version 2.2, the one that glTF allows: what it claims before anything is allocated.
class DracoHeader {
 public:
  explicit DracoHeader(std::span<const std::byte> bytes) : rest_(bytes) {}

  // None when this is no such stream.
  std::optional<DracoClaims> claims() {
    constexpr std::array<uint8_t, 8> kStart = {'D', 'R', 'A', 'C', 'O', 2, 2, 1};  // a triangle mesh
    constexpr int kSequential = 0;
    constexpr int kEdgebreaker = 1;
    for (const uint8_t expected : kStart)
      if (byte() != expected) return std::nullopt;
    const int method = byte();
    if (byte() != 0 || byte() != 0) return std::nullopt;  // flags: no metadata
    if (method != kSequential && method != kEdgebreaker) return std::nullopt;
    if (method == kEdgebreaker && (byte() < 0 || !varint())) return std::nullopt;  // kind of traversal, vertices
    const std::optional<uint64_t> faces = varint();
    const std::optional<uint64_t> points = method == kSequential ? varint() : std::nullopt;
    if (!faces || (method == kSequential && !points)) return std::nullopt;
    return DracoClaims{*faces, points};
  }

 private:
  int byte() {
    if (rest_.empty()) return -1;
    const int value = std::to_integer<int>(rest_.front());
    rest_ = rest_.subspan(1);
    return value;
  }
  std::optional<uint64_t> varint() {
    uint64_t value = 0;
    for (int shift = 0; shift < 63; shift += 7) {
      const int next = byte();
      if (next < 0) return std::nullopt;
      value |= uint64_t(next & 0x7f) << shift;
      if (next < 0x80) return value;
    }
    return std::nullopt;
  }

  std::span<const std::byte> rest_;
};

Result<> checkClaims(const GltfPlace& place, std::span<const std::byte> coded, const DracoMesh& mesh) {
  const std::optional<DracoClaims> claims = DracoHeader(coded).claims();
  if (!claims) return place.bad("a triangle mesh of Draco 2.2 without metadata", "something else");
  if (claims->faces != mesh.faces || claims->points.value_or(mesh.points) != mesh.points)
    return place.bad(fmt::format("{} triangles of {} vertices", mesh.faces, mesh.points),
                     fmt::format("{} of {}", claims->faces, claims->points.value_or(mesh.points)));
  const uint64_t most = std::min(kMaxFaces, kFreeFaces + kMaxFacesPerByte * coded.size());
  if (mesh.faces > most || mesh.points > 3 * most)
    return place.failed(ErrorKind::exhausted, fmt::format("at most {} triangles in {} bytes", most, coded.size()),
                        fmt::format("{} of {} vertices", mesh.faces, mesh.points));
  return {};
}

std::optional<ComponentType> typeOf(draco::DataType type) {
  switch (type) {
    case draco::DT_INT8:
      return ComponentType::int8;
    case draco::DT_UINT8:
      return ComponentType::uint8;
    case draco::DT_INT16:
      return ComponentType::int16;
    case draco::DT_UINT16:
      return ComponentType::uint16;
    case draco::DT_FLOAT32:
      return ComponentType::float32;
    default:
      return std::nullopt;
  }
}

Result<> takeAttribute(const GltfPlace& place, const draco::Mesh& decoded, GltfBuffers& buffers,
                       DracoAttribute& attribute) {
  Elements& elements = attribute.elements;
  const draco::PointAttribute* found = decoded.GetAttributeByUniqueId(attribute.id);
  const bool fits = found && typeOf(found->data_type()) == elements.type &&
                    found->num_components() == static_cast<int>(elements.components);
  if (!fits)
    return place.bad(fmt::format("an attribute {} of the accessor's type", attribute.id), "none or another type");
  elements.stride = static_cast<uint32_t>(elements.elementBytes());
  FARCELL_ASSIGN(MemoryClaim room, buffers.claim(place, elements.count * elements.stride));
  std::vector<std::byte> bytes(room.sizeBytes());
  std::byte* out = bytes.data();
  for (draco::PointIndex point(0); point < decoded.num_points(); ++point, out += elements.stride) {
    const draco::AttributeValueIndex value = found->mapped_index(point);
    if (value.value() >= found->size()) return place.bad("an attribute value for each vertex", "fewer");
    std::memcpy(out, found->GetAddress(value), elements.stride);
  }
  elements.bytes = inMemory(std::move(room), std::move(bytes));
  return {};
}

Result<Elements> takeIndices(const GltfPlace& place, const draco::Mesh& decoded, GltfBuffers& buffers) {
  FARCELL_ASSIGN(MemoryClaim room, buffers.claim(place, uint64_t{decoded.num_faces()} * 3 * sizeof(uint32_t)));
  std::vector<std::byte> bytes(room.sizeBytes());
  std::byte* out = bytes.data();
  for (draco::FaceIndex face(0); face < decoded.num_faces(); ++face)
    for (const draco::PointIndex& corner : decoded.face(face)) {
      const uint32_t index = corner.value();
      std::memcpy(out, &index, sizeof(index));
      out += sizeof(index);
    }
  const uint64_t count = bytes.size() / sizeof(uint32_t);
  return Elements{
      inMemory(std::move(room), std::move(bytes)), count, sizeof(uint32_t), ComponentType::uint32, 1, false};
}

Result<> decodeChecked(const GltfPlace& place, std::span<const std::byte> coded, GltfBuffers& buffers,
                       DracoMesh& mesh) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(coded.data()), coded.size());
  draco::Decoder decoder;
  auto result = decoder.DecodeMeshFromBuffer(&buffer);
  if (!result.ok()) return place.bad("a mesh coded by Draco", inQuotes(result.status().error_msg_string()));
  const std::unique_ptr<draco::Mesh> decoded = std::move(result).value();
  if (decoded->num_points() != mesh.points || decoded->num_faces() != mesh.faces)
    return place.bad(fmt::format("{} vertices, {} triangles", mesh.points, mesh.faces),
                     fmt::format("{}, {}", decoded->num_points(), decoded->num_faces()));
  for (DracoAttribute& attribute : mesh.attributes) FARCELL_TRY(takeAttribute(place, *decoded, buffers, attribute));
  FARCELL_ASSIGN(mesh.indices, takeIndices(place, *decoded, buffers));
  return {};
}

}  // namespace

Result<> decodeDraco(const GltfPlace& place, const ByteRange& coded, GltfBuffers& buffers, DracoMesh& mesh) {
  FARCELL_ASSIGN(MemoryClaim codedRoom, buffers.claim(place, coded.size));
  std::vector<std::byte> bytes(coded.size);
  FARCELL_TRY(coded.read(bytes));
  FARCELL_TRY(checkClaims(place, bytes, mesh));
  FARCELL_ASSIGN(MemoryClaim decoderRoom, buffers.claim(place, mesh.faces * kDecoderBytesPerFace));
  try {
    return decodeChecked(place, bytes, buffers, mesh);
  } catch (const std::exception& exception) {  // it allocates by what it reads
    return place.bad("a mesh coded by Draco", inQuotes(exception.what()));
  }
}

#endif

}  // namespace farcell
