// Sequences of 32-bit words as bytes that deflate well; FORMAT.md, "Page of geometry".
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cache/base/result.h"
#include "cache/pack/bytes.h"

namespace farcell {

// Small differences of either sign, modulo 2^bits, to small numbers, and back. bits: 1..32.
constexpr uint32_t zigzag(uint32_t difference, uint32_t bits) {
  const uint32_t mask = ~0u >> (32 - bits);
  return (difference << 1 ^ (0u - (difference >> (bits - 1) & 1))) & mask;
}
constexpr uint32_t unzigzag(uint32_t code, uint32_t bits) {
  const uint32_t mask = ~0u >> (32 - bits);
  return (code >> 1 ^ (0u - (code & 1))) & mask;
}

// Four planes: the lowest byte of every word, ..., the highest.
void writePlanes(ByteWriter& out, std::span<const uint32_t> words);
// Empty when fewer bytes remain.
std::vector<uint32_t> readPlanes(ByteReader& in, size_t count);

// Three words of a sequence, all before one that probably is from + to - opposite. kNoWord: that one has none.
struct Parallelogram {
  uint32_t from = kNoWord;
  uint32_t to = 0;
  uint32_t opposite = 0;
  static constexpr uint32_t kNoWord = 0xffffffffu;
};

// What the words of a sequence are, which decides how a difference is taken.
enum class Lanes : uint32_t { one = 32, two = 16, four = 8 };  // bits a lane

// `sequences` sequences of equal length, one after the other. A word that occurred among the 255 before it in its
// sequence is that distance, a byte; any other is 0 and its difference, lane by lane, from the word its parallelogram
// gives or else from the word before. Layout: all bytes, then the differences as planes.
// `parallelograms`: one for each word of a sequence, the same for all; empty: none.
void writeSequences(ByteWriter& out, std::span<const uint32_t> words, size_t sequences, Lanes lanes,
                    std::span<const Parallelogram> parallelograms = {});
// corrupt when bytes are missing or a distance leads out of its sequence.
Result<std::vector<uint32_t>> readSequences(ByteReader& in, size_t length, size_t sequences, Lanes lanes,
                                            std::span<const Parallelogram> parallelograms = {});

}  // namespace farcell
