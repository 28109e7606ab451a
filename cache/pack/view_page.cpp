// The coding of a page of views; FORMAT.md, "Page of views".
#include <array>
#include <cmath>
#include <utility>

#include "cache/base/check.h"
#include "cache/pack/bytes.h"
#include "cache/pack/pages.h"
#include "cache/pack/view_planes.h"
#include "cache/pack/zlib_stream.h"

namespace farcell {
namespace {

constexpr int kViewZlibLevel = 6;
constexpr uint64_t kPageHeaderBytes = 8;
constexpr uint64_t kViewHeaderBytes = 28;
constexpr uint32_t kMaxImageSize = 65535;  // as far as the header's fields reach

struct ViewHeader {
  ViewImage image;  // without its planes
  uint64_t headerOffset = 0;
  ViewCoding coding = 0;
  uint32_t streamEnd = 0;
  uint64_t texels() const { return uint64_t{image.width} * image.height; }
};

uint32_t planeCountOf(const ViewPage& page) {
  for (const ViewImage& view : page.views)
    if (!view.normal.empty()) return kPlanesWithNormals;
  return kPlanesWithoutNormals;
}

void writeHeader(ByteWriter& out, const ViewImage& view, ViewCoding coding, uint64_t streamEnd) {
  FARCELL_CHECK((view.width == 0) == (view.height == 0));
  FARCELL_CHECK(std::max(view.x0 + view.width, view.y0 + view.height) <= kMaxImageSize);
  FARCELL_CHECK(std::isfinite(view.depthMin) && std::isfinite(view.depthMax) && view.depthMin <= view.depthMax);
  FARCELL_CHECK(streamEnd <= UINT32_MAX);
  out.u32(view.view);
  for (const uint32_t value : {view.x0, view.y0, view.width, view.height}) out.u16(static_cast<uint16_t>(value));
  out.f32(view.depthMin);
  out.f32(view.depthMax);
  out.u32(coding);
  out.u32(static_cast<uint32_t>(streamEnd));
}

ViewHeader readHeader(ByteReader& in) {
  ViewHeader header;
  header.headerOffset = in.position();
  ViewImage& image = header.image;
  image.view = in.u32();
  for (uint32_t* value : {&image.x0, &image.y0, &image.width, &image.height}) *value = in.u16();
  image.depthMin = in.f32();
  image.depthMax = in.f32();
  header.coding = in.u32();
  header.streamEnd = in.u32();
  return header;
}

tl::unexpected<Error> wrong(uint64_t offset, const std::string& expected, const std::string& found) {
  return fail(ErrorKind::corrupt, "byte {} of the page: expected {}, found {}", offset, expected, found);
}

Result<> checkHeader(const ViewHeader& header, uint32_t planeCount, const ViewLimits& limits) {
  const ViewImage& image = header.image;
  const uint64_t at = header.headerOffset;
  if (image.view >= limits.viewCount)
    return wrong(at, fmt::format("a view below {}", limits.viewCount), fmt::format("{}", image.view));
  if ((image.width == 0) != (image.height == 0) || image.x0 + image.width > limits.imageSize ||
      image.y0 + image.height > limits.imageSize)
    return wrong(at + 4, fmt::format("a rectangle within {0} x {0}", limits.imageSize),
                 fmt::format("{} x {} at {}, {}", image.width, image.height, image.x0, image.y0));
  if (!std::isfinite(image.depthMin) || !std::isfinite(image.depthMax) || image.depthMin > image.depthMax)
    return wrong(at + 12, "a finite, rising depth range", fmt::format("{}, {}", image.depthMin, image.depthMax));
  if (image.width == 0 ? header.coding != 0 : !codingValid(header.coding, planeCount))
    return wrong(at + 20, fmt::format("a coding of {} planes", planeCount), fmt::format("{:#x}", header.coding));
  return {};
}

// All headers, checked against each other, the page's size and the limits.
Result<std::vector<ViewHeader>> readHeaders(std::span<const std::byte> bytes, const ViewLimits& limits,
                                            uint32_t& planeCount) {
  ByteReader in(bytes);
  const uint32_t viewCount = in.u32();
  planeCount = in.u32();
  if (!in.ok() || viewCount > limits.viewCount || viewCount * kViewHeaderBytes > in.remaining())
    return wrong(0, fmt::format("at most {} views and their headers", limits.viewCount),
                 fmt::format("{} in a page of {} bytes", viewCount, bytes.size()));
  if (planeCount != kPlanesWithoutNormals && planeCount != kPlanesWithNormals)
    return wrong(4, "5 or 7 planes", fmt::format("{}", planeCount));
  std::vector<ViewHeader> headers;
  uint64_t streamBegin = kPageHeaderBytes + viewCount * kViewHeaderBytes;
  uint64_t decodedBytes = 0;
  for (uint32_t i = 0; i < viewCount; ++i) {
    const ViewHeader header = readHeader(in);
    FARCELL_TRY(checkHeader(header, planeCount, limits));
    if (i > 0 && header.image.view <= headers.back().image.view)
      return wrong(header.headerOffset, fmt::format("a view above {}", headers.back().image.view),
                   fmt::format("{}", header.image.view));
    const uint64_t rawBytes = planeCount * header.texels();
    decodedBytes += rawBytes;
    if (header.streamEnd < streamBegin || header.streamEnd > bytes.size() ||
        (rawBytes == 0) != (header.streamEnd == streamBegin) ||
        rawBytes > (header.streamEnd - streamBegin) * kMaxZlibRatio)
      return wrong(
          header.headerOffset + 24,
          fmt::format("the end of a stream of {} bytes from {} in a page of {}", rawBytes, streamBegin, bytes.size()),
          fmt::format("{}", header.streamEnd));
    streamBegin = header.streamEnd;
    headers.push_back(header);
  }
  if (decodedBytes > limits.maxDecodedBytes)
    return wrong(0, fmt::format("at most {} decoded bytes", limits.maxDecodedBytes), fmt::format("{}", decodedBytes));
  if (streamBegin != bytes.size())
    return wrong(streamBegin, "the end of the page", fmt::format("{} more bytes", bytes.size() - streamBegin));
  return headers;
}

struct DeflatedView {
  std::vector<std::byte> stream;
  ViewCoding coding = 0;
};

// Whether half of the covered texels have a colour met before: then texels beat planes or lose by a percent, which is
// not worth deflating twice.
bool mostlyRepeats(const ViewImage& view) {
  constexpr uint32_t kSlotBits = 12;
  std::array<uint32_t, 1u << kSlotBits> seen{};
  size_t covered = 0;
  size_t repeated = 0;
  for (size_t i = 0; i < view.rgba.size(); i += 4) {
    uint32_t colour = 0;
    for (size_t k = 0; k < 4; ++k) colour |= uint32_t{view.rgba[i + k]} << (8 * k);
    if (colour == 0) continue;
    uint32_t& slot = seen[colour * 0x9e3779b1u >> (32 - kSlotBits)];
    ++covered;
    if (std::exchange(slot, colour) == colour) ++repeated;
  }
  return 2 * repeated >= covered;
}

DeflatedView smallerArrangement(const ViewImage& view, uint32_t planeCount) {
  DeflatedView best;
  for (const Arrangement arrangement : {Arrangement::texels, Arrangement::planes}) {
    if (arrangement == Arrangement::planes && mostlyRepeats(view)) break;
    const ArrangedView arranged = arrangedFromView(view, planeCount, arrangement);
    std::vector<std::byte> stream = zlibCompress(arranged.bytes, kViewZlibLevel);
    if (best.stream.empty() || stream.size() < best.stream.size()) best = {std::move(stream), arranged.coding};
  }
  return best;
}

}  // namespace

std::vector<std::byte> encodeViewPage(const ViewPage& page) {
  const uint32_t planeCount = planeCountOf(page);
  ByteWriter headers;
  ByteWriter streams;
  headers.u32(static_cast<uint32_t>(page.views.size()));
  headers.u32(planeCount);
  const uint64_t streamsBegin = kPageHeaderBytes + page.views.size() * kViewHeaderBytes;
  for (size_t i = 0; i < page.views.size(); ++i) {
    const ViewImage& view = page.views[i];
    FARCELL_CHECK(i == 0 || page.views[i - 1].view < view.view);
    ViewCoding coding = 0;
    if (view.width > 0) {
      const DeflatedView deflated = smallerArrangement(view, planeCount);
      coding = deflated.coding;
      streams.append(deflated.stream);
    }
    writeHeader(headers, view, coding, streamsBegin + streams.bytes.size());
  }
  headers.append(streams.bytes);
  return std::move(headers.bytes);
}

Result<ViewPage> decodeViewPage(std::span<const std::byte> bytes, const ViewLimits& limits) {
  uint32_t planeCount = 0;
  FARCELL_ASSIGN(const std::vector<ViewHeader> headers, readHeaders(bytes, limits, planeCount));
  ViewPage page;
  std::vector<std::byte> planes;
  size_t streamBegin = kPageHeaderBytes + headers.size() * kViewHeaderBytes;
  for (const ViewHeader& header : headers) {
    ViewImage& view = page.views.emplace_back(header.image);
    planes.resize(planeCount * header.texels());
    if (!planes.empty()) {
      const auto stream = bytes.subspan(streamBegin, header.streamEnd - streamBegin);
      if (const auto inflated = zlibDecompress(stream, planes); !inflated)
        return fail(ErrorKind::corrupt, "byte {} of the page: {}", streamBegin, inflated.error().message);
      viewFromArranged(planes, planeCount, header.coding, view);
    }
    streamBegin = header.streamEnd;
  }
  return page;
}

uint32_t decodedSizeBytes(const ViewPage& page) {
  uint64_t bytes = 0;
  for (const ViewImage& view : page.views) bytes += view.rgba.size() + view.depth.size() + view.normal.size();
  FARCELL_CHECK(bytes <= UINT32_MAX);
  return static_cast<uint32_t>(bytes);
}

}  // namespace farcell
