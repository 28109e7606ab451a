#include "preprocess/read/off/off_header.h"

#include "preprocess/mesh/number_text.h"

namespace farcell {
namespace {

constexpr uint64_t kLeastVertexBytes = 6;  // "0 0 0" and a line end
constexpr uint64_t kLeastFaceBytes = 2;    // "0" and a line end

bool takePrefix(std::string_view& word, std::string_view prefix) {
  const bool found = word.starts_with(prefix);
  if (found) word.remove_prefix(prefix.size());
  return found;
}

Result<uint64_t> takeCount(const TextLines& lines, std::string_view& rest, const char* what) {
  const std::string_view word = takeWord(rest);
  int64_t count = 0;
  if (!parseInteger(word, count) || count < 0) return lines.bad(fmt::format("the number of {}", what), word);
  return static_cast<uint64_t>(count);
}

Result<> checkCounts(const TextLines& lines, const OffHeader& header) {
  const uint64_t left = lines.file().sizeBytes() - lines.nextPlace().offset + 1;  // the last line end may be missing
  if (header.vertices <= left / kLeastVertexBytes &&
      header.faces <= (left - header.vertices * kLeastVertexBytes) / kLeastFaceBytes)
    return {};
  return lines.bad(fmt::format("counts that {} bytes can hold", left - 1),
                   fmt::format("{} vertices and {} faces", header.vertices, header.faces));
}

}  // namespace

std::optional<OffKeyword> parseOffKeyword(std::string_view word) {
  OffKeyword keyword;
  keyword.hasTextureCoordinates = takePrefix(word, "ST");
  keyword.hasColours = takePrefix(word, "C");
  keyword.hasNormals = takePrefix(word, "N");
  keyword.hasOtherDimension = takePrefix(word, "4");
  keyword.hasOtherDimension |= takePrefix(word, "n");
  if (word != "OFF") return std::nullopt;
  return keyword;
}

bool nextOffLine(TextLines& lines, std::string_view& line) {
  while (lines.next(line)) {
    std::string_view rest = line;
    if (!takeWord(rest).empty()) return true;
  }
  return false;
}

Result<OffHeader> readOffHeader(TextLines& lines) {
  OffHeader header;
  std::string_view line;
  if (!nextOffLine(lines, line)) return lines.ended("a header such as 'OFF' or 'COFF'");
  const std::string_view word = takeWord(line);
  const std::optional<OffKeyword> keyword = parseOffKeyword(word);
  if (!keyword) return lines.bad("a header such as 'OFF' or 'COFF'", word);
  header.keyword = *keyword;
  const std::string_view path = lines.file().path();
  if (keyword->hasOtherDimension)
    return fail(ErrorKind::unsupported, "{}: expected vertices of three coordinates, found {}", path, word);
  std::string_view counts = line;
  if (takeWord(counts) == "BINARY")
    return fail(ErrorKind::unsupported, "{}: expected {} as text, found {} BINARY", path, word, word);
  std::string_view rest = line;  // some writers put the counts beside the keyword
  if (takeWord(rest).empty() && !nextOffLine(lines, line))
    return lines.ended("the numbers of vertices, faces and edges");
  FARCELL_ASSIGN(header.vertices, takeCount(lines, line, "vertices"));
  FARCELL_ASSIGN(header.faces, takeCount(lines, line, "faces"));
  // The number of edges, which is 0 in most files and missing in some, says nothing.
  FARCELL_TRY(checkCounts(lines, header));
  return header;
}

}  // namespace farcell
