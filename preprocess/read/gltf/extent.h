// Arithmetic on numbers from a file, which may be as large as they like.
#pragma once

#include <cstdint>
#include <optional>

namespace farcell {

// a * b + c; none where it takes more than 64 bits.
inline std::optional<uint64_t> productPlus(uint64_t a, uint64_t b, uint64_t c) {
  uint64_t product = 0;
  uint64_t sum = 0;
  if (__builtin_mul_overflow(a, b, &product) || __builtin_add_overflow(product, c, &sum)) return std::nullopt;
  return sum;
}

}  // namespace farcell
