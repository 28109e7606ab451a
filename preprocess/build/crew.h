// The processes that share the work of one build: usually one.
#pragma once

#include <cstdint>

#include "cache/base/result.h"

namespace farcell {

class Crew {
 public:
  virtual ~Crew() = default;
  virtual uint32_t size() const = 0;
  virtual uint32_t rank() const = 0;  // below size(); 0 leads: it partitions and writes the pack
  // Waits for all. The error of the lowest rank that has one is the error of all, so that they end together.
  virtual Result<> together(Result<> own) = 0;
};

// One process, alone.
class Alone : public Crew {
 public:
  uint32_t size() const override { return 1; }
  uint32_t rank() const override { return 0; }
  Result<> together(Result<> own) override { return own; }
};

}  // namespace farcell
