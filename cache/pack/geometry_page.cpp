// The coding of a page of triangles; FORMAT.md, "Page of geometry".
#include <algorithm>

#include "cache/base/check.h"
#include "cache/pack/bytes.h"
#include "cache/pack/connectivity.h"
#include "cache/pack/pages.h"
#include "cache/pack/words.h"
#include "cache/pack/zlib_stream.h"

namespace farcell {
namespace {

constexpr int kGeometryZlibLevel = 4;  // 6: 1 to 2 % fewer bytes (tests/bench/codec/results.md)
constexpr uint64_t kPageHeaderBytes = 16;
constexpr uint32_t kHasColours = 1;
constexpr uint32_t kHasNormals = 2;
constexpr uint32_t kHasCoordinates = 4;
constexpr uint32_t kHasShown = 8;
constexpr uint32_t kCoordinateBits = 16;
constexpr uint32_t kMaxCoordinate = (1u << kCoordinateBits) - 1;  // on an atlas

struct Header {
  uint32_t vertexCount = 0;
  uint32_t triangleCount = 0;
  uint32_t flags = 0;
  uint32_t payloadBytes = 0;
};

uint64_t wordsPerVertex(const Header& header) {
  return 3u + ((header.flags & kHasColours) != 0) + ((header.flags & kHasNormals) != 0) +
         ((header.flags & kHasCoordinates) != 0);
}

// Both coordinates on an atlas are sequences of their own.
uint64_t codedWordsPerVertex(const Header& header) {
  return wordsPerVertex(header) + ((header.flags & kHasCoordinates) != 0);
}

uint64_t decodedBytes(const Header& header) {
  const uint64_t wordsPerTriangle = 3u + ((header.flags & kHasShown) != 0);
  return 4 * (wordsPerVertex(header) * header.vertexCount + wordsPerTriangle * header.triangleCount);
}

// Component-major: every x, then every y, then every z.
std::vector<uint32_t> componentsOf(std::span<const glm::uvec3> positions) {
  std::vector<uint32_t> words;
  words.reserve(3 * positions.size());
  for (int axis = 0; axis < 3; ++axis)
    for (const glm::uvec3& position : positions) words.push_back(position[axis]);
  return words;
}

Result<std::vector<glm::uvec3>> positionsOf(std::span<const uint32_t> words, uint32_t maxCoordinate) {
  const size_t count = words.size() / 3;
  std::vector<glm::uvec3> positions(count);
  for (size_t i = 0; i < count; ++i) {
    const glm::uvec3 p(words[i], words[count + i], words[2 * count + i]);
    if (std::max({p.x, p.y, p.z}) > maxCoordinate)
      return fail(ErrorKind::corrupt, "vertex {}: expected coordinates up to {}, found {}, {}, {}", i, maxCoordinate,
                  p.x, p.y, p.z);
    positions[i] = p;
  }
  return positions;
}

// Every u, then every v.
std::vector<uint32_t> componentsOf(std::span<const uint32_t> coordinates) {
  std::vector<uint32_t> words;
  words.reserve(2 * coordinates.size());
  for (const uint32_t pair : coordinates) words.push_back(pair & kMaxCoordinate);
  for (const uint32_t pair : coordinates) words.push_back(pair >> kCoordinateBits);
  return words;
}

Result<std::vector<uint32_t>> coordinatesOf(std::span<const uint32_t> words) {
  const size_t count = words.size() / 2;
  std::vector<uint32_t> coordinates(count);
  for (size_t i = 0; i < count; ++i) {
    const uint32_t u = words[i], v = words[count + i];
    if (std::max(u, v) > kMaxCoordinate)
      return fail(ErrorKind::corrupt, "vertex {}: expected texture coordinates up to {}, found {}, {}", i,
                  kMaxCoordinate, u, v);
    coordinates[i] = u | v << kCoordinateBits;
  }
  return coordinates;
}

tl::unexpected<Error> wrong(uint64_t offset, const std::string& expected, const std::string& found) {
  return fail(ErrorKind::corrupt, "byte {} of the page: expected {}, found {}", offset, expected, found);
}

Result<Header> readHeader(std::span<const std::byte> bytes, const GeometryLimits& limits) {
  ByteReader in(bytes);
  const Header header{in.u32(), in.u32(), in.u32(), in.u32()};
  if (!in.ok()) return wrong(0, fmt::format("{} bytes", kPageHeaderBytes), fmt::format("{}", bytes.size()));
  constexpr uint32_t kFlags = kHasColours | kHasNormals | kHasCoordinates | kHasShown;
  if ((header.flags & ~kFlags) != 0) return wrong(8, "flags 0 to 15", fmt::format("{}", header.flags));
  if (decodedBytes(header) > limits.maxDecodedBytes)
    return wrong(0, fmt::format("vertices and triangles of at most {} bytes", limits.maxDecodedBytes),
                 fmt::format("{}", decodedBytes(header)));
  // Each triangle is 1 to 13 bytes of payload, each word of a vertex 1 to 5.
  const uint64_t shown = (header.flags & kHasShown) != 0 ? header.triangleCount : 0;
  const uint64_t vertexWords = codedWordsPerVertex(header) * header.vertexCount + shown;
  const uint64_t least = header.triangleCount + vertexWords;
  const uint64_t most = std::min(13 * uint64_t{header.triangleCount} + 5 * vertexWords, in.remaining() * kMaxZlibRatio);
  if (header.payloadBytes < least || header.payloadBytes > most)
    return wrong(12, fmt::format("a payload of {} to {} bytes", least, most), fmt::format("{}", header.payloadBytes));
  return header;
}

Result<GeometryPage> decodePayload(std::span<const std::byte> payload, const Header& header, uint32_t maxCoordinate) {
  ByteReader in(payload);
  GeometryPage page;
  const std::span<const std::byte> triangleCodes = in.take(header.triangleCount);
  FARCELL_ASSIGN(const size_t corners, cornerCount(triangleCodes));
  const std::vector<uint32_t> cornerCodes = readPlanes(in, corners);
  if (!in.ok()) return fail(ErrorKind::corrupt, "expected {} corners, found too few bytes", corners);
  FARCELL_ASSIGN(DecodedTriangles triangles, decodedTriangles(triangleCodes, cornerCodes, header.vertexCount));
  page.indices = std::move(triangles.indices);
  FARCELL_ASSIGN(const std::vector<uint32_t> components,
                 readSequences(in, header.vertexCount, 3, Lanes::one, triangles.parallelograms));
  FARCELL_ASSIGN(page.positions, positionsOf(components, maxCoordinate));
  if ((header.flags & kHasColours) != 0) {
    FARCELL_ASSIGN(page.colours, readSequences(in, header.vertexCount, 1, Lanes::four));
  }
  if ((header.flags & kHasNormals) != 0) {
    FARCELL_ASSIGN(page.normals, readSequences(in, header.vertexCount, 1, Lanes::two));
  }
  if ((header.flags & kHasCoordinates) != 0) {
    FARCELL_ASSIGN(const std::vector<uint32_t> words,
                   readSequences(in, header.vertexCount, 2, Lanes::one, triangles.parallelograms));
    FARCELL_ASSIGN(page.coordinates, coordinatesOf(words));
  }
  if ((header.flags & kHasShown) != 0) {
    FARCELL_ASSIGN(page.shown, readSequences(in, header.triangleCount, 1, Lanes::four));
  }
  if (in.remaining() != 0)
    return fail(ErrorKind::corrupt, "expected a payload of {} bytes, found {}", in.position(), payload.size());
  return page;
}

void checkValid(const GeometryPage& page) {
  FARCELL_CHECK(page.indices.size() % 3 == 0 && page.indices.size() / 3 <= UINT32_MAX);
  FARCELL_CHECK(page.positions.size() <= UINT32_MAX);
  FARCELL_CHECK(page.colours.empty() || page.colours.size() == page.positions.size());
  FARCELL_CHECK(page.normals.empty() || page.normals.size() == page.positions.size());
  FARCELL_CHECK(page.shown.empty() || page.shown.size() == page.indices.size() / 3);
  FARCELL_CHECK(page.coordinates.empty() || page.coordinates.size() == page.positions.size());
  for (const uint32_t index : page.indices) FARCELL_CHECK(index < page.positions.size());
}

}  // namespace

std::vector<std::byte> encodeGeometryPage(const GeometryPage& page) {
  checkValid(page);
  ByteWriter payload;
  const ConnectivityCodes codes = codedTriangles(page.indices, page.positions.size());
  payload.append(std::as_bytes(std::span(codes.triangles)));
  writePlanes(payload, codes.corners);
  writeSequences(payload, componentsOf(page.positions), 3, Lanes::one, codes.parallelograms);
  if (!page.colours.empty()) writeSequences(payload, page.colours, 1, Lanes::four);
  if (!page.normals.empty()) writeSequences(payload, page.normals, 1, Lanes::two);
  if (!page.coordinates.empty())
    writeSequences(payload, componentsOf(page.coordinates), 2, Lanes::one, codes.parallelograms);
  if (!page.shown.empty()) writeSequences(payload, page.shown, 1, Lanes::four);
  FARCELL_CHECK(payload.bytes.size() <= UINT32_MAX);

  ByteWriter out;
  out.u32(static_cast<uint32_t>(page.positions.size()));
  out.u32(static_cast<uint32_t>(page.indices.size() / 3));
  out.u32((page.colours.empty() ? 0 : kHasColours) | (page.normals.empty() ? 0 : kHasNormals) |
          (page.coordinates.empty() ? 0 : kHasCoordinates) | (page.shown.empty() ? 0 : kHasShown));
  out.u32(static_cast<uint32_t>(payload.bytes.size()));
  out.append(zlibCompress(payload.bytes, kGeometryZlibLevel));
  return std::move(out.bytes);
}

Result<std::vector<std::byte>> smallerGeometryPage(std::span<const std::byte> bytes, const GeometryLimits& limits) {
  FARCELL_ASSIGN(const Header header, readHeader(bytes, limits));
  std::vector<std::byte> payload(header.payloadBytes);
  FARCELL_TRY(zlibDecompress(bytes.subspan(kPageHeaderBytes), payload));
  const std::vector<std::byte> stream = zlibCompress(payload, kSlowestZlibLevel);
  ByteWriter out;
  out.append(bytes.first(kPageHeaderBytes));
  out.append(kPageHeaderBytes + stream.size() < bytes.size() ? stream : bytes.subspan(kPageHeaderBytes));
  return std::move(out.bytes);
}

Result<GeometryPage> decodeGeometryPage(std::span<const std::byte> bytes, const GeometryLimits& limits) {
  FARCELL_ASSIGN(const Header header, readHeader(bytes, limits));
  std::vector<std::byte> payload(header.payloadBytes);
  Result<GeometryPage> page = zlibDecompress(bytes.subspan(kPageHeaderBytes), payload).and_then([&] {
    return decodePayload(payload, header, limits.maxCoordinate);
  });
  if (!page) return fail(ErrorKind::corrupt, "byte {} of the page: {}", kPageHeaderBytes, page.error().message);
  return page;
}

uint32_t decodedSizeBytes(const GeometryPage& page) {
  const uint64_t words = 3 * uint64_t{page.positions.size()} + page.colours.size() + page.normals.size() +
                         page.coordinates.size() + page.indices.size() + page.shown.size();
  FARCELL_CHECK(4 * words <= UINT32_MAX);
  return static_cast<uint32_t>(4 * words);
}

}  // namespace farcell
