#include "preprocess/read/off/off_rows.h"

#include <algorithm>
#include <array>
#include <span>

#include "preprocess/mesh/number_text.h"

namespace farcell {
namespace {

constexpr size_t kMaxVertexWords = 12;  // position, normal, colour with alpha, texture coordinates
constexpr uint32_t kWholeRow = 0x01000000u;

// The words of a vertex; more than there can be are an error.
struct VertexWords {
  std::array<std::string_view, kMaxVertexWords + 1> words;
  size_t count = 0;

  explicit VertexWords(std::string_view rest) {
    for (std::string_view word = takeWord(rest); !word.empty() && count < words.size(); word = takeWord(rest))
      words[count++] = word;
  }
  std::span<const std::string_view> part(size_t first, size_t size) const {
    return std::span(words).subspan(first, size);
  }
};

template <class T>
bool parsePoint(std::span<const std::string_view> words, T& point) {
  return parseNumber(words[0], point.x) && parseNumber(words[1], point.y) && parseNumber(words[2], point.z);
}

class VertexReader {
 public:
  VertexReader(TextLines& lines, const OffHeader& header, const std::shared_ptr<ReadMemory>& memory)
      : lines_(lines),
        keyword_(header.keyword),
        vertices_(memory, {.isWide = true, .hasColours = keyword_.hasColours, .hasNormals = keyword_.hasNormals}) {}

  Result<> add(std::string_view line) {
    const VertexWords row(line);
    const size_t fixed = 3 + (keyword_.hasNormals ? 3 : 0) + (keyword_.hasTextureCoordinates ? 2 : 0);
    const size_t channels = row.count - std::min(row.count, fixed);
    if (row.count < fixed || (keyword_.hasColours ? channels != 3 && channels != 4 : channels != 0))
      return lines_.bad(
          fmt::format("a vertex of {} numbers{}", fixed, keyword_.hasColours ? " and three or four of a colour" : ""),
          line);
    Vertex vertex;
    const bool areNumbers =
        parsePoint(row.part(0, 3), vertex.position) &&
        (!keyword_.hasNormals || parsePoint(row.part(3, 3), vertex.normal)) &&
        (!keyword_.hasColours || parseColour(row.part(keyword_.hasNormals ? 6 : 3, channels), vertex.colour));
    if (!areNumbers) return lines_.bad("a vertex of numbers", line);
    return vertices_.append(vertex);
  }

  Result<Vertices> finish() {
    // Taken for bytes so far; a file without any above 1 has only zeros and ones to be made whole channels.
    if (keyword_.hasColours)
      FARCELL_TRY(vertices_.recolour([this](uint32_t colour) {
        const bool isWhole = (colour & kWholeRow) != 0;
        colour &= ~kWholeRow;
        return isWhole && !wholeAreBytes_ ? colour * 255 : colour;
      }));
    return std::move(vertices_);
  }

 private:
  bool parseColour(std::span<const std::string_view> words, uint32_t& packed) {
    OffColour colour;
    if (!parseOffColour(words, colour)) return false;
    wholeAreBytes_ |= colour.isWhole && colour.exceedsOne();
    packed = colour.packed(true) | (colour.isWhole ? kWholeRow : 0);
    return true;
  }

  TextLines& lines_;
  const OffKeyword keyword_;
  Vertices vertices_;
  bool wholeAreBytes_ = false;
};

}  // namespace

Result<Vertices> readOffVertices(TextLines& lines, const OffHeader& header, const std::shared_ptr<ReadMemory>& memory) {
  VertexReader reader(lines, header, memory);
  std::string_view line;
  for (uint64_t index = 0; index < header.vertices; ++index) {
    if (!nextOffLine(lines, line)) return lines.ended(fmt::format("vertex {} of {}", index, header.vertices));
    FARCELL_TRY(reader.add(line));
  }
  return reader.finish();
}

Result<> readOffFace(TextLines& lines, const OffHeader& header, uint64_t index, OffFace& face) {
  std::string_view line;
  if (!nextOffLine(lines, line)) return lines.ended(fmt::format("face {} of {}", index, header.faces));
  std::string_view rest = line;
  int64_t count = 0;
  const std::string_view first = takeWord(rest);
  if (!parseInteger(first, count) || count < 0) return lines.bad("a face's number of corners", first);
  face.corners.clear();
  for (int64_t i = 0; i < count; ++i) {
    int64_t corner = 0;
    const std::string_view word = takeWord(rest);
    if (!parseInteger(word, corner)) return lines.bad(fmt::format("{} vertex indices", count), line);
    face.corners.push_back(corner);
  }
  std::array<std::string_view, 5> words;
  size_t channels = 0;
  for (std::string_view word = takeWord(rest); !word.empty() && channels < words.size(); word = takeWord(rest))
    words[channels++] = word;
  const bool isKnown = channels <= 1 || channels == 3 || channels == 4;
  if (!isKnown || !parseOffColour(std::span(words).first(channels), face.colour))
    return lines.bad("after a face nothing, an index into a colour map, or a colour of three or four numbers", line);
  face.hasColour = channels >= 3;
  return {};
}

}  // namespace farcell
