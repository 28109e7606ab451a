// STL files as tests write them.
#pragma once

#include <array>
#include <cstring>
#include <glm/vec3.hpp>

#include "tests/preprocess/read/read_support.h"

namespace farcell::test {

struct Facet {
  std::array<glm::vec3, 3> corners;
  uint16_t attribute = 0;
};

inline Facet facetAt(float x) { return {{glm::vec3(x, 0, 0), glm::vec3(x + 1, 0, 0), glm::vec3(x, 1, 0)}}; }

inline std::string textFacet(const Facet& facet) {
  std::string text = "facet normal 0 0 1\n outer loop\n";
  for (const glm::vec3& p : facet.corners) text += fmt::format("  vertex {} {} {}\n", p.x, p.y, p.z);
  return text + " endloop\nendfacet\n";
}

inline std::string textStl(const std::vector<Facet>& facets) {
  std::string text = "solid a name\n";
  for (const Facet& facet : facets) text += textFacet(facet);
  return text + "endsolid a name\n";
}

template <class T>
void appendBytes(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

inline std::string binaryStl(const std::vector<Facet>& facets, std::string header = "") {
  header.resize(80, '\0');
  appendBytes(header, static_cast<uint32_t>(facets.size()));
  for (const Facet& facet : facets) {
    appendBytes(header, glm::vec3(0, 0, 1));
    appendBytes(header, facet.corners);
    appendBytes(header, facet.attribute);
  }
  return header;
}

}  // namespace farcell::test
