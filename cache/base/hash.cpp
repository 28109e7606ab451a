#include "cache/base/hash.h"

#include <xxhash.h>

#include "cache/base/check.h"

namespace farcell {

struct Hasher::State {
  XXH3_state_t* xxh = XXH3_createState();
  ~State() { XXH3_freeState(xxh); }
};

uint64_t hashBytes(std::span<const std::byte> bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

Hasher::Hasher() : state_(std::make_unique<State>()) {
  FARCELL_CHECK(state_->xxh != nullptr);
  XXH3_64bits_reset(state_->xxh);
}

Hasher::~Hasher() = default;

void Hasher::add(std::span<const std::byte> bytes) { XXH3_64bits_update(state_->xxh, bytes.data(), bytes.size()); }

uint64_t Hasher::value() const { return XXH3_64bits_digest(state_->xxh); }

}  // namespace farcell
