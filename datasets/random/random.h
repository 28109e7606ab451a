// Numbers that depend on a key alone: every block of a city, every fold of a statue has its own.
#pragma once

#include <cstdint>

namespace farcell {

// One step of SplitMix64 (Steele, Lea, Flood, Fast Splittable Pseudorandom Number Generators, 2014).
constexpr uint64_t mixed(uint64_t value) {
  value += 0x9e3779b97f4a7c15ull;
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9ull;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebull;
  return value ^ (value >> 31);
}

constexpr uint64_t keyOf(uint64_t seed, int64_t a, int64_t b = 0, int64_t c = 0) {
  return mixed(mixed(mixed(mixed(seed) ^ static_cast<uint64_t>(a)) ^ static_cast<uint64_t>(b)) ^
               static_cast<uint64_t>(c));
}

// The upper 53 bits, in [0, 1).
constexpr double unitOf(uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

// A sequence. Two draws never stand among the arguments of one call or the operands of one operator: their order, and
// with it the model, would be the compiler's choice (in a braced list it is left to right).
class Random {
 public:
  explicit constexpr Random(uint64_t key) : state_(key) {}

  constexpr uint64_t bits() { return mixed(state_ += 0x9e3779b97f4a7c15ull); }
  constexpr double unit() { return unitOf(bits()); }
  constexpr double range(double low, double high) { return low + (high - low) * unit(); }
  constexpr int below(int count) { return static_cast<int>(bits() % static_cast<uint64_t>(count)); }
  constexpr int between(int low, int high) { return low + below(high - low + 1); }  // both included
  constexpr bool chance(double probability) { return unit() < probability; }

 private:
  uint64_t state_;
};

}  // namespace farcell
