#include <gtest/gtest.h>
#include <zlib.h>

#include <array>
#include <map>

#include <algorithm>
#include <array>

#include "cache/pack/zlib_stream.h"
#include "tests/cache/pack/samples.h"

namespace farcell {
namespace {

using samples::Bytes;
using samples::randomGeometry;

constexpr uint32_t kMaxCoordinate = 1u << 20;
constexpr size_t kPageHeaderBytes = 16;

GeometryLimits limitsOf(const GeometryPage& page) { return {kMaxCoordinate, decodedSizeBytes(page)}; }

Result<GeometryPage> decode(std::span<const std::byte> bytes, const GeometryPage& page) {
  return decodeGeometryPage(Bytes(bytes.begin(), bytes.end()), limitsOf(page));
}

uint32_t word(std::span<const std::byte> bytes, size_t offset) {
  uint32_t value = 0;
  for (size_t i = 4; i-- > 0;) value = value << 8 | std::to_integer<uint32_t>(bytes[offset + i]);
  return value;
}

void setWord(Bytes& bytes, size_t offset, uint32_t value) {
  for (size_t i = 0; i < 4; ++i) bytes[offset + i] = static_cast<std::byte>(value >> (8 * i));
}

// What zlib itself finds behind the page's header.
Bytes inflated(std::span<const std::byte> page) {
  Bytes payload(word(page, 12) + 1);
  uLongf size = payload.size();
  const auto* stream = reinterpret_cast<const Bytef*>(page.data() + kPageHeaderBytes);
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(payload.data()), &size, stream, page.size() - kPageHeaderBytes), Z_OK);
  payload.resize(size);
  return payload;
}

// Decodes by FORMAT.md, value by value, with zlib and without any of the library's code.
class PlainDecoder {
 public:
  explicit PlainDecoder(const Bytes& page) : page_(page), payload_(inflated(page)) {}

  GeometryPage decode() {
    const size_t vertices = word(page_, 0), triangles = word(page_, 4), flags = word(page_, 8);
    GeometryPage result;
    result.indices = indices(triangles);
    const std::vector<uint32_t> components = sequences(3, vertices, 32, true);
    for (size_t i = 0; i < vertices; ++i)
      result.positions.emplace_back(components[i], components[vertices + i], components[2 * vertices + i]);
    if (flags & 1) result.colours = sequences(1, vertices, 8);
    if (flags & 2) result.normals = sequences(1, vertices, 16);
    if (flags & 4) {
      const std::vector<uint32_t> onAtlas = sequences(2, vertices, 32, true);
      for (size_t i = 0; i < vertices; ++i) result.coordinates.push_back(onAtlas[i] | onAtlas[vertices + i] << 16);
    }
    if (flags & 8) result.shown = sequences(1, triangles, 8);
    EXPECT_EQ(at_, payload_.size());
    return result;
  }

 private:
  uint32_t byte() { return std::to_integer<uint32_t>(payload_.at(at_++)); }

  std::vector<uint32_t> planes(size_t count) {
    std::vector<uint32_t> words(count);
    for (uint32_t shift = 0; shift < 32; shift += 8)
      for (uint32_t& value : words) value |= byte() << shift;
    return words;
  }

  static int64_t signedOf(uint32_t code) { return code % 2 ? -static_cast<int64_t>(code / 2) - 1 : code / 2; }

  std::vector<uint32_t> indices(size_t triangles) {
    std::vector<uint32_t> codes, result;
    size_t corners = 0;
    for (size_t t = 0; t < triangles; ++t) {
      codes.push_back(byte());
      corners += codes.back() == 48 ? 3 : 1;
    }
    const std::vector<uint32_t> differences = planes(corners);
    std::vector<std::array<uint32_t, 3>> edges;  // from, to, and the vertex across; newest last
    int64_t next = 0;
    size_t used = 0;
    for (const uint32_t code : codes) {
      std::vector<uint32_t> corner;
      if (code < 48) corner = {edges.at(edges.size() - 1 - code / 3)[0], edges.at(edges.size() - 1 - code / 3)[1]};
      while (corner.size() < 3) {
        corner.push_back(static_cast<uint32_t>(next - signedOf(differences.at(used++))));
        if (code < 48 && corner.back() == next) across_[corner.back()] = edges.at(edges.size() - 1 - code / 3);
        next = std::max<int64_t>(next, int64_t{corner.back()} + 1);
      }
      if (code == 48) edges.push_back({corner[1], corner[0], corner[2]});
      edges.push_back({corner[2], corner[1], corner[0]});
      edges.push_back({corner[0], corner[2], corner[1]});
      std::rotate(corner.begin(), corner.begin() + (code < 48 ? (3 - code % 3) % 3 : 0), corner.end());
      result.insert(result.end(), corner.begin(), corner.end());
    }
    return result;
  }

