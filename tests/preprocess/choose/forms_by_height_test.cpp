#include "preprocess/choose/forms_by_height.h"

#include <gtest/gtest.h>

#include <vector>

namespace farcell {
namespace {

constexpr ViewForm kBase{42, 128};

// A chain of four cells; the second has a leaf beside it, which is as high as any leaf.
TEST(FormsByHeight, GoByTheDistanceToTheLeavesBelow) {
  std::vector<CellRecord> cells(6);
  for (uint32_t i = 1; i < 5; ++i) cells[i].parent = i - 1;
  cells[5].parent = 0;
  setFormsByHeight(kBase, cells);
  EXPECT_EQ(cells[4].form, (ViewForm{12, 256}));
  EXPECT_EQ(cells[5].form, (ViewForm{12, 256}));
  EXPECT_EQ(cells[3].form, kBase);
  EXPECT_EQ(cells[2].form, (ViewForm{42, 256}));
  EXPECT_EQ(cells[1].form, (ViewForm{162, 256}));
  EXPECT_EQ(cells[0].form, (ViewForm{162, 256}));
}

TEST(FormsByHeight, NeedASetOnEitherSideAndRoomForLargerImages) {
  for (const ViewForm& form : {ViewForm{12, 128}, {642, 128}, {20, 128}, {42, 1024}})
    EXPECT_FALSE(isBaseOfHeights(form));
  for (const ViewForm& form : {ViewForm{42, 16}, {162, 512}}) EXPECT_TRUE(isBaseOfHeights(form));
}

}  // namespace
}  // namespace farcell
