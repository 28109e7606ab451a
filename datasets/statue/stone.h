// The surface of stone: how far it stands out at a place, and how it looks there. A function of the place alone, so
// that triangles that meet agree.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

namespace farcell {

struct StoneSettings {
  uint64_t seed = 1;
  double amplitude = 0;  // of the relief; lengths are parts of the model's diagonal
  double roughness = 0;  // each finer layer's height against the one before, of twice its width; in [0, 0.9]
  double finest = 0;     // width of the finest layer that can be shown
};

struct StonePoint {
  double height = 0;  // along the normal, within +- amplitude
  double cavity = 0;  // from -1, deep in a groove, to 1, on a ridge
};

class Stone {
 public:
  explicit Stone(const StoneSettings& settings);

  // `place` in diagonals from the model's middle.
  StonePoint at(glm::dvec3 place) const;
  // Darker in grooves, stained in patches.
  std::array<uint8_t, 3> colour(std::array<uint8_t, 3> albedo, glm::dvec3 place, double cavity) const;

 private:
  StoneSettings settings_;
  uint32_t key_;
  int layers_;
};

}  // namespace farcell