  std::vector<uint32_t> sequences(size_t count, size_t length, uint32_t bits, bool positions = false) {
    std::vector<uint32_t> distances, words;
    for (size_t i = 0; i < count * length; ++i) distances.push_back(byte());
    const auto literals = static_cast<size_t>(std::count(distances.begin(), distances.end(), 0u));
    const std::vector<uint32_t> differences = planes(literals);
    size_t used = 0;
    for (size_t i = 0; i < count * length; ++i) {
      if (distances[i] > 0) {
        words.push_back(words.at(i - distances[i]));
        continue;
      }
      uint32_t before = i % length == 0 ? 0 : words.back();
      if (const auto known = across_.find(static_cast<uint32_t>(i % length)); positions && known != across_.end()) {
        const auto& [from, to, opposite] = known->second;
        const size_t start = i - i % length;
        before = words.at(start + from) + words.at(start + to) - words.at(start + opposite);
      }
      const uint32_t difference = differences.at(used++);
      uint64_t value = 0;
      for (uint32_t lane = 0; lane < 32; lane += bits) {
        const uint64_t size = uint64_t{1} << bits;
        const auto part = static_cast<uint32_t>((difference >> lane) % size);
        value |= (static_cast<uint64_t>((before >> lane) + signedOf(part)) % size) << lane;
      }
      words.push_back(static_cast<uint32_t>(value));
    }
    return words;
  }

  const Bytes& page_;
  std::map<uint32_t, std::array<uint32_t, 3>> across_;  // of vertices: an edge and the vertex across it
  Bytes payload_;
  size_t at_ = 0;
};

TEST(GeometryPageCoding, ReturnsEveryRandomPageExactly) {
  for (uint32_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const GeometryPage page = randomGeometry(random, 3 + seed * seed % 700, seed * 5 % 900, kMaxCoordinate, seed % 2,
                                             seed % 3 == 0, seed % 5 < 2);
    const Bytes bytes = encodeGeometryPage(page);
    const auto decoded = decode(bytes, page);
    ASSERT_TRUE(decoded.has_value()) << decoded.error().message;
    EXPECT_EQ(*decoded, page);
    EXPECT_EQ(encodeGeometryPage(page), bytes);
  }
}

TEST(GeometryPageCoding, IsWhatFormatMdSaysToADecoderOfItsOwn) {
  for (uint32_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const GeometryPage page =
        randomGeometry(random, 300, 400, kMaxCoordinate, seed % 2, seed % 4 < 2, seed % 3 == 0, seed % 8 < 4);
    EXPECT_EQ(PlainDecoder(encodeGeometryPage(page)).decode(), page);
    const GeometryPage ordered = optimisedOrder(page);
    EXPECT_EQ(PlainDecoder(encodeGeometryPage(ordered)).decode(), ordered);
  }
}

TEST(GeometryPageCoding, SmallerPagesHoldTheSame) {
  std::mt19937 random(21);
  for (const uint32_t triangles : {0u, 1u, 3000u}) {
    const GeometryPage page = randomGeometry(random, 500, triangles, kMaxCoordinate, true, false);
    const Bytes bytes = encodeGeometryPage(page);
    Result<Bytes> smaller = smallerGeometryPage(bytes, limitsOf(page));
    ASSERT_TRUE(smaller) << smaller.error().message;
    EXPECT_LE(smaller->size(), bytes.size());
    EXPECT_EQ(inflated(*smaller), inflated(bytes));
    EXPECT_EQ(decode(*smaller, page), page);
    if (triangles > 1000) {
      EXPECT_LT(smaller->size(), bytes.size());
    }
    smaller->pop_back();
    EXPECT_FALSE(smallerGeometryPage(*smaller, limitsOf(page)));
  }
}

TEST(GeometryPageCoding, KeepsExtremeWords) {
  GeometryPage page;
  page.positions = {{0, ~0u, 1u << 31}, {~0u, 0, (1u << 31) - 1}, {1u << 31, ~0u, 0}};
  page.colours = {0, ~0u, 0x80808080};
  page.normals = {0x80008000, 0x7fff7fff, ~0u};
  page.indices = {2, 0, 1, 0, 0, 0, 1, 0, 2};
  const auto decoded = decodeGeometryPage(encodeGeometryPage(page), {~0u, decodedSizeBytes(page)});
  ASSERT_TRUE(decoded.has_value()) << decoded.error().message;
  EXPECT_EQ(*decoded, page);
}

TEST(GeometryPageCoding, HoldsNoTrianglesAndNoVertices) {
  const GeometryPage empty;
  EXPECT_EQ(decodedSizeBytes(empty), 0u);
  EXPECT_EQ(decode(encodeGeometryPage(empty), empty), empty);
}

