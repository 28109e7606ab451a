// Where a visitor may be: what `--visitable` names.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "cache/base/result.h"

namespace farcell {

// World coordinates, model units; both ends included, min <= max.
struct WorldBox {
  glm::dvec3 min{0};
  glm::dvec3 max{0};
};

struct Region {
  enum class Kind {
    everywhere,
    aboveGround,  // at or above the ground (ground.h)
    boxes,        // in one of `boxes`
  };
  Kind kind = Kind::everywhere;
  std::vector<WorldBox> boxes;
};

// `name`: "everywhere", "above-ground", or a file that regionFromJson takes. Files are bounded to kMaxRegionFileBytes.
inline constexpr uint64_t kMaxRegionFileBytes = 8 << 20;
Result<Region> readRegion(const std::string& name, double metresPerUnit);

// The text of one of
// - a box {"min": [x, y, z], "max": [x, y, z]}, or {"boxes": [box, ...]};
// - {"path": [[x, y, z], ...], "radius": metres}: all within the radius (default 0) of the line through the points;
// - a camera file {"cameras": [{"position": [x, y, z], ...}, ...], "radius": metres}: all within it of a position.
// What lies within a radius is kept as boxes around it. `file` is for messages: corrupt, naming the member.
Result<Region> regionFromJson(const std::string& text, const std::string& file, double metresPerUnit);

}  // namespace farcell
