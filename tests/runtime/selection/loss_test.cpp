#include "runtime/selection/loss.h"

#include <gtest/gtest.h>

namespace farcell {
namespace {

TEST(Losses, areWhatWasMeasured) {
  CellRecord cell;
  cell.errors.codes = {{{161, 145, 129, 113}, {129, 145, 161, 177}, {}}};
  EXPECT_DOUBLE_EQ(meshLoss(cell, 0.25, 100, 1), 1);
  EXPECT_DOUBLE_EQ(meshLoss(cell, 2, 0, 1), 0.125);
  EXPECT_DOUBLE_EQ(impostorLoss(cell, 0.5), 0.5);
  EXPECT_DOUBLE_EQ(impostorLoss(cell, 2), 2);
}

TEST(Losses, riseWithTheLengthOnScreenWhereNothingWasMeasured) {
  const CellRecord cell;
  EXPECT_LT(impostorLoss(cell, 0.25), impostorLoss(cell, 1));
  EXPECT_LT(meshLoss(cell, 1, 0, 1), meshLoss(cell, 1, 2, 1));
  EXPECT_EQ(meshLoss(cell, 1, 1, 1), meshLoss(cell, 2, 1, 1));
}

// A cell of which only the mesh is known has lines for its views, and the other way round.
TEST(Losses, knowEachWayOnItsOwn) {
  CellRecord cell;
  cell.errors.codes[1] = {161, 161, 161, 161};
  EXPECT_DOUBLE_EQ(impostorLoss(cell, 1), 1);
  EXPECT_EQ(meshLoss(cell, 1, 1, 1), meshLoss(CellRecord(), 1, 1, 1));
}

}  // namespace
}  // namespace farcell
