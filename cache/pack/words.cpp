#include "cache/pack/words.h"

#include <algorithm>
#include <array>

#include "cache/base/check.h"

namespace farcell {
namespace {

constexpr size_t kMaxDistance = 255;

template <class Map>
uint32_t perLane(Lanes lanes, const Map& map) {
  const auto bits = static_cast<uint32_t>(lanes);
  const uint32_t mask = ~0u >> (32 - bits);
  uint32_t result = 0;
  for (uint32_t shift = 0; shift < 32; shift += bits) result |= (map(shift, bits) & mask) << shift;
  return result;
}

uint32_t codedDifference(uint32_t word, uint32_t before, Lanes lanes) {
  return perLane(lanes,
                 [&](uint32_t shift, uint32_t bits) { return zigzag((word >> shift) - (before >> shift), bits); });
}

uint32_t undoneDifference(uint32_t code, uint32_t before, Lanes lanes) {
  return perLane(lanes, [&](uint32_t shift, uint32_t bits) {
    const uint32_t mask = ~0u >> (32 - bits);
    return (before >> shift) + unzigzag(code >> shift & mask, bits);
  });
}

// What word `i` of a sequence is expected to be, from those before it.
uint32_t expectedWord(std::span<const uint32_t> sequence, size_t i, std::span<const Parallelogram> parallelograms) {
  if (!parallelograms.empty() && parallelograms[i].from != Parallelogram::kNoWord) {
    const Parallelogram& known = parallelograms[i];
    return sequence[known.from] + sequence[known.to] - sequence[known.opposite];
  }
  return i > 0 ? sequence[i - 1] : 0;
}

// Where each word was last seen. A slot holds one word: two that share it hide each other, which costs bytes only.
class LastSeen {
 public:
  // Distance from position `i` back to the same word, 0 when it is unknown or too far; remembers `i`.
  uint8_t distance(std::span<const uint32_t> words, size_t i) {
    size_t& slot = slots_[words[i] * 0x9e3779b1u >> (32 - kSlotBits)];
    const size_t last = std::exchange(slot, i + 1);
    const bool usable = last > 0 && words[last - 1] == words[i] && i + 1 - last <= kMaxDistance;
    return usable ? static_cast<uint8_t>(i + 1 - last) : uint8_t{0};
  }

 private:
  static constexpr uint32_t kSlotBits = 12;
  std::array<size_t, 1u << kSlotBits> slots_{};
};

}  // namespace

void writePlanes(ByteWriter& out, std::span<const uint32_t> words) {
  const std::span<std::byte> planes = out.space(4 * words.size());
  for (uint32_t plane = 0; plane < 4; ++plane) {
    std::byte* const to = planes.data() + plane * words.size();
    for (size_t i = 0; i < words.size(); ++i) to[i] = static_cast<std::byte>(words[i] >> (8 * plane));
  }
}

std::vector<uint32_t> readPlanes(ByteReader& in, size_t count) {
  const std::span<const std::byte> bytes = in.take(4 * count);
  if (bytes.size() != 4 * count) return {};
  std::vector<uint32_t> words(count);
  for (size_t plane = 0; plane < 4; ++plane)
    for (size_t i = 0; i < count; ++i) words[i] |= std::to_integer<uint32_t>(bytes[plane * count + i]) << (8 * plane);
  return words;
}

void writeSequences(ByteWriter& out, std::span<const uint32_t> words, size_t sequences, Lanes lanes,
                    std::span<const Parallelogram> parallelograms) {
  FARCELL_CHECK(words.size() % sequences == 0);
  const size_t length = words.size() / sequences;
  const std::span<std::byte> distances = out.space(words.size());
  std::vector<uint32_t> differences;
  differences.reserve(words.size());
  for (size_t sequence = 0; sequence < sequences; ++sequence) {
    const std::span<const uint32_t> part = words.subspan(sequence * length, length);
    LastSeen seen;
    for (size_t i = 0; i < length; ++i) {
      const uint8_t distance = seen.distance(part, i);
      distances[sequence * length + i] = std::byte{distance};
      if (distance == 0) differences.push_back(codedDifference(part[i], expectedWord(part, i, parallelograms), lanes));
    }
  }
  writePlanes(out, differences);
}

Result<std::vector<uint32_t>> readSequences(ByteReader& in, size_t length, size_t sequences, Lanes lanes,
                                            std::span<const Parallelogram> parallelograms) {
  const std::span<const std::byte> distances = in.take(length * sequences);
  const auto differenceCount = static_cast<size_t>(std::count(distances.begin(), distances.end(), std::byte{0}));
  const std::vector<uint32_t> differences = readPlanes(in, differenceCount);
  if (!in.ok())
    return fail(ErrorKind::corrupt, "expected {} words in {} sequences, found too few bytes", length, sequences);
  std::vector<uint32_t> words(length * sequences);
  size_t used = 0;
  for (size_t at = 0; at < words.size(); ++at) {
    const size_t i = at % length;
    const auto distance = std::to_integer<size_t>(distances[at]);
    if (distance > i)
      return fail(ErrorKind::corrupt, "word {}: expected a distance up to {}, found {}", i, i, distance);
    if (distance > 0) {
      words[at] = words[at - distance];
      continue;
    }
    const uint32_t expected = expectedWord(std::span(words).subspan(at - i, i), i, parallelograms);
    words[at] = undoneDifference(differences[used++], expected, lanes);
  }
  return words;
}

}  // namespace farcell
