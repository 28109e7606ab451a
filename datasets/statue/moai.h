// A figure as a field: a moai of Rapa Nui, after the restored ones of Ahu Tongariki and Anakena, on its platform and
// with its red topknot. Metres, z up, looking along -y; distances are negative inside and nearly true near the surface.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

namespace farcell {

class Moai {
 public:
  explicit Moai(uint64_t seed);  // another number, another face

  double distance(glm::dvec3 point) const;
  std::array<uint8_t, 3> colour(glm::dvec3 point) const;  // of the stone at a point of the surface

  // Everything lies well inside.
  static constexpr glm::dvec3 kMin{-2.2, -1.9, -0.75};
  static constexpr glm::dvec3 kMax{2.2, 1.7, 5.15};

 private:
  // Proportions, metres.
  double jawM_, noseM_, browM_, earM_, bellyM_, topknotM_;
};

}  // namespace farcell