TEST(GeometryPageCoding, RefusesEveryTruncationAndOneByteMore) {
  std::mt19937 random(1);
  const GeometryPage page = randomGeometry(random, 40, 60, kMaxCoordinate, true, true);
  Bytes bytes = encodeGeometryPage(page);
  for (size_t length = 0; length < bytes.size(); ++length) {
    const auto decoded = decode(std::span(bytes).first(length), page);
    ASSERT_FALSE(decoded.has_value()) << length;
    EXPECT_EQ(decoded.error().kind, ErrorKind::corrupt);
  }
  bytes.push_back(std::byte{0});
  EXPECT_FALSE(decode(bytes, page).has_value());
}

TEST(GeometryPageCoding, RefusesEveryTruncationOfThePayload) {
  std::mt19937 random(2);
  const GeometryPage page = randomGeometry(random, 20, 30, kMaxCoordinate, true, true);
  const Bytes bytes = encodeGeometryPage(page);
  const Bytes payload = inflated(bytes);
  for (size_t length = 0; length <= payload.size() + 1; ++length) {
    Bytes changed(bytes.begin(), bytes.begin() + kPageHeaderBytes);
    Bytes part = payload;
    part.resize(length);
    setWord(changed, 12, static_cast<uint32_t>(length));
    const Bytes stream = zlibCompress(part, 6);
    changed.insert(changed.end(), stream.begin(), stream.end());
    EXPECT_EQ(decode(changed, page).has_value(), length == payload.size()) << length;
  }
}

TEST(GeometryPageCoding, BelievesNoCountBeyondItsLimits) {
  std::mt19937 random(3);
  const GeometryPage page = randomGeometry(random, 40, 60, kMaxCoordinate, true, false);
  const Bytes bytes = encodeGeometryPage(page);
  for (size_t offset = 0; offset < kPageHeaderBytes; offset += 4) {
    for (const uint32_t value : {0u, 1u, 39u, 41u, 61u, 1u << 16, 1u << 31, ~0u}) {
      Bytes changed = bytes;
      setWord(changed, offset, value);
      EXPECT_EQ(decode(changed, page).has_value(), changed == bytes) << offset << " " << value;
    }
  }
  const GeometryLimits tight{kMaxCoordinate, decodedSizeBytes(page) - 1};
  EXPECT_FALSE(decodeGeometryPage(bytes, tight).has_value());
}

TEST(GeometryPageCoding, AllocatesNothingForAClaimNoDeflateStreamCanKeep) {
  Bytes bytes(kPageHeaderBytes + 100);
  setWord(bytes, 0, 1u << 27);
  setWord(bytes, 12, 3u << 27);
  const auto decoded = decodeGeometryPage(bytes, {kMaxCoordinate, ~uint64_t{0}});
  ASSERT_FALSE(decoded.has_value());
  EXPECT_NE(decoded.error().message.find("payload"), std::string::npos) << decoded.error().message;
}

TEST(GeometryPageCoding, RefusesCoordinatesOutsideTheCube) {
  std::mt19937 random(4);
  GeometryPage page = randomGeometry(random, 40, 60, 1000, false, false);
  page.positions[17].y = 1000;
  const Bytes bytes = encodeGeometryPage(page);
  EXPECT_TRUE(decodeGeometryPage(bytes, {1000, decodedSizeBytes(page)}).has_value());
  EXPECT_FALSE(decodeGeometryPage(bytes, {999, decodedSizeBytes(page)}).has_value());
}

// Damage behind a right zlib checksum reaches every check of the decoder; whatever passes must be usable.
TEST(GeometryPageCoding, RefusesCoordinatesBeyondTheAtlas) {
  GeometryPage page = samples::cornerTriangle(7);
  page.coordinates = {0x0000ffff, 0xffff0000, 0x12345678};
  const Bytes bytes = encodeGeometryPage(page);
  EXPECT_EQ(decode(bytes, page), page);
  Bytes payload = inflated(bytes);
  // The six words are all literals, in planes at the end: the third plane's bytes are bits 16 to 23.
  payload.at(payload.size() - 12) = std::byte{2};
  Bytes changed(bytes.begin(), bytes.begin() + kPageHeaderBytes);
  const Bytes stream = zlibCompress(payload, 1);
  changed.insert(changed.end(), stream.begin(), stream.end());
  const auto decoded = decode(changed, page);
  ASSERT_FALSE(decoded.has_value());
  EXPECT_NE(decoded.error().message.find("texture coordinates up to 65535"), std::string::npos)
      << decoded.error().message;
}

