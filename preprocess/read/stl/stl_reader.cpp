#include "preprocess/read/stl/stl_reader.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstring>

#include "preprocess/mesh/byte_stream.h"
#include "preprocess/mesh/triangle_batch.h"
#include "preprocess/read/stl/stl_colours.h"
#include "preprocess/read/stl/stl_text.h"

namespace farcell {
namespace {

constexpr size_t kHeaderBytes = 80;
constexpr uint64_t kFirstFacet = 84;
constexpr size_t kFacetBytes = 50;  // normal, three corners, two attribute bytes

template <class T>
T load(const std::byte* bytes) {
  static_assert(std::endian::native == std::endian::little);
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

glm::dvec3 loadPoint(const std::byte* bytes) {
  return glm::dvec3(load<float>(bytes), load<float>(bytes + 4), load<float>(bytes + 8));
}

uint16_t attributeOf(const std::byte* facet) { return load<uint16_t>(facet + 48); }

// 0 where the file ends before it.
uint32_t announcedFacets(const InputFile& file) {
  std::array<std::byte, 4> count{};
  if (file.sizeBytes() < kFirstFacet || !file.readAt(kHeaderBytes, count)) return 0;
  return load<uint32_t>(count.data());
}

std::string startOf(const InputFile& file) {
  std::string start(std::min<uint64_t>(file.sizeBytes(), kFirstFacet), '\0');
  return file.readAt(0, std::as_writable_bytes(std::span(start))) ? start : std::string();
}

InputTriangle withColour(uint32_t colour) {
  InputTriangle triangle{};
  triangle.colours.fill(colour);
  return triangle;
}

class TextStlReader final : public MeshReader {
 public:
  TextStlReader(InputFile file, uint64_t facets) : file_(std::move(file)) {
    info_.format = "STL, ASCII";
    info_.declaredTriangles = facets;
    info_.vertices = 3 * facets;
  }

  const MeshInfo& info() const override { return info_; }
  std::vector<std::filesystem::path> files() const override { return {file_.path()}; }

  Result<MeshCounts> forEachTriangle(const Sink& sink) override {
    TriangleBatch batch(sink);
    InputTriangle triangle = withColour(defaultColour());
    FARCELL_TRY(forEachTextFacet(file_, [&](const std::array<glm::dvec3, 3>& corners) {
      triangle.positions = corners;
      batch.add(triangle);
      return !batch.failed();
    }));
    return batch.finish();
  }

 private:
  InputFile file_;
  MeshInfo info_;
};

// Calls `take` with the bytes of each facet until it returns false.
template <class Take>
Result<> forEachBinaryFacet(const InputFile& file, uint64_t facets, const Take& take) {
  ByteStream stream(file, kFirstFacet);
  for (uint64_t facet = 0; facet < facets; ++facet) {
    if (!stream.need(kFacetBytes)) return tl::unexpected<Error>(*stream.failure());
    if (!take(stream.cursor())) return {};
    stream.advance(kFacetBytes);
  }
  return {};
}

class BinaryStlReader final : public MeshReader {
 public:
  BinaryStlReader(InputFile file, uint64_t facets, const StlColours& colours, bool hasColours)
      : file_(std::move(file)), colours_(colours) {
    info_.format = "STL, binary";
    info_.hasColours = hasColours;
    info_.declaredTriangles = facets;
    info_.vertices = 3 * facets;
  }

  const MeshInfo& info() const override { return info_; }
  std::vector<std::filesystem::path> files() const override { return {file_.path()}; }

  Result<MeshCounts> forEachTriangle(const Sink& sink) override {
    TriangleBatch batch(sink);
    InputTriangle triangle = withColour(defaultColour());
    FARCELL_TRY(forEachBinaryFacet(file_, info_.declaredTriangles, [&](const std::byte* facet) {
      for (size_t i = 0; i < 3; ++i) triangle.positions[i] = loadPoint(facet + 12 * (i + 1));
      if (info_.hasColours) triangle.colours.fill(colours_.colour(attributeOf(facet)));
      batch.add(triangle);
      return !batch.failed();
    }));
    return batch.finish();
  }

 private:
  InputFile file_;
  StlColours colours_;
  MeshInfo info_;
};

Result<std::unique_ptr<MeshReader>> openText(InputFile file) {
  uint64_t facets = 0;
  FARCELL_TRY(forEachTextFacet(file, [&](const std::array<glm::dvec3, 3>&) { return ++facets > 0; }));
  return std::make_unique<TextStlReader>(std::move(file), facets);
}

Result<std::unique_ptr<MeshReader>> openBinary(InputFile file) {
  const uint64_t facets = announcedFacets(file);
  std::array<std::byte, kHeaderBytes> header{};
  FARCELL_TRY(file.readAt(0, header));
  const StlColours colours{std::span<const std::byte, kHeaderBytes>(header)};
  bool hasColours = colours.isMagics();
  if (!hasColours)
    FARCELL_TRY(forEachBinaryFacet(file, facets, [&](const std::byte* facet) {
      hasColours = colours.hasColour(attributeOf(facet));
      return !hasColours;
    }));
  return std::make_unique<BinaryStlReader>(std::move(file), facets, colours, hasColours);
}

}  // namespace

bool hasBinaryStlSize(const InputFile& file) {
  return file.sizeBytes() >= kFirstFacet &&
         file.sizeBytes() == kFirstFacet + kFacetBytes * uint64_t{announcedFacets(file)};
}

bool startsLikeTextStl(const InputFile& file) {
  std::string start = startOf(file);
  for (char& c : start) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  // A zero byte: a binary header that begins with the word, of a file of the wrong size.
  if (start.find('\0') != std::string::npos) return false;
  constexpr std::string_view kBlanks = " \t\r\n\v\f";
  const std::string_view text =
      std::string_view(start).substr(std::min(start.find_first_not_of(kBlanks), start.size()));
  return text.starts_with("solid") && (text.size() == 5 || kBlanks.find(text[5]) != std::string_view::npos);
}

Result<std::unique_ptr<MeshReader>> openStl(InputFile file) {
  if (hasBinaryStlSize(file)) return openBinary(std::move(file));
  if (startsLikeTextStl(file)) return openText(std::move(file));
  if (file.sizeBytes() < kFirstFacet)
    return corrupt(file.path(), 0, "'solid', or a binary STL file of at least 84 bytes",
                   fmt::format("{} bytes", file.sizeBytes()));
  const uint64_t facets = announcedFacets(file);
  return corrupt(file.path(), kHeaderBytes,
                 fmt::format("'solid' at the start, or {} bytes for the {} triangles announced here",
                             kFirstFacet + kFacetBytes * facets, facets),
                 fmt::format("a file of {} bytes", file.sizeBytes()));
}

}  // namespace farcell
