// The processes of an MPI run as the crew of a build.
#pragma once

#include "preprocess/build/crew.h"

namespace farcell {

// Between MPI_Init and MPI_Finalize. Calls come from the thread that called MPI_Init.
class MpiCrew : public Crew {
 public:
  MpiCrew();
  uint32_t size() const override { return size_; }
  uint32_t rank() const override { return rank_; }
  Result<> together(Result<> own) override;

 private:
  uint32_t size_ = 1;
  uint32_t rank_ = 0;
};

}  // namespace farcell
