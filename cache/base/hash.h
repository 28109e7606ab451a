// XXH3, 64 bits: the checksum of pages and the identity of sources and settings.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace farcell {

uint64_t hashBytes(std::span<const std::byte> bytes);

// The same value as hashBytes over everything added, in order.
class Hasher {
 public:
  Hasher();
  ~Hasher();
  Hasher(const Hasher&) = delete;
  Hasher& operator=(const Hasher&) = delete;
  void add(std::span<const std::byte> bytes);
  uint64_t value() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace farcell
