#include "tools/evaluate/path/switches.h"

#include <gtest/gtest.h>

namespace farcell {
namespace {

// 0 is the root, 1 and 2 its children, 3 and 4 those of 1.
Directory tree() {
  Directory directory;
  directory.cells.resize(5);
  directory.cells[1].parent = directory.cells[2].parent = 0;
  directory.cells[3].parent = directory.cells[4].parent = 1;
  return directory;
}

CutEntry impostor(uint32_t cell, uint32_t view, uint32_t secondView = 9) {
  return {.cell = cell, .representation = Representation::impostor, .view = view, .secondView = secondView};
}
CutEntry triangles(uint32_t cell) { return {.cell = cell}; }

Cut cutOf(std::vector<CutEntry> entries) {
  Cut cut;
  cut.entries = std::move(entries);
  return cut;
}

Switches count(std::vector<CutEntry> before, std::vector<CutEntry> now,
               ImpostorKind kind = ImpostorKind::depthCorrected) {
  return countSwitches(tree(), cutOf(std::move(before)), cutOf(std::move(now)), kind);
}

TEST(Switches, NothingSwitchesWhereTheCutIsTheSameInAnyOrder) {
  const Switches none = count({impostor(3, 5), triangles(2)}, {triangles(2), impostor(3, 5)});
  EXPECT_EQ(none.views, 0u);
  EXPECT_EQ(none.levels, 0u);
}

TEST(Switches, AnotherViewIsASwitchOfViewsForKindsThatShowIt) {
  EXPECT_EQ(count({impostor(3, 5)}, {impostor(3, 6)}).views, 1u);
  EXPECT_EQ(count({impostor(3, 5, 1)}, {impostor(3, 5, 2)}).views, 1u);
  EXPECT_EQ(count({impostor(3, 5, 1)}, {impostor(3, 5, 2)}, ImpostorKind::flat).views, 0u);
  CutEntry a = impostor(3, 5), b = impostor(3, 6);
  a.blend.views = {1, 2, 3};
  b.blend.views = {3, 1, 2};
  EXPECT_EQ(count({a}, {b}, ImpostorKind::blended).views, 0u) << "the same three views";
  b.blend.views = {3, 1, 4};
  EXPECT_EQ(count({a}, {b}, ImpostorKind::blended).views, 1u);
}

TEST(Switches, AnotherRepresentationParentOrChildrenAreSwitchesOfLevels) {
  EXPECT_EQ(count({impostor(3, 5)}, {triangles(3)}).levels, 1u);
  EXPECT_EQ(count({impostor(0, 5)}, {triangles(3), triangles(4), impostor(2, 1)}).levels, 3u);
  EXPECT_EQ(count({triangles(3), triangles(4)}, {impostor(1, 5)}).levels, 1u);
  EXPECT_EQ(count({impostor(0, 5)}, {triangles(3)}).views, 0u);
}

TEST(Switches, WhatComesIntoViewOrLeavesItDoesNotSwitch) {
  const Switches none = count({triangles(3)}, {triangles(3), triangles(4), impostor(2, 1)});
  EXPECT_EQ(none.levels + none.views, 0u);
  const Switches left = count({triangles(3), triangles(4), impostor(2, 1)}, {triangles(4)});
  EXPECT_EQ(left.levels + left.views, 0u);
}

}  // namespace
}  // namespace farcell
