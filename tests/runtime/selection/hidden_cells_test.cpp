#include "runtime/selection/hidden_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/runtime/selection/random_tree.h"

namespace farcell {
namespace {

// Hides every third leaf and what holds no other.
class FakeHidden : public HiddenCells {
 public:
  explicit FakeHidden(const Directory& directory) : directory_(directory) {}
  bool hides(uint32_t cell) const override {
    const CellRecord& record = directory_.cells[cell];
    if (record.childCount == 0) return cell % 3 == 0;
    for (uint32_t child = 0; child < record.childCount; ++child)
      if (!hides(record.firstChild + child)) return false;
    return true;
  }
  bool needs(uint32_t cell) const override { return needed.contains(cell); }

  std::set<uint32_t> needed;

 private:
  const Directory& directory_;
};

using Drawing = std::pair<uint32_t, Representation>;
std::vector<Drawing> drawingsOf(const Cut& cut) {
  std::vector<Drawing> drawings;
  for (const CutEntry& entry : cut.entries) drawings.emplace_back(entry.cell, entry.representation);
  return drawings;
}

TEST(HiddenCells, hiddenCellsAreLeftOutOfACutThatStaysAsItIs) {
  const Grid grid{{0, 0, 0}, 1, 24};
  uint32_t hiddenCells = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const RandomTree tree(seed, grid);
    const FakeHidden hidden(tree.directory);
    for (const glm::dvec3 eye : eyes())
      for (const RenderMode renderMode : {RenderMode::automatic, RenderMode::meshes, RenderMode::triangles}) {
        const Camera camera = cameraAt(grid, eye, {0.51, 0.52, 0.53});
        const SelectionSettings settings = mode(renderMode, 1'000'000'000);
        const Cut all = selectCut(tree.directory, camera, kWidth, kHeight, settings);
        const Cut seen = selectCut(tree.directory, camera, kWidth, kHeight, settings, &hidden);
        std::vector<Drawing> expected;
        for (const Drawing& drawing : drawingsOf(all))
          if (!hidden.hides(drawing.first)) expected.push_back(drawing);
        EXPECT_EQ(drawingsOf(seen), expected);
        EXPECT_EQ(seen.hidden.cells + seen.entries.size(), all.entries.size());
        EXPECT_NEAR(seen.hidden.work.triangles + seen.work.triangles, all.work.triangles, 1e-6);
        hiddenCells += seen.hidden.cells;
      }
  }
  EXPECT_GT(hiddenCells, 100u);
}

TEST(HiddenCells, whatHiddenCellsDoNotTakeGoesToOthersWhereABudgetBinds) {
  const Grid grid{{0, 0, 0}, 1, 24};
  double lossBefore = 0, lossAfter = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const RandomTree tree(seed, grid);
    for (const glm::dvec3 eye : eyes()) {
      const Camera camera = cameraAt(grid, eye, {0.51, 0.52, 0.53});
      SelectionSettings settings = mode(RenderMode::automatic, 1'000'000'000);
      settings.millisecondPrice = 0;
      settings.triangleBudget = selectCut(tree.directory, camera, kWidth, kHeight, settings).triangles / 2;
      const Cut all = selectCut(tree.directory, camera, kWidth, kHeight, settings);
      FakeHidden hidden(tree.directory);
      for (const auto& [cell, drawn] : drawingsOf(all))
        if (drawn == Representation::triangles && cell % 3 == 1) hidden.needed.insert(cell);
      const Cut seen = selectCut(tree.directory, camera, kWidth, kHeight, settings, &hidden);
      EXPECT_LE(seen.triangles, std::max(all.triangles, settings.triangleBudget));
      const std::vector<Drawing> drawings = drawingsOf(seen);
      for (const auto& [cell, drawn] : drawings) EXPECT_FALSE(hidden.hides(cell));
      for (const uint32_t cell : hidden.needed)
        EXPECT_TRUE(std::find(drawings.begin(), drawings.end(), Drawing(cell, Representation::triangles)) !=
                    drawings.end());
      const Oracle oracle(tree.directory, camera, settings);
      for (const auto& [cell, drawn] : drawingsOf(all))
        if (!hidden.hides(cell)) lossBefore += oracle.loss(cell, drawn);
      lossAfter += seen.loss;
    }
  }
  EXPECT_LT(lossAfter, lossBefore);
}

}  // namespace
}  // namespace farcell
