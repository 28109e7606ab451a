// The first lines of an OFF file.
#pragma once

#include <optional>

#include "preprocess/mesh/text_lines.h"

namespace farcell {

// What the keyword says: [ST][C][N][4][n]OFF.
struct OffKeyword {
  bool hasTextureCoordinates = false;
  bool hasColours = false;
  bool hasNormals = false;
  bool hasOtherDimension = false;  // 4 or n
};
// Nothing when `word` is no such keyword.
std::optional<OffKeyword> parseOffKeyword(std::string_view word);

struct OffHeader {
  OffKeyword keyword;
  uint64_t vertices = 0;
  uint64_t faces = 0;
};

// The next line that holds more than blanks and comments. False at the end, as TextLines::next.
bool nextOffLine(TextLines& lines, std::string_view& line);
// Also refuses counts that the rest of the file cannot hold.
Result<OffHeader> readOffHeader(TextLines& lines);

}  // namespace farcell
