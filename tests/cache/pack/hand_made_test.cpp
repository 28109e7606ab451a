// A pack written byte by byte from FORMAT.md, with zlib and with none of the library's writers: what the page promises
// is what the reader reads.
#include <gtest/gtest.h>
#include <zlib.h>

#include "cache/base/hash.h"
#include "tests/cache/pack/samples.h"

namespace farcell {
namespace {

using samples::Bytes;

class Text {
 public:
  Bytes bytes;
  Text& raw(std::initializer_list<int> values) {
    for (const int value : values) bytes.push_back(static_cast<std::byte>(value));
    return *this;
  }
  Text& number(uint64_t value, int size) {
    for (int i = 0; i < size; ++i) raw({static_cast<int>(value >> (8 * i) & 255)});
    return *this;
  }
  Text& u32(std::initializer_list<uint64_t> values) {
    for (const uint64_t value : values) number(value, 4);
    return *this;
  }
  Text& u64(std::initializer_list<uint64_t> values) {
    for (const uint64_t value : values) number(value, 8);
    return *this;
  }
  Text& string(const std::string& text) {
    u32({text.size()});
    for (const char c : text) raw({c});
    return *this;
  }
  Text& zeros(size_t count) {
    bytes.resize(bytes.size() + count);
    return *this;
  }
  Text& append(const Bytes& more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
    return *this;
  }
};

Bytes deflated(const Bytes& raw) {
  Bytes stream(compressBound(raw.size()));
  uLongf size = stream.size();
  EXPECT_EQ(
      compress(reinterpret_cast<Bytef*>(stream.data()), &size, reinterpret_cast<const Bytef*>(raw.data()), raw.size()),
      Z_OK);
  stream.resize(size);
  return stream;
}

constexpr uint64_t kF64One = 0x3ff0000000000000, kF64Two = 0x4000000000000000;
constexpr uint32_t kF32One = 0x3f800000, kF32MinusOne = 0xbf800000;

// Two triangles with a shared edge: (0, 1, 2) has no known edge; (1, 3, 2) has 2 -> 1, of age 1 after (0, 2), from its
// corner 2. Vertices (0,0,0) (4,0,0) (0,4,0) (4,4,0), red, red, green, green.
Bytes geometryPage() {
  Text payload;
  payload.raw({48, 3 * 1 + 2});
  // Corners, zigzag of next - index: 0 - 0, 1 - 1, 2 - 2 and 3 - 3, four planes of four zeros.
  payload.zeros(16);
  // Distances back: x 0 4 0 4, y 0 0 4 4, z 0 0 0 0. Zero is never "the word before" the first.
  payload.raw({0, 0, 2, 2, 0, 1, 0, 1, 0, 1, 1, 1});
  // Differences of the words with distance 0: x 0, +4; y 0, +4; z 0. Zigzag 4 -> 8.
  payload.raw({0, 8, 0, 8, 0}).zeros(15);
  // Colours: red, red, green, green. 0x0000ff then 0x00ff00: lanes -1 -> 1 and +1... modulo 256: ff - 0 = -1 -> 1,
  // then red lane 0 - ff = +1 -> 2, green lane ff - 0 = -1 -> 1.
  payload.raw({0, 1, 0, 1});
  payload.raw({1, 2, 0, 1, 0, 0, 0, 0});
  Text page;
  page.u32({4, 2, 1, payload.bytes.size()}).append(deflated(payload.bytes));
  return page.bytes;
}

// View 0: 3 x 1 texels, sparse: coverage 255, 0, 51. View `second`: 2 x 1, plain.
Bytes viewPage(uint32_t second) {
  // Red is half of green (64 / 128), blue as much (128 / 128). Coverage; green from the left: 100, then a fifth of it;
  // red and blue where there is green; depth, near coverage is everywhere, one value.
  const Bytes first =
      deflated(Text().raw({64, 128}).raw({255, 0, 51}).raw({100, 1}).raw({1, 255}).raw({0, 0}).raw({9}).bytes);
  const Bytes other = deflated(Text().raw({128, 128}).raw({255, 0, 7, 1, 0, 0, 0, 0, 9, 4}).bytes);
  const uint64_t begin = 8 + 2 * 32;
  Text page;
  page.u32({2, 5});
  page.u32({0}).number(3, 2).number(4, 2).number(3, 2).number(1, 2);
  page.u32({kF32MinusOne, kF32One, 0x10000000u | 2u << 3 | 5u << 12, begin, first.size()});
  // Filters: A left (2), G left (2), R and B none, depth average (3).
  page.u32({second}).number(0, 2).number(0, 2).number(2, 2).number(1, 2);
  page.u32({0, 0, 2u | 2u << 3 | 3u << 12, begin + first.size(), other.size()});
  return page.append(first).append(other).bytes;
}

void appendPage(Text& pack, const Bytes& page, std::vector<std::pair<uint64_t, uint64_t>>& places) {
  const uint64_t offset = pack.bytes.size();
  pack.append(page);
  places.emplace_back(offset, hashBytes(std::span(pack.bytes).subspan(offset)));
}

Bytes settings() {
  return Text().u32({42, 16, 1, 10, 2, 0xffffffff, 2, 0x100}).u64({kF64Two, 0, 0, 0, kF64One, 0}).bytes;
}

Bytes directory(const Bytes& geometry, const Bytes& views, uint32_t group,
                const std::vector<std::pair<uint64_t, uint64_t>>& places) {
  Text text;
  text.u64({0, 0, 0, kF64One}).u32({16, 2}).u32({0, 0, 0, 4, 4, 0}).append(settings());
  text.string("hand.ply");
  text.u64({2, 4, 42, 2, views.size(), 25, geometry.size(), 0});
  text.u32({1}).string("zeroArea").u64({9});
  text.u32({0});
  text.u32({0});
  text.u32({1});
  text.u32({0, 0, 0, 0, 0xffffffff, 0xffffffff, 0, 0, 1, 1, 1, 0xffffffff, 0})
      .u32({0, 0, 0, 4, 4, 0})
      .u64({2, 2, 0})
      .raw({161, 145, 1, 255})
      .zeros(8)
      .number(42, 2)
      .number(16, 2);
  text.u32({2});
  text.u32({1, 0, 0, geometry.size(), 4 * (4 * 4 + 6), 0}).u64({places[0].first, places[0].second});
  text.u32({2, 0, group, views.size(), 5 * 5, 0}).u64({places[1].first, places[1].second});
  return text.bytes;
}

Bytes handMadePack(uint32_t group, uint32_t secondView) {
  Text pack;
  pack.raw({0x89, 'F', 'A', 'R', '\r', '\n', 0x1a, '\n'}).u32({0}).zeros(12);
  pack.u64({hashBytes(pack.bytes)});
  std::vector<std::pair<uint64_t, uint64_t>> places;
  const Bytes geometry = geometryPage(), views = viewPage(secondView);
  appendPage(pack, geometry, places);
  appendPage(pack, views, places);
  const Bytes entries = directory(geometry, views, group, places);
  const uint64_t offset = pack.bytes.size();
  Text footer;
  footer.u64({offset, entries.size(), hashBytes(entries), hashBytes(settings()), 77, offset + entries.size() + 80});
  footer.u32({0}).zeros(12);
  footer.u64({hashBytes(footer.bytes)}).raw({0x89, 'R', 'A', 'F', '\r', '\n', 0x1a, '\n'});
  return pack.append(entries).append(footer.bytes).bytes;
}

TEST(HandMadePack, IsReadAsFormatMdSays) {
  const Viewpoints viewpoints = Viewpoints::create(42).value();
  uint32_t second = 1;
  while (viewpoints.group(static_cast<int>(second)) != viewpoints.group(0)) ++second;
  const samples::TemporaryFile file("hand.far");
  samples::writeAll(file.path(), handMadePack(static_cast<uint32_t>(viewpoints.group(0)), second));
  const Result<PackFile> pack = PackFile::open(file.path());
  ASSERT_TRUE(pack.has_value()) << pack.error().message;
  for (const Error& finding : pack->verify(10, nullptr)) ADD_FAILURE() << finding.message;

  const Directory& found = pack->directory();
  EXPECT_EQ(found.sourceName, "hand.ply");
  EXPECT_EQ(found.sourceHash, 77u);
  EXPECT_EQ(found.model.grid, (Grid{glm::dvec3(0), 1, 16}));
  EXPECT_EQ(found.model.settings.metresPerUnit, 2);
  EXPECT_EQ(found.model.settings.fixedLevel, -1);
  EXPECT_EQ(found.model.settings.lighting, Lighting::baked);
  EXPECT_EQ(found.model.settings.sun, (Sun{1, 0}));
  EXPECT_EQ(found.model.settings.leafTriangles, 10);
  EXPECT_TRUE(found.model.hasColours && !found.model.hasNormals);
  EXPECT_EQ(found.report.skipped, (std::map<std::string, uint64_t>{{"zeroArea", 9}}));
  EXPECT_EQ(found.report.viewsKept, 2u);

  const GeometryPage geometry{
      {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {4, 4, 0}}, {0xff, 0xff, 0xff00, 0xff00}, {}, {}, {0, 1, 2, 1, 3, 2}};
  EXPECT_EQ(pack->readGeometry(0), geometry);
  ViewPage views;
  views.views.resize(2);
  views.views[0] = {.view = 0,
                    .x0 = 3,
                    .y0 = 4,
                    .width = 3,
                    .height = 1,
                    .depthMin = -1,
                    .depthMax = 1,
                    .rgba = {51, 100, 100, 255, 0, 0, 0, 0, 10, 21, 21, 51},
                    .depth = {9, 9, 9},
                    .normal = {}};
  views.views[1] = {.view = second,
                    .width = 2,
                    .height = 1,
                    .depthMin = 0,
                    .depthMax = 0,
                    .rgba = {7, 7, 7, 255, 8, 8, 8, 255},
                    .depth = {9, 8},
                    .normal = {}};
  EXPECT_EQ(pack->readViews(1), views);
}

}  // namespace
}  // namespace farcell