TEST(GeometryPageCoding, SurvivesDamagedPayloads) {
  std::mt19937 random(5);
  const GeometryPage page = randomGeometry(random, 60, 80, kMaxCoordinate, true, true);
  const Bytes bytes = encodeGeometryPage(page);
  const Bytes payload = inflated(bytes);
  for (int round = 0; round < 3000; ++round) {
    SCOPED_TRACE(round);
    Bytes damaged = payload;
    for (uint32_t i = 0; i <= samples::below(random, 4); ++i)
      damaged[samples::below(random, static_cast<uint32_t>(damaged.size()))] = static_cast<std::byte>(random());
    Bytes changed(bytes.begin(), bytes.begin() + kPageHeaderBytes);
    const Bytes stream = zlibCompress(damaged, 1);
    changed.insert(changed.end(), stream.begin(), stream.end());
    const auto decoded = decode(changed, page);
    if (!decoded) continue;
    ASSERT_EQ(decodedSizeBytes(*decoded), decodedSizeBytes(page));
    for (const uint32_t index : decoded->indices) ASSERT_LT(index, decoded->positions.size());
    for (const glm::uvec3& p : decoded->positions) ASSERT_LE(std::max({p.x, p.y, p.z}), kMaxCoordinate);
  }
}

// A corner with all that belongs to it.
using Corner = std::array<uint32_t, 6>;

// Triangles by value, each starting at its least corner, sorted: equal for equal sets with equal winding.
std::vector<std::array<Corner, 3>> triangleSet(const GeometryPage& page) {
  std::vector<std::array<Corner, 3>> set;
  for (size_t i = 0; i < page.indices.size(); i += 3) {
    std::array<Corner, 3> triangle{};
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t index = page.indices[i + k];
      const glm::uvec3& p = page.positions[index];
      triangle[k] = {p.x,
                     p.y,
                     p.z,
                     page.colours.empty() ? 0 : page.colours[index],
                     page.normals.empty() ? 0 : page.normals[index],
                     page.shown.empty() ? 0 : page.shown[i / 3]};
    }
    std::array<std::array<Corner, 3>, 3> rotations = {triangle, triangle, triangle};
    for (size_t k = 0; k < 3; ++k)
      std::rotate(rotations[k].begin(), rotations[k].begin() + static_cast<ptrdiff_t>(k), rotations[k].end());
    set.push_back(*std::min_element(rotations.begin(), rotations.end()));
  }
  std::sort(set.begin(), set.end());
  return set;
}

TEST(OptimisedOrder, KeepsEveryTriangleAndItsWindingAndDropsUnusedVertices) {
  for (uint32_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const GeometryPage page = randomGeometry(random, 3 + seed * 7, 1 + seed * 11, kMaxCoordinate, seed % 2,
                                             seed % 3 == 1, seed % 5 == 2, seed % 4 < 2);
    const GeometryPage ordered = optimisedOrder(page);
    EXPECT_EQ(triangleSet(ordered), triangleSet(page));
    std::vector<bool> used(ordered.positions.size());
    for (const uint32_t index : ordered.indices) used.at(index) = true;
    EXPECT_EQ(std::count(used.begin(), used.end(), false), 0);
    EXPECT_EQ(optimisedOrder(page), ordered);
    EXPECT_EQ(decode(encodeGeometryPage(ordered), ordered), ordered);
  }
}

TEST(OptimisedOrder, OfNoTrianglesIsEmpty) {
  GeometryPage page;
  page.positions = {{1, 2, 3}};
  EXPECT_EQ(optimisedOrder(page), GeometryPage{});
}

// A regular mesh is what the coder is for.
TEST(OptimisedOrder, LetsARegularMeshTakeLessThanTwoBytesATriangle) {
  GeometryPage page;
  constexpr uint32_t kSide = 64;
  for (uint32_t y = 0; y <= kSide; ++y)
    for (uint32_t x = 0; x <= kSide; ++x) page.positions.emplace_back(x * 100, y * 100, (x * x + y * y) / 8);
  for (uint32_t y = 0; y < kSide; ++y)
    for (uint32_t x = 0; x < kSide; ++x) {
      const uint32_t a = y * (kSide + 1) + x, b = a + 1, c = a + kSide + 1, d = c + 1;
      page.indices.insert(page.indices.end(), {a, b, d, a, d, c});
    }
  std::mt19937 random(6);
  std::vector<std::array<uint32_t, 3>> triangles(page.indices.size() / 3);
  for (size_t i = 0; i < page.indices.size(); ++i) triangles[i / 3][i % 3] = page.indices[i];
  std::shuffle(triangles.begin(), triangles.end(), random);
  for (size_t i = 0; i < page.indices.size(); ++i) page.indices[i] = triangles[i / 3][i % 3];
  EXPECT_LT(encodeGeometryPage(optimisedOrder(page)).size(), 2 * triangles.size());
}

}  // namespace
}  // namespace farcell
