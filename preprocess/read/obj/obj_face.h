// One face statement of an OBJ file.
#pragma once

#include <cstdint>
#include <string_view>

namespace farcell {

// How many vertices, texture coordinates and normals the file has given so far: what relative indices count back from.
struct ObjCounts {
  uint64_t positions = 0;
  uint64_t coordinates = 0;
  uint64_t normals = 0;
};

// Indices from 0. What cannot be one (0, or too far back, in the file) is above any count.
struct ObjCorner {
  uint64_t position = 0;
  uint64_t coordinates = UINT64_MAX;  // as well where there are none
  uint64_t normal = 0;
  bool hasNormal = false;
};

// "7", "7/1", "7//3", "7/1/3", each number possibly negative. False when `word` is none of these.
bool parseObjCorner(std::string_view word, const ObjCounts& counts, ObjCorner& corner);

}  // namespace farcell
