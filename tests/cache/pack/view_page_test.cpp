#include <gtest/gtest.h>
#include <zlib.h>

#include <limits>
#include <set>

#include "cache/pack/encoded_view.h"
#include "cache/pack/zlib_stream.h"
#include "tests/cache/pack/samples.h"

namespace farcell {
namespace {

using samples::Bytes;

constexpr uint32_t kViewCount = 42;
constexpr uint32_t kImageSize = 64;
constexpr size_t kPageHeaderBytes = 8;
constexpr size_t kViewHeaderBytes = 32;

// As a baker makes them: nothing but depth beside a surface of one colour, lit smoothly, coverage broken at its edge.
ViewImage bakedLike(std::mt19937& random, uint32_t index, bool normals) {
  ViewImage view = samples::randomView(random, index, kImageSize, normals, 0);
  for (uint32_t i = 0; i < view.width * view.height; ++i) {
    const int x = static_cast<int>(i % view.width), y = static_cast<int>(i / view.width);
    const int inside = static_cast<int>(view.width) / 3 - std::abs(x - static_cast<int>(view.width) / 2) + y % 5;
    const auto alpha = static_cast<uint32_t>(std::clamp(64 * inside, 0, 255));
    const uint32_t light = 100 + static_cast<uint32_t>(x + y) % 100 + static_cast<uint32_t>(random() % 4);
    for (uint32_t k = 0; k < 4; ++k)
      view.rgba[4 * i + k] = static_cast<uint8_t>(k == 3 ? alpha : light * (4 - k) / 4 * alpha / 255);
    if (inside < 0) view.depth[i] = 0;
    for (uint32_t k = 0; normals && k < 3; ++k) view.normal[3 * i + k] = alpha > 0 ? static_cast<uint8_t>(x + y) : 0;
  }
  return view;
}

ViewPage randomPage(uint32_t seed, bool normals) {
  std::mt19937 random(seed);
  ViewPage page;
  for (uint32_t view = samples::below(random, 6); view < kViewCount; view += 1 + samples::below(random, 9)) {
    if (random() % 2 != 0)
      page.views.push_back(bakedLike(random, view, normals));
    else
      page.views.push_back(samples::randomView(random, view, kImageSize, normals, static_cast<int>(random() % 3)));
    if (random() % 4 != 0) continue;
    page.views.back() = {};
    page.views.back().view = view;
  }
  return page;
}

Result<ViewPage> decode(std::span<const std::byte> bytes, const ViewPage& page) {
  return decodeViewPage(Bytes(bytes.begin(), bytes.end()), {kViewCount, kImageSize, decodedSizeBytes(page)});
}

uint32_t number(std::span<const std::byte> bytes, size_t offset, size_t size) {
  uint32_t value = 0;
  for (size_t i = size; i-- > 0;) value = value << 8 | std::to_integer<uint32_t>(bytes[offset + i]);
  return value;
}

void setNumber(Bytes& bytes, size_t offset, size_t size, uint32_t value) {
  for (size_t i = 0; i < size; ++i) bytes[offset + i] = static_cast<std::byte>(value >> (8 * i));
}

// The planes of an inflated stream by FORMAT.md, texel by texel; none of the library's code.
std::vector<std::vector<int>> plainPlanes(std::span<const uint8_t> bytes, size_t planeCount, uint32_t coding, int width,
                                          int height) {
  const auto texels = static_cast<size_t>(width * height);
  const auto at = [&](const std::vector<int>& plane, int x, int y) {
    return x < 0 || y < 0 || x >= width || y >= height ? 0 : plane[static_cast<size_t>(y * width + x)];
  };
  std::vector<std::vector<int>> planes(planeCount, std::vector<int>(texels));
  const auto isStored = [&](size_t plane, int x, int y) {
    if (coding >> 28 == 0 || plane == 0) return true;
    bool near = at(planes[0], x, y) > 0;
    for (int k = 0; k < 9 && plane == 4; ++k) near = near || at(planes[0], x + k % 3 - 1, y + k / 3 - 1) > 0;
    return near;
  };
  size_t used = 2;
  for (size_t p = 0; p < planeCount; ++p) {
    const uint32_t filter = coding >> (3 * p) & 7;
    std::vector<int> counts(texels);  // what each texel counts as for its neighbours
    for (size_t i = 0; i < texels; ++i) {
      const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width, alpha = planes[0][i];
      const int left = at(counts, x - 1, y), up = at(counts, x, y - 1);
      const int predictions[6] = {0, up, left, (left + up) / 2, (left + up - at(counts, x - 1, y - 1)) & 255, 0};
      const int prediction = predictions[filter];
      const bool stored = isStored(p, x, y);
      const int residual = stored ? bytes[used] : 0;
      if (stored && filter < 5) ++used;
      const int value = (residual + (p == 1 ? (prediction * alpha + 127) / 255 : prediction)) & 255;
      counts[i] = value;
      if (p == 1) counts[i] = alpha == 0 ? prediction : std::min(255, (value * 255 + alpha / 2) / alpha);
      planes[p][i] = stored ? value : 0;
    }
    if (filter == 5) ++used;
  }
  EXPECT_EQ(used, bytes.size());
  return planes;
}

// Decodes one view by FORMAT.md with zlib, given the page's header alone and no other view.
ViewImage plainlyDecoded(std::span<const std::byte> page, size_t index) {
  const uint32_t planeCount = number(page, 4, 4);
  const size_t header = kPageHeaderBytes + index * kViewHeaderBytes;
  const size_t begin = number(page, header + 24, 4), end = begin + number(page, header + 28, 4);
  ViewImage view;
  view.view = number(page, header, 4);
  view.x0 = number(page, header + 4, 2);
  view.y0 = number(page, header + 6, 2);
  view.width = number(page, header + 8, 2);
  view.height = number(page, header + 10, 2);
  view.depthMin = std::bit_cast<float>(number(page, header + 12, 4));
  view.depthMax = std::bit_cast<float>(number(page, header + 16, 4));
  const size_t texels = size_t{view.width} * view.height;
  if (texels == 0) {
    EXPECT_EQ(begin, end);
    return view;
  }
  std::vector<uint8_t> bytes(planeCount * texels + 2);
  uLongf size = bytes.size();
  EXPECT_EQ(uncompress(bytes.data(), &size, reinterpret_cast<const Bytef*>(page.data() + begin), end - begin), Z_OK);
  bytes.resize(size);
  const auto planes = plainPlanes(bytes, planeCount, number(page, header + 20, 4), static_cast<int>(view.width),
                                  static_cast<int>(view.height));
  for (size_t i = 0; i < texels; ++i) {
    const int green = planes[1][i];
    view.rgba.push_back(static_cast<uint8_t>(planes[2][i] + (bytes[0] * green + 64) / 128));
    view.rgba.push_back(static_cast<uint8_t>(green));
    view.rgba.push_back(static_cast<uint8_t>(planes[3][i] + (bytes[1] * green + 64) / 128));
    view.rgba.push_back(static_cast<uint8_t>(planes[0][i]));
    view.depth.push_back(static_cast<uint8_t>(planes[4][i]));
    for (size_t p = 5; p < planeCount; ++p) view.normal.push_back(static_cast<uint8_t>(planes[p][i]));
  }
  return view;
}

TEST(ViewPageCoding, ReturnsEveryRandomPageExactly) {
  for (uint32_t seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE(seed);
    const ViewPage page = randomPage(seed, seed % 2);
    const Bytes bytes = encodeViewPage(page);
    const auto decoded = decode(bytes, page);
    ASSERT_TRUE(decoded.has_value()) << decoded.error().message;
    EXPECT_EQ(*decoded, page);
    EXPECT_EQ(encodeViewPage(page), bytes);
  }
}

TEST(ViewPageCoding, LetsADecoderOfItsOwnReadEachViewAlone) {
  std::set<uint32_t> arrangements, filters;
  for (uint32_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const ViewPage page = randomPage(seed, seed % 2);
    const Bytes bytes = encodeViewPage(page);
    for (size_t i = page.views.size(); i-- > 0;) {
      EXPECT_EQ(plainlyDecoded(bytes, i), page.views[i]) << i;
      const uint32_t coding = number(bytes, kPageHeaderBytes + i * kViewHeaderBytes + 20, 4);
      arrangements.insert(coding >> 28);
      for (uint32_t plane = 0; plane < 8; ++plane) filters.insert(coding >> (3 * plane) & 7);
    }
  }
  EXPECT_EQ(arrangements, (std::set<uint32_t>{0, 1}));
  EXPECT_EQ(filters, (std::set<uint32_t>{0, 1, 2, 3, 4, 5}));
}

// Of what a view was and what is left of it, as a reader of the option's help would check it.
void expectNear(const ViewImage& was, const ViewImage& is, int maxError) {
  ASSERT_EQ(is.rgba.size(), was.rgba.size());
  ASSERT_EQ(is.normal.size(), was.normal.size());
  int worst = 0, outsideCoverage = 0, exactChanged = 0;
  for (size_t i = 0; i < was.depth.size(); ++i) {
    const uint8_t* const before = &was.rgba[4 * i];
    const uint8_t* const after = &is.rgba[4 * i];
    for (size_t k = 0; k < 4; ++k) worst = std::max(worst, std::abs(before[k] - after[k]));
    worst = std::max(worst, std::abs(was.depth[i] - is.depth[i]));
    const auto isWhole = [](uint8_t alpha) { return alpha == 0 || alpha == 255; };
    if ((isWhole(before[3]) || isWhole(after[3])) && before[3] != after[3]) ++exactChanged;
    if ((was.depth[i] == 0) != (is.depth[i] == 0)) ++exactChanged;
    for (size_t k = 0; k < 3; ++k)
      if (before[k] <= before[3] && after[k] > after[3]) ++outsideCoverage;
  }
  for (size_t i = 0; i < was.normal.size(); ++i) worst = std::max(worst, std::abs(was.normal[i] - is.normal[i]));
  EXPECT_LE(worst, maxError);
  EXPECT_EQ(exactChanged, 0);
  EXPECT_EQ(outsideCoverage, 0);
}

TEST(NearViewCoding, KeepsItsBoundAndWhatIsExact) {
  for (uint32_t seed = 0; seed < 90; ++seed) {
    SCOPED_TRACE(seed);
    const int maxError = 1 + static_cast<int>(seed % 8);
    const ViewPage page = randomPage(seed, seed % 2);
    for (const ViewImage& view : page.views) {
      if (view.width == 0) continue;
      const EncodedView coded = encodeView(view, maxError);
      EXPECT_EQ(encodeView(view, maxError), coded);
      const Bytes bytes = viewPageOf({&coded, 1}).bytes;
      expectNear(view, plainlyDecoded(bytes, 0), maxError);
    }
  }
}

TEST(NearViewCoding, TakesFewerBytesTheMoreErrorItMayHave) {
  std::mt19937 random(12);
  const ViewImage view = bakedLike(random, 0, true);
  size_t before = encodeView(view).stream.size();
  EXPECT_EQ(encodeView(view, 0), encodeView(view));
  for (const int maxError : {1, 2, 4, 8}) {
    const size_t bytes = encodeView(view, maxError).stream.size();
    EXPECT_LT(bytes, before) << maxError;
    before = bytes;
  }
}

TEST(SmallerView, HoldsTheSameTexelsInNoMoreBytes) {
  size_t before = 0, after = 0;
  for (uint32_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const ViewPage page = randomPage(seed, seed % 2);
    for (const ViewImage& view : page.views) {
      const EncodedView coded = encodeView(view, static_cast<int>(seed % 3));
      const Result<EncodedView> smaller = smallerView(coded);
      ASSERT_TRUE(smaller) << smaller.error().message;
      EXPECT_EQ(plainlyDecoded(viewPageOf({&*smaller, 1}).bytes, 0), plainlyDecoded(viewPageOf({&coded, 1}).bytes, 0));
      EXPECT_LE(smaller->stream.size(), coded.stream.size());
      before += coded.stream.size();
      after += smaller->stream.size();
    }
  }
  EXPECT_LT(after, before * 99 / 100);
}

TEST(SmallerView, KeepsTheFactorsThatErrorWasMadeFor) {
  std::mt19937 random(13);
  const EncodedView coded = encodeView(bakedLike(random, 0, false), 3);
  const EncodedView smaller = smallerView(coded).value();
  EXPECT_LT(smaller.stream.size(), coded.stream.size());
  const auto firstTwo = [](const EncodedView& view) {
    Bytes bytes(5 * size_t{view.width} * view.height + 2);
    EXPECT_TRUE(zlibDecompressUpTo(view.stream, bytes).has_value());
    return std::pair(bytes[0], bytes[1]);
  };
  EXPECT_EQ(firstTwo(smaller), firstTwo(coded));
}

TEST(SmallerView, RefusesAStreamThatDoesNotDecode) {
  std::mt19937 random(14);
  EncodedView coded = encodeView(bakedLike(random, 0, false));
  coded.stream.back() ^= std::byte{1};
  EXPECT_EQ(smallerView(coded).error().kind, ErrorKind::corrupt);
}

TEST(ViewPageCoding, HoldsNoViewsAndViewsOfNothing) {
  ViewPage page;
  EXPECT_EQ(decode(encodeViewPage(page), page), page);
  page.views.resize(2);
  page.views[1].view = 41;
  EXPECT_EQ(decodedSizeBytes(page), 0u);
  EXPECT_EQ(decode(encodeViewPage(page), page), page);
}

TEST(ViewPageCoding, HoldsTheSmallestAndTheLargestImage) {
  ViewPage page;
  page.views.resize(2);
  page.views[0] = {
      .view = 0, .x0 = 1023, .y0 = 1023, .width = 1, .height = 1, .rgba = {1, 2, 3, 4}, .depth = {9}, .normal = {}};
  page.views[1] = {
      .view = 1, .width = 1024, .height = 1024, .depthMin = -1, .depthMax = 1, .rgba = {}, .depth = {}, .normal = {}};
  for (size_t i = 0; i < 1024 * 1024; ++i) {
    for (size_t k = 0; k < 4; ++k) page.views[1].rgba.push_back(static_cast<uint8_t>(i / 1024 * k));
    page.views[1].depth.push_back(static_cast<uint8_t>(i % 1024 / 4));
  }
  const auto decoded = decodeViewPage(encodeViewPage(page), {2, 1024, decodedSizeBytes(page)});
  ASSERT_TRUE(decoded.has_value()) << decoded.error().message;
  EXPECT_TRUE(*decoded == page);
}

TEST(ViewPageCoding, TakesFewBytesForFlatAreasAndForGradients) {
  std::mt19937 random(2);
  for (const int kind : {1, 2}) {
    ViewPage page;
    page.views.push_back(samples::randomView(random, 0, 64, true, kind));
    EXPECT_LT(encodeViewPage(page).size(), decodedSizeBytes(page) / (kind == 1 ? 2 : 10)) << kind;
  }
}

std::vector<EncodedView> encodedOneByOne(const ViewPage& page) {
  std::vector<EncodedView> views;
  for (const ViewImage& image : page.views) views.push_back(encodeView(image));
  return views;
}

TEST(ViewPageCoding, PutsTogetherViewsCodedOneByOne) {
  for (uint32_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const ViewPage page = randomPage(seed, seed % 2);
    const std::vector<EncodedView> views = encodedOneByOne(page);
    EXPECT_EQ(viewPageOf(views).bytes, encodeViewPage(page));
    EXPECT_EQ(decodedSizeBytes(views), decodedSizeBytes(page));
    const auto taken = viewsOfPage(viewPageOf(views).bytes, {kViewCount, kImageSize, decodedSizeBytes(views)});
    ASSERT_TRUE(taken.has_value()) << taken.error().message;
    EXPECT_EQ(*taken, views);
  }
}

TEST(ViewPageCoding, StoresEqualStreamsOnce) {
  std::mt19937 random(8);
  ViewPage page;
  page.views = {samples::randomView(random, 1, 32, true, 2), samples::randomView(random, 2, 32, true, 0)};
  const Bytes two = encodeViewPage(page);
  // Equal texels elsewhere and at other depths are equal streams.
  page.views.push_back(page.views[0]);
  page.views[2].view = 9;
  page.views[2].depthMax += 1;
  const EncodedViewPage three = viewPageOf(encodedOneByOne(page));
  EXPECT_EQ(three.duplicates, 1u);
  EXPECT_EQ(three.duplicateBytes, encodeView(page.views[0]).stream.size());
  EXPECT_EQ(three.bytes.size(), two.size() + kViewHeaderBytes);
  EXPECT_EQ(decode(three.bytes, page), page);
}

TEST(ViewPageCoding, TakesNoBytesForConstantChannelsAndEmptyTexels) {
  std::mt19937 random(11);
  ViewImage full = bakedLike(random, 0, false);
  for (uint8_t& value : full.rgba) value = value > 0 ? 200 : 0;
  std::fill(full.depth.begin(), full.depth.end(), uint8_t{0});
  EXPECT_EQ(encodeView(full).coding >> 28, 1u);
  // Coverage alone: all other channels are constant where it is not 0.
  EXPECT_EQ(encodeView(full).coding & ~7u, 0x10005b68u);
}

// 1280 equal views of 1024 x 1024 constant texels would be gigabytes out of some kilobytes.
TEST(ViewPageCoding, SharesNoMoreThanAStreamCouldHold) {
  EncodedView view = encodeView({.width = 256,
                                 .height = 256,
                                 .rgba = std::vector<uint8_t>(4 * 256 * 256),
                                 .depth = std::vector<uint8_t>(256 * 256),
                                 .normal = {}});
  std::vector<EncodedView> views;
  for (; view.view < 40; ++view.view) views.push_back(view);
  const EncodedViewPage page = viewPageOf(views);
  EXPECT_GE(kMaxZlibRatio * page.bytes.size(), decodedSizeBytes(views));
  EXPECT_EQ(viewsOfPage(page.bytes, {40, 256, decodedSizeBytes(views)}), views);
}

TEST(ViewPageCoding, RefusesEveryTruncationAndOneByteMore) {
  const ViewPage page = randomPage(3, true);
  Bytes bytes = encodeViewPage(page);
  for (size_t length = 0; length < bytes.size(); ++length) {
    const auto decoded = decode(std::span(bytes).first(length), page);
    ASSERT_FALSE(decoded.has_value()) << length;
    EXPECT_EQ(decoded.error().kind, ErrorKind::corrupt);
  }
  bytes.push_back(std::byte{0});
  EXPECT_FALSE(decode(bytes, page).has_value());
}

TEST(ViewPageCoding, RefusesWhatTheLimitsDoNotAllow) {
  const ViewPage page = randomPage(4, false);
  const Bytes bytes = encodeViewPage(page);
  const uint32_t size = decodedSizeBytes(page), views = page.views.back().view + 1;
  uint32_t reach = 0;
  for (const ViewImage& view : page.views) reach = std::max({reach, view.x0 + view.width, view.y0 + view.height});
  EXPECT_TRUE(decodeViewPage(bytes, {views, reach, size}).has_value());
  EXPECT_FALSE(decodeViewPage(bytes, {views - 1, reach, size}).has_value());
  EXPECT_FALSE(decodeViewPage(bytes, {views, reach - 1, size}).has_value());
  EXPECT_FALSE(decodeViewPage(bytes, {views, reach, size - 1}).has_value());
}

// Byte ranges of a view's header and values that none of them may have here.
TEST(ViewPageCoding, RefusesHeadersThatLie) {
  ViewPage page;
  std::mt19937 random(5);
  page.views = {samples::randomView(random, 3, 32, false, 0), samples::randomView(random, 7, 32, false, 0)};
  const Bytes bytes = encodeViewPage(page);
  const auto refused = [&](size_t offset, size_t size, uint32_t value) {
    Bytes changed = bytes;
    setNumber(changed, offset, size, value);
    return !decode(changed, page).has_value();
  };
  for (const uint32_t count : {0u, 1u, 3u, 43u, 1u << 31, ~0u}) EXPECT_TRUE(refused(0, 4, count)) << count;
  for (const uint32_t planes : {0u, 4u, 6u, 7u, 8u, ~0u}) EXPECT_TRUE(refused(4, 4, planes)) << planes;
  const size_t header = kPageHeaderBytes;
  for (const uint32_t view : {7u, 8u, 42u, ~0u}) EXPECT_TRUE(refused(header, 4, view)) << view;
  for (const size_t field : {4u, 6u}) EXPECT_TRUE(refused(header + field, 2, 64)) << field;
  for (const size_t field : {8u, 10u})
    for (const uint32_t extent : {0u, 65u, 65535u}) EXPECT_TRUE(refused(header + field, 2, extent)) << field;
  const auto nan = std::bit_cast<uint32_t>(std::numeric_limits<float>::quiet_NaN());
  for (const size_t field : {12u, 16u}) EXPECT_TRUE(refused(header + field, 4, nan)) << field;
  EXPECT_TRUE(refused(header + 16, 4, std::bit_cast<uint32_t>(-2.0f)));
  for (const uint32_t coding :
       {0x20000000u, 0x00000005u, 0x10000006u, 0x10000000u | 1u << 15, 6u << 12, 1u << 24, 1u << 27})
    EXPECT_TRUE(refused(header + 20, 4, coding)) << coding;
  for (const size_t field :
       {header + 24, header + 28, header + kViewHeaderBytes + 24, header + kViewHeaderBytes + 28}) {
    const uint32_t right = number(bytes, field, 4);
    for (const uint32_t wrong : {0u, 1u, right - 1, right + 1, static_cast<uint32_t>(bytes.size()), ~0u})
      EXPECT_TRUE(refused(field, 4, wrong)) << field << ' ' << wrong;
  }
}

TEST(ViewPageCoding, AllocatesNothingForAClaimNoDeflateStreamCanKeep) {
  Bytes bytes(kPageHeaderBytes + kViewHeaderBytes + 100);
  setNumber(bytes, 0, 4, 1);
  setNumber(bytes, 4, 4, 5);
  setNumber(bytes, kPageHeaderBytes + 8, 2, 1024);
  setNumber(bytes, kPageHeaderBytes + 10, 2, 1024);
  setNumber(bytes, kPageHeaderBytes + 24, 4, kPageHeaderBytes + kViewHeaderBytes);
  setNumber(bytes, kPageHeaderBytes + 28, 4, 100);
  const auto decoded = decodeViewPage(bytes, {1, 1024, ~uint64_t{0}});
  ASSERT_FALSE(decoded.has_value());
  EXPECT_NE(decoded.error().message.find("at most 144480 decoded bytes"), std::string::npos) << decoded.error().message;
}

TEST(ViewPageCoding, SurvivesDamage) {
  const ViewPage page = randomPage(6, true);
  const Bytes bytes = encodeViewPage(page);
  const auto headers = static_cast<uint32_t>(kPageHeaderBytes + page.views.size() * kViewHeaderBytes);
  std::mt19937 random(6);
  for (int round = 0; round < 20000; ++round) {
    Bytes damaged = bytes;
    const uint32_t reach = round % 2 ? headers : static_cast<uint32_t>(bytes.size());
    for (uint32_t i = 0; i <= samples::below(random, 3); ++i)
      damaged[samples::below(random, reach)] = static_cast<std::byte>(random());
    const auto decoded = decode(damaged, page);
    if (!decoded) continue;
    ASSERT_LE(decodedSizeBytes(*decoded), decodedSizeBytes(page)) << round;
    for (const ViewImage& view : decoded->views) {
      ASSERT_LE(std::max(view.x0 + view.width, view.y0 + view.height), kImageSize) << round;
      ASSERT_EQ(view.rgba.size(), size_t{4} * view.width * view.height) << round;
    }
  }
}

}  // namespace
}  // namespace farcell
