#include "preprocess/read/obj/obj_face.h"

#include <algorithm>

#include "preprocess/mesh/number_text.h"

namespace farcell {
namespace {

std::string_view takeUntilSlash(std::string_view& rest) {
  const size_t end = std::min(rest.find('/'), rest.size());
  const std::string_view part = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return part;
}

uint64_t resolved(int64_t index, uint64_t count) {
  // Wraps to a huge number for what lies before the first.
  return index < 0 ? count + static_cast<uint64_t>(index) : static_cast<uint64_t>(index) - 1;
}

}  // namespace

bool parseObjCorner(std::string_view word, const ObjCounts& counts, ObjCorner& corner) {
  int64_t index = 0;
  if (!parseInteger(takeUntilSlash(word), index)) return false;
  corner.position = resolved(index, counts.positions);
  const std::string_view texture = takeUntilSlash(word);
  if (!texture.empty() && !parseInteger(texture, index)) return false;
  corner.coordinates = texture.empty() ? UINT64_MAX : resolved(index, counts.coordinates);
  corner.hasNormal = !word.empty();
  if (corner.hasNormal) {
    if (!parseInteger(word, index)) return false;
    corner.normal = resolved(index, counts.normals);
  }
  return true;
}

}  // namespace farcell
