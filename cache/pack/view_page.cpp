// The coding of a page of views; FORMAT.md, "Page of views".
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "cache/base/check.h"
#include "cache/base/hash.h"
#include "cache/pack/bytes.h"
#include "cache/pack/encoded_view.h"
#include "cache/pack/pages.h"
#include "cache/pack/view_planes.h"
#include "cache/pack/zlib_stream.h"

namespace farcell {
namespace {

constexpr int kViewZlibLevel = 5;  // 6: 0.3 to 0.7 % fewer bytes, 1.4 times the time (tests/bench/codec/results.md)
constexpr uint64_t kPageHeaderBytes = 8;
constexpr uint64_t kViewHeaderBytes = 32;
constexpr uint32_t kMaxImageSize = 65535;  // as far as the header's fields reach

// Where the bytes of a stream lie in the page.
struct StreamPlace {
  uint64_t begin = 0;
  uint64_t bytes = 0;
  uint64_t end() const { return begin + bytes; }
  bool operator==(const StreamPlace&) const = default;
};

struct ViewHeader {
  EncodedView view;  // without its stream
  uint64_t headerOffset = 0;
  StreamPlace stream;
};

uint64_t texelsOf(const EncodedView& view) { return uint64_t{view.width} * view.height; }

uint32_t planeCountOf(const EncodedView& view) { return static_cast<uint32_t>(view.decodedBytes / texelsOf(view)); }

// Of a page: what all its views that are not empty agree on.
uint32_t planeCountOf(std::span<const EncodedView> views) {
  const auto seen = std::find_if(views.begin(), views.end(), [](const auto& view) { return view.decodedBytes > 0; });
  return seen == views.end() ? kPlanesWithoutNormals : planeCountOf(*seen);
}

void writeHeader(ByteWriter& out, const EncodedView& view, const StreamPlace& stream) {
  FARCELL_CHECK(stream.end() <= UINT32_MAX);
  out.u32(view.view);
  for (const uint32_t value : {view.x0, view.y0, view.width, view.height}) out.u16(static_cast<uint16_t>(value));
  out.f32(view.depthMin);
  out.f32(view.depthMax);
  out.u32(view.coding);
  out.u32(static_cast<uint32_t>(stream.begin));
  out.u32(static_cast<uint32_t>(stream.bytes));
}

ViewHeader readHeader(ByteReader& in) {
  ViewHeader header;
  header.headerOffset = in.position();
  EncodedView& view = header.view;
  view.view = in.u32();
  for (uint32_t* value : {&view.x0, &view.y0, &view.width, &view.height}) *value = in.u16();
  view.depthMin = in.f32();
  view.depthMax = in.f32();
  view.coding = in.u32();
  header.stream.begin = in.u32();
  header.stream.bytes = in.u32();
  return header;
}

tl::unexpected<Error> wrong(uint64_t offset, const std::string& expected, const std::string& found) {
  return fail(ErrorKind::corrupt, "byte {} of the page: expected {}, found {}", offset, expected, found);
}

Result<> checkHeader(const ViewHeader& header, uint32_t planeCount, const ViewLimits& limits) {
  const EncodedView& view = header.view;
  const uint64_t at = header.headerOffset;
  if (view.view >= limits.viewCount)
    return wrong(at, fmt::format("a view below {}", limits.viewCount), fmt::format("{}", view.view));
  if ((view.width == 0) != (view.height == 0) || view.x0 + view.width > limits.imageSize ||
      view.y0 + view.height > limits.imageSize)
    return wrong(at + 4, fmt::format("a rectangle within {0} x {0}", limits.imageSize),
                 fmt::format("{} x {} at {}, {}", view.width, view.height, view.x0, view.y0));
  if (!std::isfinite(view.depthMin) || !std::isfinite(view.depthMax) || view.depthMin > view.depthMax)
    return wrong(at + 12, "a finite, rising depth range", fmt::format("{}, {}", view.depthMin, view.depthMax));
  if (view.width == 0 ? view.coding != 0 : !codingValid(view.coding, planeCount))
    return wrong(at + 20, fmt::format("a coding of {} planes", planeCount), fmt::format("{:#x}", view.coding));
  return {};
}

// A stream begins where those before it end, or is one of them; an empty view has none.
Result<> checkStream(const ViewHeader& header, uint64_t rawBytes, std::span<const ViewHeader> before,
                     uint64_t streamsEnd, uint64_t pageBytes) {
  const StreamPlace& stream = header.stream;
  const auto shared = [&] {
    return std::any_of(before.begin(), before.end(), [&](const auto& earlier) { return earlier.stream == stream; });
  };
  const bool placed = rawBytes == 0 ? stream == StreamPlace{} : stream.begin == streamsEnd || shared();
  if (placed && (stream.bytes == 0) == (rawBytes == 0) && stream.end() <= pageBytes &&
      rawBytes <= stream.bytes * kMaxZlibRatio)
    return {};
  return wrong(header.headerOffset + 24,
               fmt::format("a stream of {} bytes from {} or of an earlier view in a page of {}", rawBytes, streamsEnd,
                           pageBytes),
               fmt::format("{} from {}", stream.bytes, stream.begin));
}

// All headers, checked against each other, the page's size and the limits.
Result<std::vector<ViewHeader>> readHeaders(std::span<const std::byte> bytes, const ViewLimits& limits) {
  ByteReader in(bytes);
  const uint32_t viewCount = in.u32();
  const uint32_t planeCount = in.u32();
  if (!in.ok() || viewCount > limits.viewCount || viewCount * kViewHeaderBytes > in.remaining())
    return wrong(0, fmt::format("at most {} views and their headers", limits.viewCount),
                 fmt::format("{} in a page of {} bytes", viewCount, bytes.size()));
  if (planeCount != kPlanesWithoutNormals && planeCount != kPlanesWithNormals)
    return wrong(4, "5 or 8 planes", fmt::format("{}", planeCount));
  std::vector<ViewHeader> headers;
  uint64_t streamsEnd = kPageHeaderBytes + viewCount * kViewHeaderBytes;
  // Shared streams must not make more of a page than one stream of its size could.
  const uint64_t mostDecoded = std::min({limits.maxDecodedBytes, bytes.size() * kMaxZlibRatio, uint64_t{UINT32_MAX}});
  uint64_t decodedBytes = 0;
  for (uint32_t i = 0; i < viewCount; ++i) {
    ViewHeader header = readHeader(in);
    FARCELL_TRY(checkHeader(header, planeCount, limits));
    if (i > 0 && header.view.view <= headers.back().view.view)
      return wrong(header.headerOffset, fmt::format("a view above {}", headers.back().view.view),
                   fmt::format("{}", header.view.view));
    const uint64_t rawBytes = planeCount * texelsOf(header.view);
    decodedBytes += rawBytes;
    if (decodedBytes > mostDecoded)
      return wrong(0, fmt::format("at most {} decoded bytes", mostDecoded), fmt::format("{}", decodedBytes));
    header.view.decodedBytes = static_cast<uint32_t>(rawBytes);
    FARCELL_TRY(checkStream(header, rawBytes, headers, streamsEnd, bytes.size()));
    streamsEnd = std::max(streamsEnd, header.stream.end());
    headers.push_back(std::move(header));
  }
  if (streamsEnd != bytes.size())
    return wrong(streamsEnd, "the end of the page", fmt::format("{} more bytes", bytes.size() - streamsEnd));
  return headers;
}

Result<ViewImage> decodeStream(std::span<const std::byte> stream, const EncodedView& header,
                               std::vector<std::byte>& arranged) {
  ViewImage image{.view = header.view,
                  .x0 = header.x0,
                  .y0 = header.y0,
                  .width = header.width,
                  .height = header.height,
                  .depthMin = header.depthMin,
                  .depthMax = header.depthMax,
                  .rgba = {},
                  .depth = {},
                  .normal = {}};
  if (header.decodedBytes == 0) return image;
  const uint32_t planeCount = planeCountOf(header);
  arranged.resize(arrangedBytesLimit(planeCount, texelsOf(header)));
  FARCELL_ASSIGN(const size_t used, zlibDecompressUpTo(stream, arranged));
  FARCELL_TRY(viewFromArranged(std::span(arranged).first(used), planeCount, header.coding, image));
  return image;
}

// Finds streams met before by their hash; equal hashes are compared.
class KnownStreams {
 public:
  // Where an equal stream lies, or nullptr.
  const StreamPlace* find(std::span<const std::byte> stream, std::span<const std::byte> streams,
                          uint64_t streamsBegin) const {
    const auto [first, last] = places_.equal_range(hashBytes(stream));
    const auto equal = std::find_if(first, last, [&](const auto& entry) {
      const StreamPlace& place = entry.second;
      return std::ranges::equal(streams.subspan(place.begin - streamsBegin, place.bytes), stream);
    });
    return equal == last ? nullptr : &equal->second;
  }
  void add(std::span<const std::byte> stream, const StreamPlace& place) { places_.emplace(hashBytes(stream), place); }

