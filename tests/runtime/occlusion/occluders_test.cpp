#include "runtime/occlusion/occluders.h"

#include <gtest/gtest.h>

namespace farcell {
namespace {

Occluder triangle(GridPoint a, GridPoint b, GridPoint c) {
  Occluder occluder;
  occluder.corners = {a, b, c};
  return occluder;
}

const GridPoint kA(0, 0, 0), kB(8, 0, 0), kC(8, 8, 0), kD(0, 8, 3), kE(4, 4, 9);

TEST(Occluders, acrossASharedEdgeLiesTheNeighboursCorner) {
  for (const bool turned : {false, true}) {
    std::vector<Occluder> quad = {triangle(kA, kB, kC), turned ? triangle(kA, kC, kD) : triangle(kC, kA, kD)};
    findAcross(quad);
    EXPECT_EQ(quad[0].across, (std::array<GridPoint, 3>{kC, kA, kD}));
    EXPECT_EQ(quad[1].across[0], kB);
    EXPECT_EQ(quad[1].across[1], quad[1].corners[0]);
    EXPECT_EQ(quad[1].across[2], quad[1].corners[1]);
  }
}

TEST(Occluders, whereThreeMeetNoneLiesAcross) {
  std::vector<Occluder> fan = {triangle(kA, kB, kC), triangle(kA, kB, kD), triangle(kA, kB, kE)};
  findAcross(fan);
  EXPECT_EQ(fan[0].across[0], kC);
  EXPECT_EQ(fan[1].across[0], kD);
  EXPECT_EQ(fan[2].across[0], kE);
}

TEST(Occluders, atATJunctionNoneLiesAcross) {
  std::vector<Occluder> joint = {triangle(kA, kC, kB), triangle(kA, kE, kD), triangle(kE, kC, kD)};
  findAcross(joint);
  EXPECT_EQ(joint[0].across[0], kB);
  EXPECT_EQ(joint[1].across[0], kD);
  EXPECT_EQ(joint[2].across[0], kD);
  EXPECT_EQ(joint[1].across[1], kC);  // E D, which the two small ones share
}

}  // namespace
}  // namespace farcell
