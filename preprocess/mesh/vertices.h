// The vertices of one file, in memory while its faces are streamed.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace farcell {

struct Vertices {
  // Exactly one of the two is used: floats when the file's coordinates are floats (half the memory), else doubles.
  bool isWide = false;
  std::vector<glm::vec3> narrow;
  std::vector<glm::dvec3> wide;
  bool allFinite = true;  // no coordinate is NaN or infinite

  std::vector<uint32_t> colours;   // 0x00BBGGRR, kNoColour where a vertex has none; empty: no vertex has one
  std::vector<glm::vec3> normals;  // OBJ: indexed apart from the positions; empty: none

  uint64_t count() const { return isWide ? wide.size() : narrow.size(); }
  glm::dvec3 position(uint64_t index) const { return isWide ? wide[index] : glm::dvec3(narrow[index]); }
};

inline constexpr uint32_t kNoColour = 0xff000000u;

// Channels in [0, 1], clamped; NaN gives 0. 0x00BBGGRR.
uint32_t packColour(double red, double green, double blue);
// kDefaultAlbedo of cache/schema/model.h.
uint32_t defaultColour();

}  // namespace farcell
