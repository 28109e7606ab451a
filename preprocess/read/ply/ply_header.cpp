#include "preprocess/read/ply/ply_header.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace farcell {
namespace {

constexpr uint64_t kMaxHeaderBytes = uint64_t{1} << 20;

struct TypeName {
  std::string_view name;
  PlyType type;
};
constexpr std::array<TypeName, 16> kTypeNames = {{{"char", PlyType::int8},
                                                  {"int8", PlyType::int8},
                                                  {"uchar", PlyType::uint8},
                                                  {"uint8", PlyType::uint8},
                                                  {"short", PlyType::int16},
                                                  {"int16", PlyType::int16},
                                                  {"ushort", PlyType::uint16},
                                                  {"uint16", PlyType::uint16},
                                                  {"int", PlyType::int32},
                                                  {"int32", PlyType::int32},
                                                  {"uint", PlyType::uint32},
                                                  {"uint32", PlyType::uint32},
                                                  {"float", PlyType::float32},
                                                  {"float32", PlyType::float32},
                                                  {"double", PlyType::float64},
                                                  {"float64", PlyType::float64}}};

std::vector<std::string_view> splitWords(std::string_view line) {
  std::vector<std::string_view> words;
  constexpr std::string_view kBlanks = " \t\r";
  for (size_t at = line.find_first_not_of(kBlanks); at != std::string_view::npos;) {
    const size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(kBlanks, end);
  }
  return words;
}

// The header's text, line by line; knows where it is for messages.
class HeaderLines {
 public:
  HeaderLines(const std::string& path, std::string_view text) : path_(path), text_(text) {}

  Result<std::string_view> next() {
    start_ = end_;
    ++line_;
    const size_t newline = text_.find('\n', start_);
    if (newline == std::string_view::npos)
      return bad("a header line, up to 'end_header' within the first MiB", "end of file, or a header longer than that");
    end_ = newline + 1;
    return text_.substr(start_, newline - start_);
  }
  tl::unexpected<Error> bad(const std::string& expected, std::string_view found) const {
    constexpr size_t kMaxQuoted = 80;
    return corrupt(fmt::format("{}: line {}", path_, line_), start_, expected,
                   std::string(found.substr(0, kMaxQuoted)));
  }
  uint64_t nextOffset() const { return end_; }
  uint64_t nextLine() const { return line_ + 1; }

