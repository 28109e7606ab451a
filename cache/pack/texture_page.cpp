// The coding of a page of an atlas; FORMAT.md, "Page of textures".
#include <algorithm>
#include <array>

#include "cache/base/check.h"
#include "cache/pack/bytes.h"
#include "cache/pack/pages.h"
#include "cache/pack/plane_filter.h"
#include "cache/pack/zlib_stream.h"

namespace farcell {
namespace {

constexpr int kTextureZlibLevel = 6;
constexpr uint64_t kPageHeaderBytes = 24;
constexpr uint32_t kFilterBits = 4;
constexpr size_t kGreen = 1;

using Plane = std::vector<uint8_t>;

PlaneSize sizeOf(const TexturePage& page, uint32_t level) { return {page.width >> level, page.height >> level}; }

uint64_t texelsOf(const TexturePage& page) {
  uint64_t texels = 0;
  for (uint32_t i = 0; i < page.levels.size(); ++i) texels += sizeOf(page, page.firstLevel + i).texels();
  return texels;
}

tl::unexpected<Error> wrong(uint64_t offset, const std::string& expected, const std::string& found) {
  return fail(ErrorKind::corrupt, "byte {} of the page: expected {}, found {}", offset, expected, found);
}

// Red and blue follow green.
bool followsGreen(uint32_t channel) { return channel == 0 || channel == 2; }

Plane planeOf(const std::vector<uint8_t>& texels, uint32_t channel, uint32_t channels) {
  Plane plane(texels.size() / channels);
  for (size_t i = 0; i < plane.size(); ++i) {
    const uint8_t green = followsGreen(channel) ? texels[i * channels + kGreen] : uint8_t{0};
    plane[i] = static_cast<uint8_t>(texels[i * channels + channel] - green);
  }
  return plane;
}

// The header, with levels as large as they will be, but not filled.
Result<TexturePage> readHeader(ByteReader& in, size_t pageBytes, const TextureLimits& limits) {
  TexturePage page;
  for (uint32_t* value : {&page.width, &page.height, &page.channels, &page.levelCount, &page.firstLevel})
    *value = in.u32();
  const uint32_t count = in.u32();
  if (!in.ok()) return wrong(0, fmt::format("{} bytes", kPageHeaderBytes), fmt::format("{}", pageBytes));
  if (page.levelCount < 1 || page.levelCount > kMaxAtlasLevels || count < 1 || page.firstLevel >= page.levelCount ||
      count > page.levelCount - page.firstLevel)
    return wrong(12, fmt::format("levels of an atlas of up to {}", kMaxAtlasLevels),
                 fmt::format("{} from {} of {}", count, page.firstLevel, page.levelCount));
  const uint32_t unit = 1u << (page.levelCount - 1);
  if (page.width < 1 || page.height < 1 || std::max(page.width, page.height) > kMaxTextureEdge ||
      page.width % unit != 0 || page.height % unit != 0)
    return wrong(0, fmt::format("edges of up to {}, multiples of {}", kMaxTextureEdge, unit),
                 fmt::format("{} x {}", page.width, page.height));
  if (page.channels != 3 && page.channels != 4) return wrong(8, "3 or 4 channels", fmt::format("{}", page.channels));
  page.levels.resize(count);
  const uint64_t bytes = page.channels * texelsOf(page);
  const uint64_t most = std::min(limits.maxDecodedBytes, in.remaining() * kMaxZlibRatio);
  if (bytes > most) return wrong(0, fmt::format("texels of at most {} bytes", most), fmt::format("{}", bytes));
  return page;
}

// Filters first, a byte for each plane, then the planes.
uint64_t payloadBytes(const TexturePage& page) {
  return page.channels * page.levels.size() + page.channels * texelsOf(page);
}

Result<> fill(TexturePage& page, std::span<const std::byte> payload) {
  ByteReader in(payload);
  const std::span<const std::byte> filters = in.take(page.channels * page.levels.size());
  for (uint32_t i = 0; i < page.levels.size(); ++i) {
    const PlaneSize size = sizeOf(page, page.firstLevel + i);
    std::vector<uint8_t>& texels = page.levels[i];
    texels.resize(page.channels * size.texels());
    // Green first: others follow it.
    std::array<uint32_t, 4> order = {1, 0, 2, 3};
    for (const uint32_t channel : std::span(order).first(page.channels)) {
      const auto filter = std::to_integer<uint8_t>(filters[i * page.channels + channel]);
      if (filter > static_cast<uint8_t>(PlaneFilter::gradient))
        return fail(ErrorKind::corrupt, "level {}: expected a filter of 0 to 4, found {}", page.firstLevel + i, filter);
      const std::span<const std::byte> stored = in.take(size.texels());
      Plane plane(size.texels());
      std::transform(stored.begin(), stored.end(), plane.begin(), std::to_integer<uint8_t>);
      undoFilter(static_cast<PlaneFilter>(filter), plane, size);
      for (size_t t = 0; t < plane.size(); ++t) {
        const uint8_t green = followsGreen(channel) ? texels[t * page.channels + kGreen] : uint8_t{0};
        texels[t * page.channels + channel] = static_cast<uint8_t>(plane[t] + green);
      }
    }
  }
  return {};
}

std::vector<std::byte> payloadOf(const TexturePage& page) {
  std::vector<std::byte> filters(page.channels * page.levels.size());
  ByteWriter planes;
  for (uint32_t i = 0; i < page.levels.size(); ++i) {
    const PlaneSize size = sizeOf(page, page.firstLevel + i);
    const std::vector<uint8_t> all(size.texels(), 255);
    std::array<uint32_t, 4> order = {1, 0, 2, 3};
    for (const uint32_t channel : std::span(order).first(page.channels)) {
      const Plane plane = planeOf(page.levels[i], channel, page.channels);
      const PlaneFilter filter = likelyFilter(plane, all, size);
      filters[i * page.channels + channel] = static_cast<std::byte>(filter);
      const Plane rest = residuals(filter, plane, all, size);
      planes.append(std::as_bytes(std::span(rest)));
    }
  }
  filters.insert(filters.end(), planes.bytes.begin(), planes.bytes.end());
  return filters;
}

void checkValid(const TexturePage& page) {
  FARCELL_CHECK(page.levelCount >= 1 && page.levelCount <= kMaxAtlasLevels && !page.levels.empty());
  FARCELL_CHECK(page.firstLevel + page.levels.size() <= page.levelCount);
  FARCELL_CHECK(page.channels == 3 || page.channels == 4);
  const uint32_t unit = 1u << (page.levelCount - 1);
  FARCELL_CHECK(page.width > 0 && page.width <= kMaxTextureEdge && page.width % unit == 0);
  FARCELL_CHECK(page.height > 0 && page.height <= kMaxTextureEdge && page.height % unit == 0);
  for (uint32_t i = 0; i < page.levels.size(); ++i)
    FARCELL_CHECK_EQ(page.levels[i].size(), page.channels * sizeOf(page, page.firstLevel + i).texels());
}

}  // namespace

uint32_t firstCoarseLevel(const TexturePage& atlas) {
  uint32_t level = 0;
  while (level + 1 < atlas.levelCount && sizeOf(atlas, level).texels() > kCoarseTexels) ++level;
  return level;
}

std::vector<TexturePage> pagesOfAtlas(const TexturePage& atlas) {
  FARCELL_CHECK(atlas.firstLevel == 0 && atlas.levels.size() == atlas.levelCount);
  const uint32_t coarse = firstCoarseLevel(atlas);
  std::vector<TexturePage> pages;
  for (uint32_t level = coarse + 1; level-- > 0;) {
    TexturePage page{atlas.width, atlas.height, atlas.channels, atlas.levelCount, level, {}};
    const auto first = atlas.levels.begin() + level;
    page.levels.assign(first, level == coarse ? atlas.levels.end() : first + 1);
    pages.push_back(std::move(page));
  }
  return pages;
}

Result<TexturePage> atlasOfPages(std::span<const TexturePage> pages) {
  FARCELL_CHECK(!pages.empty());
  TexturePage atlas = pages[0];
  for (const TexturePage& page : pages.subspan(1)) {
    if (page.width != atlas.width || page.height != atlas.height || page.channels != atlas.channels ||
        page.levelCount != atlas.levelCount || page.firstLevel + page.levels.size() != atlas.firstLevel)
      return fail(ErrorKind::corrupt, "expected pages of one atlas of {} x {}, found level {} of one of {} x {}",
                  atlas.width, atlas.height, page.firstLevel, page.width, page.height);
    atlas.levels.insert(atlas.levels.begin(), page.levels.begin(), page.levels.end());
    atlas.firstLevel = page.firstLevel;
  }
  if (atlas.firstLevel != 0)
    return fail(ErrorKind::corrupt, "expected all {} levels, found those from {} on", atlas.levelCount,
                atlas.firstLevel);
  return atlas;
}

std::vector<std::byte> encodeTexturePage(const TexturePage& page) {
  checkValid(page);
  ByteWriter out;
  for (const uint32_t value : {page.width, page.height, page.channels, page.levelCount, page.firstLevel})
    out.u32(value);
  out.u32(static_cast<uint32_t>(page.levels.size()));
  out.append(zlibCompress(payloadOf(page), kTextureZlibLevel));
  return std::move(out.bytes);
}

Result<TexturePage> decodeTexturePage(std::span<const std::byte> bytes, const TextureLimits& limits) {
  ByteReader in(bytes);
  FARCELL_ASSIGN(TexturePage page, readHeader(in, bytes.size(), limits));
  std::vector<std::byte> payload(payloadBytes(page));
  const Result<> filled = zlibDecompress(in.rest(), payload).and_then([&] { return fill(page, payload); });
  if (!filled) return fail(ErrorKind::corrupt, "byte {} of the page: {}", kPageHeaderBytes, filled.error().message);
  return page;
}

Result<std::vector<std::byte>> smallerTexturePage(std::span<const std::byte> bytes, const TextureLimits& limits) {
  ByteReader in(bytes);
  FARCELL_ASSIGN(const TexturePage page, readHeader(in, bytes.size(), limits));
  std::vector<std::byte> payload(payloadBytes(page));
  FARCELL_TRY(zlibDecompress(in.rest(), payload));
  const std::vector<std::byte> stream = zlibCompress(payload, kSlowestZlibLevel);
  ByteWriter out;
  out.append(bytes.first(kPageHeaderBytes));
  out.append(stream.size() < in.remaining() ? std::span<const std::byte>(stream) : in.rest());
  return std::move(out.bytes);
}

uint32_t decodedSizeBytes(const TexturePage& page) { return static_cast<uint32_t>(page.channels * texelsOf(page)); }

}  // namespace farcell
