// The coding of a page of triangles; FORMAT.md, "Page of geometry".
#include <algorithm>

#include "cache/base/check.h"
#include "cache/pack/bytes.h"
#include "cache/pack/pages.h"
#include "cache/pack/zlib_stream.h"

namespace farcell {
namespace {

constexpr int kGeometryZlibLevel = 6;
constexpr uint64_t kHeaderBytes = 16;
constexpr uint32_t kHasColours = 1;
constexpr uint32_t kHasNormals = 2;

struct Header {
  uint32_t vertexCount = 0;
  uint32_t triangleCount = 0;
  uint32_t flags = 0;
  uint32_t reserved = 0;
};

// Bytes before deflate, which are also those of the decoded page.
uint64_t rawSizeBytes(const Header& header) {
  const uint64_t wordsPerVertex = 3 + ((header.flags & kHasColours) != 0) + ((header.flags & kHasNormals) != 0);
  return 4 * (wordsPerVertex * header.vertexCount + 3 * uint64_t{header.triangleCount});
}

// Small numbers of either sign to small numbers, and back.
uint32_t zigzag(uint32_t difference) { return difference << 1 ^ (0u - (difference >> 31)); }
uint32_t unzigzag(uint32_t code) { return code >> 1 ^ (0u - (code & 1)); }

// Words are stored as four planes: all lowest bytes, ..., all highest bytes.
void writeWords(std::span<const uint32_t> words, std::byte* out) {
  for (size_t plane = 0; plane < 4; ++plane)
    for (const uint32_t word : words) *out++ = static_cast<std::byte>(word >> (8 * plane) & 0xff);
}

std::vector<uint32_t> readWords(std::span<const std::byte> planes) {
  const size_t count = planes.size() / 4;
  std::vector<uint32_t> words(count);
  for (size_t plane = 0; plane < 4; ++plane)
    for (size_t i = 0; i < count; ++i)
      words[i] |= std::to_integer<uint32_t>(planes[plane * count + i]) << (8 * plane);
  return words;
}

// Distance below the next vertex not yet used: in an order of first use, 0 names a new vertex and small numbers recent
// ones.
std::vector<uint32_t> codedIndices(std::span<const uint32_t> indices) {
  std::vector<uint32_t> codes;
  codes.reserve(indices.size());
  uint32_t next = 0;
  for (const uint32_t index : indices) {
    codes.push_back(zigzag(next - index));
    next = std::max(next, index + 1);
  }
  return codes;
}

Result<std::vector<uint32_t>> decodedIndices(std::vector<uint32_t> codes, uint32_t vertexCount) {
  uint32_t next = 0;
  for (uint32_t& code : codes) {
    const uint32_t index = next - unzigzag(code);
    if (index >= vertexCount)
      return fail(ErrorKind::corrupt, "indices: expected less than {}, found {}", vertexCount, index);
    next = std::max(next, index + 1);
    code = index;
  }
  return codes;
}

// One component of every vertex, as differences from the vertex before.
template <class Component>
std::vector<uint32_t> codedDeltas(size_t count, const Component& component) {
  std::vector<uint32_t> codes(count);
  uint32_t last = 0;
  for (size_t i = 0; i < count; ++i) {
    codes[i] = zigzag(component(i) - last);
    last = component(i);
  }
  return codes;
}

template <class Component>
void decodeDeltas(std::span<const uint32_t> codes, const Component& component) {
  uint32_t value = 0;
  for (size_t i = 0; i < codes.size(); ++i) component(i) = value += unzigzag(codes[i]);
}

tl::unexpected<Error> wrong(uint64_t offset, const std::string& expected, const std::string& found) {
  return fail(ErrorKind::corrupt, "byte {} of the page: expected {}, found {}", offset, expected, found);
}

Result<Header> readHeader(std::span<const std::byte> bytes, const GeometryLimits& limits) {
  ByteReader in(bytes);
  const Header header{in.u32(), in.u32(), in.u32(), in.u32()};
  if (!in.ok()) return wrong(0, fmt::format("{} bytes", kHeaderBytes), fmt::format("{}", bytes.size()));
  if ((header.flags & ~(kHasColours | kHasNormals)) != 0) return wrong(8, "flags 0 to 3", fmt::format("{}", header.flags));
  if (header.reserved != 0) return wrong(12, "0", fmt::format("{}", header.reserved));
  const uint64_t rawBytes = rawSizeBytes(header);
  const uint64_t allowed = std::min(limits.maxDecodedBytes, in.remaining() * kMaxZlibRatio);
  if (rawBytes > allowed)
    return wrong(0, fmt::format("vertices and triangles of at most {} bytes", allowed), fmt::format("{}", rawBytes));
  return header;
}

Result<> checkPositions(std::span<const glm::uvec3> positions, uint32_t maxCoordinate) {
  for (const glm::uvec3& p : positions)
    if (std::max({p.x, p.y, p.z}) > maxCoordinate)
      return fail(ErrorKind::corrupt, "positions: expected at most {}, found {}, {}, {}", maxCoordinate, p.x, p.y, p.z);
  return {};
}

void checkValid(const GeometryPage& page) {
  FARCELL_CHECK(page.indices.size() % 3 == 0 && page.indices.size() / 3 <= UINT32_MAX);
  FARCELL_CHECK(page.positions.size() <= UINT32_MAX);
  FARCELL_CHECK(page.colours.empty() || page.colours.size() == page.positions.size());
  FARCELL_CHECK(page.normals.empty() || page.normals.size() == page.positions.size());
  for (const uint32_t index : page.indices) FARCELL_CHECK(index < page.positions.size());
}

}  // namespace

std::vector<std::byte> encodeGeometryPage(const GeometryPage& page) {
  checkValid(page);
  const size_t count = page.positions.size();
  const Header header{static_cast<uint32_t>(count), static_cast<uint32_t>(page.indices.size() / 3),
                      (page.colours.empty() ? 0 : kHasColours) | (page.normals.empty() ? 0 : kHasNormals), 0};
  std::vector<std::byte> raw(rawSizeBytes(header));
  std::byte* out = raw.data();
  const auto write = [&out](const std::vector<uint32_t>& words) {
    writeWords(words, out);
    out += 4 * words.size();
  };
  write(codedIndices(page.indices));
  for (int axis = 0; axis < 3; ++axis) write(codedDeltas(count, [&](size_t i) { return page.positions[i][axis]; }));
  if (!page.colours.empty()) write(codedDeltas(count, [&](size_t i) { return page.colours[i]; }));
  if (!page.normals.empty()) write(codedDeltas(count, [&](size_t i) { return page.normals[i]; }));

  ByteWriter bytes;
  for (const uint32_t value : {header.vertexCount, header.triangleCount, header.flags, header.reserved}) bytes.u32(value);
  bytes.append(zlibCompress(raw, kGeometryZlibLevel));
  return std::move(bytes.bytes);
}

Result<GeometryPage> decodeGeometryPage(std::span<const std::byte> bytes, const GeometryLimits& limits) {
  FARCELL_ASSIGN(const Header header, readHeader(bytes, limits));
  std::vector<std::byte> raw(rawSizeBytes(header));
  if (const auto inflated = zlibDecompress(bytes.subspan(kHeaderBytes), raw); !inflated)
    return fail(ErrorKind::corrupt, "byte {} of the page: {}", kHeaderBytes, inflated.error().message);
  size_t position = 0;
  const auto read = [&](size_t count) {
    position += 4 * count;
    return readWords(std::span(raw).subspan(position - 4 * count, 4 * count));
  };
  GeometryPage page;
  FARCELL_ASSIGN(page.indices, decodedIndices(read(3 * size_t{header.triangleCount}), header.vertexCount));
  page.positions.resize(header.vertexCount);
  for (int axis = 0; axis < 3; ++axis)
    decodeDeltas(read(header.vertexCount), [&](size_t i) -> uint32_t& { return page.positions[i][axis]; });
  FARCELL_TRY(checkPositions(page.positions, limits.maxCoordinate));
  if ((header.flags & kHasColours) != 0) {
    page.colours.resize(header.vertexCount);
    decodeDeltas(read(header.vertexCount), [&](size_t i) -> uint32_t& { return page.colours[i]; });
  }
  if ((header.flags & kHasNormals) != 0) {
    page.normals.resize(header.vertexCount);
    decodeDeltas(read(header.vertexCount), [&](size_t i) -> uint32_t& { return page.normals[i]; });
  }
  return page;
}

uint32_t decodedSizeBytes(const GeometryPage& page) {
  const uint64_t words =
      3 * uint64_t{page.positions.size()} + page.colours.size() + page.normals.size() + page.indices.size();
  FARCELL_CHECK(4 * words <= UINT32_MAX);
  return static_cast<uint32_t>(4 * words);
}

}  // namespace farcell
