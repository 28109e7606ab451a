// Rectangles side by side in a larger one.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

namespace farcell {

struct Packing {
  glm::uvec2 size{0};
  std::vector<glm::uvec2> places;  // lowest corner of each, none overlap
};

// Nothing when they do not fit into maxEdge x maxEdge. Deterministic.
std::optional<Packing> packed(std::span<const glm::uvec2> sizes, uint32_t maxEdge);

}  // namespace farcell
