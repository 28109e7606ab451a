// Pages in memory, and their coding. A page is the unit that is read, checked, cached and evicted.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "cache/base/result.h"
#include "cache/schema/view_form.h"

namespace farcell {

// The full triangles of a leaf, clipped to its cube. Positions are grid steps from the cube's lowest corner,
// each in [0, 2^(bits-level)]; vertices are shared wherever all that they have agrees.
struct GeometryPage {
  std::vector<glm::uvec3> positions{};
  std::vector<uint32_t> colours{};  // 0x00BBGGRR per vertex, and kSeenFromFront; empty: the model has none
  std::vector<uint32_t> normals{};  // octahedral, low 16 bits x, high 16 bits y, each snorm16; empty: flat faces
  // On the atlas of the page (TexturePage), low 16 bits u, high 16 bits v, each unorm16: there the albedo is the colour
  // times the texture, channel by channel. Empty: the page has no atlas.
  std::vector<uint32_t> coordinates{};
  std::vector<uint32_t> indices{};  // three a triangle
  // What each triangle shows, lit, 0x00BBGGRR: the mean of what a simplified mesh's triangle stands for. Empty: the
  // triangles show their vertices' colours under the light.
  std::vector<uint32_t> shown{};
  bool operator==(const GeometryPage&) const = default;
};

// Set in the colours of all corners of a leaf's triangle that is seen only by those for whom they run
// counter-clockwise.
inline constexpr uint32_t kSeenFromFront = 1u << 24;

// Of GeometryPage::coordinates, from (0, 0), the lowest corner of the atlas, to (1, 1).
inline glm::vec2 unpackedCoordinates(uint32_t packed) {
  return glm::vec2(static_cast<float>(packed & 0xffff), static_cast<float>(packed >> 16)) / 65535.0f;
}

// Consecutive levels of the atlas of a geometry page, an image that its triangles look at. Level 0 is the finest, each
// next one has half its edges.
struct TexturePage {
  uint32_t width = 0, height = 0;  // of level 0: multiples of 2^(levelCount - 1)
  uint32_t channels = 3;           // R, G, B; 4: premultiplied by alpha, and alpha, the share that is surface
  uint32_t levelCount = 0;         // of the whole atlas
  uint32_t firstLevel = 0;
  std::vector<std::vector<uint8_t>> levels;  // from firstLevel on; rows of texels, the lowest first
  bool operator==(const TexturePage&) const = default;
};
inline constexpr uint32_t kMaxTextureEdge = 2048;
inline constexpr uint32_t kMaxAtlasLevels = 6;

// Group 0 of an atlas holds the coarsest levels, which are always needed, each next group the level before: a far leaf
// reads little. PageRecord::group is part * kAtlasGroups + group.
inline constexpr uint32_t kAtlasGroups = 8;
// The first level of group 0: levels of at most these texels, and at least one.
inline constexpr uint64_t kCoarseTexels = uint64_t{1} << 16;
uint32_t firstCoarseLevel(const TexturePage& atlas);
// The pages of a whole atlas, by group; and what pages of consecutive groups from 0 on hold together: corrupt where
// they do not belong together.
std::vector<TexturePage> pagesOfAtlas(const TexturePage& atlas);
Result<TexturePage> atlasOfPages(std::span<const TexturePage> pages);

// One baked view, cropped to the rectangle of texels that hold anything (after depth was dilated).
struct ViewImage {
  uint32_t view = 0;               // index into the viewpoint set
  uint32_t x0 = 0, y0 = 0;         // lowest texel of the rectangle
  uint32_t width = 0, height = 0;  // texels; 0 x 0: nothing is seen from here
  float depthMin = 0;              // w of depth value 1, in half sides of the cell (view_frame.h)
  float depthMax = 0;              // w of depth value 255
  std::vector<uint8_t> rgba;       // 4 * width * height, premultiplied by coverage, which is alpha: lit, or albedo
  std::vector<uint8_t> depth;      // width * height; 0: unknown; else depthMin + (d - 1) / 254 * (depthMax - depthMin)
  // 3 * width * height, of the mean vector of the normals: octahedral, unorm8 each, and its length. Empty when lit.
  std::vector<uint8_t> normal;
  bool operator==(const ViewImage&) const = default;
};

// Views of one cell that lie near each other on the sphere, by rising view index.
struct ViewPage {
  std::vector<ViewImage> views;
  bool operator==(const ViewPage&) const = default;
};

// What a decoder may believe: nothing larger is allocated, whatever the bytes claim.
struct GeometryLimits {
  uint32_t maxCoordinate;  // 2^(bits-level)
  uint64_t maxDecodedBytes;
};
struct TextureLimits {
  uint64_t maxDecodedBytes;
};
struct ViewLimits {
  uint32_t viewCount;  // size of the viewpoint set
  uint32_t imageSize;
  uint64_t maxDecodedBytes;
};
inline ViewLimits viewLimitsOf(const ViewForm& form, uint64_t maxDecodedBytes) {
  return {static_cast<uint32_t>(form.views), static_cast<uint32_t>(form.imageSize), maxDecodedBytes};
}

// The same triangles in an order of strips, which takes few bytes and draws fast: each triangle keeps its three
// vertices and its winding but may start at another corner; vertices no triangle uses are dropped. Deterministic.
// Coding itself keeps the order it is given: call this first. REQUIRES: indices in range, three a triangle.
GeometryPage optimisedOrder(const GeometryPage& page);

// Coding is deterministic. Encoders expect valid input (CHECK).
std::vector<std::byte> encodeGeometryPage(const GeometryPage& page);
std::vector<std::byte> encodeViewPage(const ViewPage& page);
std::vector<std::byte> encodeTexturePage(const TexturePage& page);
// The same page in fewer bytes if deflate finds them when it takes its time; else `bytes`.
Result<std::vector<std::byte>> smallerGeometryPage(std::span<const std::byte> bytes, const GeometryLimits& limits);
Result<std::vector<std::byte>> smallerTexturePage(std::span<const std::byte> bytes, const TextureLimits& limits);
// What the decoded page occupies in memory: PageRecord::decodedBytes.
uint32_t decodedSizeBytes(const GeometryPage& page);
uint32_t decodedSizeBytes(const ViewPage& page);
uint32_t decodedSizeBytes(const TexturePage& page);

// Decoders trust nothing: a wrong byte is an error of kind corrupt (without a path: the caller adds it).
Result<GeometryPage> decodeGeometryPage(std::span<const std::byte> bytes, const GeometryLimits& limits);
Result<ViewPage> decodeViewPage(std::span<const std::byte> bytes, const ViewLimits& limits);
Result<TexturePage> decodeTexturePage(std::span<const std::byte> bytes, const TextureLimits& limits);

}  // namespace farcell