 private:
  const std::string& path_;
  std::string_view text_;
  size_t start_ = 0;
  size_t end_ = 0;
  uint64_t line_ = 0;
};

Result<PlyType> parseType(const HeaderLines& lines, std::string_view word) {
  const auto* found =
      std::find_if(kTypeNames.begin(), kTypeNames.end(), [&](auto& known) { return known.name == word; });
  if (found == kTypeNames.end()) return lines.bad("a scalar type such as 'float' or 'uchar'", word);
  return found->type;
}

Result<PlyEncoding> parseFormat(const HeaderLines& lines, std::string_view line) {
  const auto words = splitWords(line);
  if (words.size() == 3 && words[0] == "format" && words[2] == "1.0") {
    if (words[1] == "ascii") return PlyEncoding::ascii;
    if (words[1] == "binary_little_endian") return PlyEncoding::littleEndian;
    if (words[1] == "binary_big_endian") return PlyEncoding::bigEndian;
  }
  return lines.bad("'format' ascii, binary_little_endian or binary_big_endian, and 1.0", line);
}

Result<PlyElement> parseElement(const HeaderLines& lines, std::string_view line) {
  const auto words = splitWords(line);
  PlyElement element;
  if (words.size() == 3) {
    element.name = words[1];
    const char* end = words[2].data() + words[2].size();
    const auto [stop, code] = std::from_chars(words[2].data(), end, element.count);
    if (code == std::errc{} && stop == end) return element;
  }
  return lines.bad("'element' with a name and a count", line);
}

Result<PlyProperty> parseProperty(const HeaderLines& lines, std::string_view line) {
  const auto words = splitWords(line);
  PlyProperty property;
  const bool list = words.size() == 5 && words[1] == "list";
  if (!list && words.size() != 3) return lines.bad("'property' with a type and a name", line);
  property.name = words.back();
  FARCELL_ASSIGN(property.type, parseType(lines, words[words.size() - 2]));
  if (!list) return property;
  FARCELL_ASSIGN(property.countType, parseType(lines, words[2]));
  if (isReal(*property.countType)) return lines.bad("an integer type for a list's count", words[2]);
  return property;
}

Result<> addProperty(const HeaderLines& lines, std::string_view line, std::vector<PlyElement>& elements) {
  FARCELL_ASSIGN(PlyProperty property, parseProperty(lines, line));
  if (elements.empty()) return lines.bad("an 'element' before its properties", line);
  if (elements.back().find(property.name)) return lines.bad("each property of an element once", line);
  elements.back().properties.push_back(std::move(property));
  return {};
}

// The fewest bytes of text that hold a row: a digit for each property, and a blank after it.
uint64_t leastRowBytes(const PlyHeader& header, const PlyElement& element) {
  return header.encoding == PlyEncoding::ascii ? 2 * element.properties.size() : element.rowBytes();
}

Result<> checkCounts(const InputFile& file, const PlyHeader& header) {
  uint64_t left = file.sizeBytes() - header.bodyOffset + 1;  // the last blank of a text may be missing
  for (const PlyElement& element : header.elements) {
    const uint64_t rowBytes = leastRowBytes(header, element);
    if (rowBytes == 0) continue;
    if (element.count > left / rowBytes)
      return corrupt(
          file.path(), header.bodyOffset,
          fmt::format("{} rows of element '{}', at least {} bytes each", element.count, element.name, rowBytes),
          fmt::format("at most {} bytes for them", left));
    left -= element.count * rowBytes;
  }
  return {};
}

Result<PlyHeader> parseLines(HeaderLines& lines) {
  PlyHeader header;
  FARCELL_ASSIGN(const std::string_view magic, lines.next());
  if (magic != "ply" && magic != "ply\r") return lines.bad("'ply'", magic);
  FARCELL_ASSIGN(std::string_view line, lines.next());
  while (line.starts_with("comment") || line.starts_with("obj_info")) {
    FARCELL_ASSIGN(line, lines.next());
  }
  FARCELL_ASSIGN(header.encoding, parseFormat(lines, line));
  while (true) {
    FARCELL_ASSIGN(line, lines.next());
    const auto words = splitWords(line);
    const std::string_view keyword = words.empty() ? std::string_view() : words[0];
    if (keyword == "end_header") break;
    if (keyword == "comment" || keyword == "obj_info") continue;
    if (keyword == "element") {
      FARCELL_ASSIGN(PlyElement element, parseElement(lines, line));
      header.elements.push_back(std::move(element));
    } else if (keyword == "property") {
      FARCELL_TRY(addProperty(lines, line, header.elements));
    } else {
      return lines.bad("'element', 'property', 'comment', 'obj_info' or 'end_header'", line);
    }
  }
  header.bodyOffset = lines.nextOffset();
  header.bodyLine = lines.nextLine();
  return header;
}

}  // namespace

size_t sizeBytes(PlyType type) {
  constexpr std::array<size_t, 8> kSizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<size_t>(type)];
}

bool isReal(PlyType type) { return type == PlyType::float32 || type == PlyType::float64; }

std::optional<size_t> PlyElement::find(std::string_view property) const {
  for (size_t i = 0; i < properties.size(); ++i)
    if (properties[i].name == property) return i;
  return std::nullopt;
}

bool PlyElement::hasLists() const {
  return std::any_of(properties.begin(), properties.end(),
                     [](auto& property) { return property.countType.has_value(); });
}

uint64_t PlyElement::rowBytes() const {
  uint64_t bytes = 0;
  for (const PlyProperty& property : properties) bytes += sizeBytes(property.countType.value_or(property.type));
  return bytes;
}

bool startsLikePly(const InputFile& file) {
  std::array<char, 4> magic{};
  if (file.sizeBytes() < magic.size() || !file.readAt(0, std::as_writable_bytes(std::span(magic)))) return false;
  return std::string_view(magic.data(), 3) == "ply" && (magic[3] == '\n' || magic[3] == '\r');
}

Result<PlyHeader> readPlyHeader(const InputFile& file) {
  std::string text(std::min(file.sizeBytes(), kMaxHeaderBytes), '\0');
  FARCELL_TRY(file.readAt(0, std::as_writable_bytes(std::span(text))));
  HeaderLines lines(file.path(), text);
  FARCELL_ASSIGN(PlyHeader header, parseLines(lines));
  FARCELL_TRY(checkCounts(file, header));
  return header;
}

}  // namespace farcell