 private:
  std::multimap<uint64_t, StreamPlace> places_;
};

EncodedView encoded(const ViewImage& image, const ArrangeOptions& options, int zlibLevel) {
  FARCELL_CHECK((image.width == 0) == (image.height == 0));
  FARCELL_CHECK(std::max(image.x0 + image.width, image.y0 + image.height) <= kMaxImageSize);
  FARCELL_CHECK(std::isfinite(image.depthMin) && std::isfinite(image.depthMax) && image.depthMin <= image.depthMax);
  EncodedView encoded{.view = image.view,
                      .x0 = image.x0,
                      .y0 = image.y0,
                      .width = image.width,
                      .height = image.height,
                      .depthMin = image.depthMin,
                      .depthMax = image.depthMax,
                      .stream = {}};
  if (image.width == 0) return encoded;
  const uint32_t planeCount = image.normal.empty() ? kPlanesWithoutNormals : kPlanesWithNormals;
  const uint64_t decodedBytes = planeCount * texelsOf(encoded);
  FARCELL_CHECK(decodedBytes <= UINT32_MAX);
  encoded.decodedBytes = static_cast<uint32_t>(decodedBytes);
  for (const Arrangement arrangement : {Arrangement::sparse, Arrangement::plain}) {
    const ArrangedView arranged = arrangedFromView(image, planeCount, arrangement, options);
    encoded.coding = arranged.coding;
    encoded.stream = zlibCompress(arranged.bytes, zlibLevel);
    // A reader believes no more of a sparse view than a plain stream of its size could hold.
    if (decodedBytes <= kMaxZlibRatio * encoded.stream.size()) break;
  }
  return encoded;
}

}  // namespace

EncodedView encodeView(const ViewImage& image, int maxError) {
  return encoded(image, {.maxError = maxError, .factors = {}}, kViewZlibLevel);
}

Result<EncodedView> smallerView(const EncodedView& view) {
  if (view.decodedBytes == 0) return view;
  std::vector<std::byte> arranged;
  FARCELL_ASSIGN(const ViewImage image, decodeStream(view.stream, view, arranged));
  // With the factors it has: a view whose residuals were made few by error is smaller with no others.
  EncodedView smaller =
      encoded(image, {.triesFilters = true, .factors = factorsOfArranged(arranged)}, kSlowestZlibLevel);
  return smaller.stream.size() < view.stream.size() ? smaller : view;
}

EncodedViewPage viewPageOf(std::span<const EncodedView> views) {
  EncodedViewPage page;
  const uint32_t planeCount = planeCountOf(views);
  ByteWriter headers;
  ByteWriter streams;
  headers.u32(static_cast<uint32_t>(views.size()));
  headers.u32(planeCount);
  const uint64_t streamsBegin = kPageHeaderBytes + views.size() * kViewHeaderBytes;
  KnownStreams known;
  uint64_t decodedBytes = 0;
  for (size_t i = 0; i < views.size(); ++i) {
    const EncodedView& view = views[i];
    FARCELL_CHECK(i == 0 || views[i - 1].view < view.view);
    FARCELL_CHECK(view.decodedBytes == planeCount * texelsOf(view) && view.stream.empty() == (view.decodedBytes == 0));
    StreamPlace place;
    if (view.decodedBytes > 0) {
      decodedBytes += view.decodedBytes;
      const StreamPlace* earlier = known.find(view.stream, streams.bytes, streamsBegin);
      // A page must not hold more than a stream of its size could.
      if (earlier != nullptr && decodedBytes <= kMaxZlibRatio * streams.bytes.size()) {
        place = *earlier;
        ++page.duplicates;
        page.duplicateBytes += place.bytes;
      } else {
        place = {streamsBegin + streams.bytes.size(), view.stream.size()};
        streams.append(view.stream);
        known.add(view.stream, place);
      }
    }
    writeHeader(headers, view, place);
  }
  headers.append(streams.bytes);
  page.bytes = std::move(headers.bytes);
  return page;
}

std::vector<std::byte> encodeViewPage(const ViewPage& page) {
  std::vector<EncodedView> views;
  for (const ViewImage& image : page.views) views.push_back(encodeView(image));
  return viewPageOf(views).bytes;
}

Result<std::vector<EncodedView>> viewsOfPage(std::span<const std::byte> bytes, const ViewLimits& limits) {
  FARCELL_ASSIGN(std::vector<ViewHeader> headers, readHeaders(bytes, limits));
  std::vector<EncodedView> views;
  for (ViewHeader& header : headers) {
    const auto stream = bytes.subspan(header.stream.begin, header.stream.bytes);
    header.view.stream.assign(stream.begin(), stream.end());
    views.push_back(std::move(header.view));
  }
  return views;
}

Result<ViewPage> decodeViewPage(std::span<const std::byte> bytes, const ViewLimits& limits) {
  FARCELL_ASSIGN(const std::vector<ViewHeader> headers, readHeaders(bytes, limits));
  ViewPage page;
  std::vector<std::byte> arranged;
  for (const ViewHeader& header : headers) {
    const auto stream = bytes.subspan(header.stream.begin, header.stream.bytes);
    Result<ViewImage> image = decodeStream(stream, header.view, arranged);
    if (!image) return fail(ErrorKind::corrupt, "byte {} of the page: {}", header.stream.begin, image.error().message);
    page.views.push_back(*std::move(image));
  }
  return page;
}

uint32_t decodedSizeBytes(std::span<const EncodedView> views) {
  uint64_t bytes = 0;
  for (const EncodedView& view : views) bytes += view.decodedBytes;
  FARCELL_CHECK(bytes <= UINT32_MAX);
  return static_cast<uint32_t>(bytes);
}

uint32_t decodedSizeBytes(const ViewPage& page) {
  uint64_t bytes = 0;
  for (const ViewImage& view : page.views) bytes += view.rgba.size() + view.depth.size() + view.normal.size();
  FARCELL_CHECK(bytes <= UINT32_MAX);
  return static_cast<uint32_t>(bytes);
}

}  // namespace farcell
