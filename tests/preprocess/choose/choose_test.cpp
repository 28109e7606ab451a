#include "preprocess/choose/choose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "preprocess/choose/worth.h"
#include "tests/preprocess/choose/trees.h"

namespace farcell {
namespace {

struct Scene {
  Model model;
  std::vector<CellRecord> cells;
  std::vector<uint32_t> geometryBytes;
  std::vector<ViewCost> views;

  ChooseInput input() const { return {cells, geometryBytes, views}; }

  // Gives every cell its views; of a leaf, more triangles are more bytes.
  void bake(std::mt19937& random) {
    geometryBytes.assign(cells.size(), 0);
    for (uint32_t cell = 0; cell < cells.size(); ++cell) {
      if (cells[cell].childCount == 0) geometryBytes[cell] = static_cast<uint32_t>(40 + 4 * cells[cell].triangles);
      for (uint32_t view = 0; view < 42; ++view) {
        const uint32_t texels = random() % 20 == 0 ? 0 : 2000 + static_cast<uint32_t>(random() % 4000);
        views.push_back({cell, view, texels / 2, texels});
      }
    }
  }
};

Scene randomScene(unsigned seed) {
  std::mt19937 random(seed);
  Scene scene;
  std::vector<TestLeaf> leaves;
  std::function<void(const CellKey&)> split = [&](const CellKey& key) {
    if (key.level == 4 || (key.level > 0 && random() % 4 == 0)) {
      leaves.push_back({key, cellBox(scene.model.grid, key), 1 + random() % 16384});
      return;
    }
    for (uint32_t octant = 0; octant < 8; ++octant)
      if (random() % 2 == 0 || octant == 7) split(key.child(octant));
  };
  split({});
  scene.cells = treeOf(leaves);
  scene.bake(random);
  return scene;
}

// The size of a pack with these views, by FORMAT.md, with a directory of short names.
uint64_t packBytes(const Scene& scene, const std::vector<ViewFate>& fates) {
  uint64_t bytes = 32 + 80 + 104 + 300 + 116 * scene.cells.size();
  std::map<std::pair<uint32_t, int>, uint64_t> pages;
  for (size_t i = 0; i < fates.size(); ++i) {
    if (fates[i] != ViewFate::kept) continue;
    const ViewCost& view = scene.views[i];
    uint64_t& page =
        pages.try_emplace({view.cell, Viewpoints::of(42).group(static_cast<int>(view.view))}, 8).first->second;
    page += 32 + view.bytes;
  }
  for (const auto& [place, page] : pages) bytes += page + 40;
  for (const uint32_t geometry : scene.geometryBytes) bytes += geometry > 0 ? geometry + 40 : 0;
  return bytes;
}

// Whether each cell keeps all its views that show something, or none.
std::vector<int> wholeCells(const Scene& scene, const std::vector<ViewFate>& fates) {
  std::vector<int> kept(scene.cells.size(), -1);
  for (size_t i = 0; i < fates.size(); ++i) {
    if (scene.views[i].texels == 0) {
      EXPECT_EQ(fates[i], ViewFate::empty);
      continue;
    }
    int& cell = kept[scene.views[i].cell];
    const int keeps = fates[i] == ViewFate::kept;
    EXPECT_TRUE(cell == -1 || cell == keeps) << scene.views[i].cell;
    cell = keeps;
  }
  return kept;
}

std::vector<float> meanTexels(const Scene& scene) {
  std::vector<float> sums(scene.cells.size()), counts(scene.cells.size());
  for (const ViewCost& view : scene.views) {
    sums[view.cell] += static_cast<float>(view.texels);
    counts[view.cell] += view.texels > 0;
  }
  for (size_t cell = 0; cell < sums.size(); ++cell) sums[cell] /= std::max(1.0f, counts[cell]);
  return sums;
}

// The whole model's cost, summed over octaves (two distances an octave), drawn top down as the runtime does: an oracle
// that keeps nothing from one distance to the next.
double costOf(const Scene& scene, const std::vector<float>& texels, const std::vector<bool>& kept) {
  int deepest = 0;
  for (const CellRecord& cell : scene.cells) deepest = std::max(deepest, static_cast<int>(cell.key.level));
  double total = 0;
  // Octaves of distance by which the root is farther than where its own views are first drawn.
  for (double beyond = -deepest; beyond < 2; beyond += 0.5) {
    std::function<double(uint32_t)> draw = [&](uint32_t index) {
      const CellRecord& cell = scene.cells[index];
      const double texelPixels = 0.5 * std::exp2(-beyond - static_cast<double>(cell.key.level));
      const double pixels = double(texels[index]) * texelPixels * texelPixels;
      if (kept[index] && texelPixels <= 0.5)
        return kCosts.impostorUs + 2 * kCosts.texelUs * double(texels[index]) +
               pixels * (kCosts.pixelUs + kCosts.errorUs * kCosts.impostorError);
      if (cell.childCount == 0)
        return kCosts.meshUs + kCosts.triangleUs * static_cast<double>(cell.triangles) +
               pixels * kCosts.errorUs * kCosts.triangleError;
      double sum = 0;
      for (uint32_t child = 0; child < cell.childCount; ++child) sum += draw(cell.firstChild + child);
      return sum;
    };
    total += draw(0) / 2;
  }
  return total;
}

TEST(Worth, IsWhatTheModelSaves) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    SCOPED_TRACE(seed);
    const Scene scene = randomScene(seed);
    const std::vector<float> texels = meanTexels(scene);
    Worth worth(scene.cells, texels);
    std::vector<bool> kept(scene.cells.size());
    std::mt19937 random(seed);
    for (int i = 0; i < 30; ++i) {
      const auto cell = static_cast<uint32_t>(random() % scene.cells.size());
      if (kept[cell]) continue;
      const double without = costOf(scene, texels, kept);
      kept[cell] = true;
      const double saved = without - costOf(scene, texels, kept);
      kept[cell] = false;
      EXPECT_NEAR(worth.of(cell, [&](uint32_t above) { return kept[above]; }), saved, 1e-9 * without) << cell;
      if (i % 3 == 0) continue;
      kept[cell] = true;
      worth.keep(cell);
    }
  }
}

TEST(Choose, KeepsWhatIsWorthItsBytes) {
  Scene scene = randomScene(1);
  const Choice choice = *chooseViews(scene.input(), {.leastWorthPerByte = -1e9});
  for (size_t i = 0; i < scene.views.size(); ++i) {
    const CellRecord& cell = scene.cells[scene.views[i].cell];
    if (scene.views[i].texels > 0 && (cell.childCount > 1 || cell.triangles > 1000)) {
      EXPECT_TRUE(choice.views[i] == ViewFate::kept || choice.views[i] == ViewFate::sameAsChild);
    }
  }
  EXPECT_GT(choice.counts[size_t(ViewFate::empty)].views, 0u);
  EXPECT_EQ(choice.viewsLeftOut().at("empty"), choice.counts[size_t(ViewFate::empty)].views);
  const Choice none = *chooseViews(scene.input(), {.leastWorthPerByte = 1e9});
  EXPECT_EQ(none.counts[size_t(ViewFate::kept)].views, 0u);
}

TEST(Choose, LeavesOutLeavesOfFewTriangles) {
  Scene scene;
  const CellKey one{1, 0, 0, 0}, many{1, 1, 0, 0};
  scene.cells = treeOf({{one, cellBox(scene.model.grid, one), 1}, {many, cellBox(scene.model.grid, many), 10000}});
  scene.geometryBytes = {0, 50, 40000};
  for (uint32_t cell = 0; cell < 3; ++cell)
    for (uint32_t view = 0; view < 42; ++view) scene.views.push_back({cell, view, 3000, 8000});
  const Choice choice = *chooseViews(scene.input(), {.leastWorthPerByte = -1e9});
  EXPECT_EQ(choice.views[42], ViewFate::cheaperAsTriangles);
  EXPECT_EQ(choice.views[84], ViewFate::kept);
  EXPECT_EQ(choice.counts[size_t(ViewFate::cheaperAsTriangles)].views, 42u);
  EXPECT_EQ(choice.counts[size_t(ViewFate::cheaperAsTriangles)].bytes,
            packBytes(scene, std::vector<ViewFate>(126, ViewFate::kept)) - packBytes(scene, choice.views));
}

TEST(Choose, KeepsOneOfTwoCellsOfTheSameContent) {
  Scene scene;
  const CellKey leaf{2, 1, 1, 1};
  scene.cells = treeOf({{leaf, cellBox(scene.model.grid, leaf), 10000}});
  std::mt19937 random(1);
  scene.bake(random);
  const std::vector<int> kept = wholeCells(scene, chooseViews(scene.input(), {})->views);
  EXPECT_EQ(kept, (std::vector<int>{0, 0, 1}));
}

TEST(Choose, CountsViewsThatWereNotBaked) {
  Scene scene = randomScene(2);
  const size_t all = scene.views.size();
  std::erase_if(scene.views, [](const ViewCost& view) { return view.view % 3 == 0; });
  const Choice choice = *chooseViews(scene.input(), {});
  EXPECT_EQ(choice.counts[size_t(ViewFate::notVisitable)].views, all - scene.views.size());
  EXPECT_GT(choice.counts[size_t(ViewFate::notVisitable)].bytes, 0u);
  uint64_t counted = 0;
  for (const LeftOutCount& count : choice.counts) counted += count.views;
  EXPECT_EQ(counted, all);
}

TEST(Choose, NeverExceedsABudget) {
  for (const unsigned seed : {1u, 2u, 3u, 4u}) {
    SCOPED_TRACE(seed);
    const Scene scene = randomScene(seed);
    const ChooseSettings all{.leastWorthPerByte = -1e9};
    const Choice whole = *chooseViews(scene.input(), all);
    EXPECT_GE(whole.packBytes, packBytes(scene, whole.views));
    const uint64_t least = packBytes(scene, std::vector<ViewFate>(scene.views.size(), ViewFate::packBudget)) + 8192;
    for (const BudgetRule rule : {BudgetRule::worth, BudgetRule::triangles}) {
      uint64_t before = 0;
      for (int part = 0; part <= 10; ++part) {
        ChooseSettings settings = all;
        settings.rule = rule;
        settings.packBudgetBytes = least + (whole.packBytes - least) * static_cast<uint64_t>(part) / 10;
        const Choice choice = *chooseViews(scene.input(), settings);
        EXPECT_LE(choice.packBytes, *settings.packBudgetBytes);
        EXPECT_LE(packBytes(scene, choice.views), choice.packBytes);
        EXPECT_GE(choice.packBytes + 600'000, std::min(*settings.packBudgetBytes, whole.packBytes)) << "spends it";
        EXPECT_GE(choice.counts[size_t(ViewFate::kept)].views, before / 2);
        before = choice.counts[size_t(ViewFate::kept)].views;
        wholeCells(scene, choice.views);
      }
    }
  }
}

TEST(Choose, WorthBuysMoreThanTriangleCounts) {
  double saved[2] = {0, 0};
  for (const unsigned seed : {1u, 2u, 3u, 4u}) {
    const Scene scene = randomScene(seed);
    const std::vector<float> texels = meanTexels(scene);
    const uint64_t whole = chooseViews(scene.input(), {.leastWorthPerByte = -1e9})->packBytes;
    const double nothing = costOf(scene, texels, std::vector<bool>(scene.cells.size()));
    for (const BudgetRule rule : {BudgetRule::worth, BudgetRule::triangles}) {
      const Choice choice = *chooseViews(scene.input(), {-1e9, whole / 2 + whole / 4, rule});
      std::vector<bool> kept;
      for (const int keeps : wholeCells(scene, choice.views)) kept.push_back(keeps == 1);
      const double cost = costOf(scene, texels, kept);
      EXPECT_NEAR(choice.costUs, cost, 1e-9 * cost);
      saved[static_cast<size_t>(rule)] += 1 - cost / nothing;
    }
  }
  EXPECT_GT(saved[0], saved[1]);
}

TEST(Choose, NamesTheLeastPossibleBudget) {
  const Scene scene = randomScene(1);
  const auto tooSmall = chooseViews(scene.input(), {.packBudgetBytes = 1000});
  ASSERT_FALSE(tooSmall);
  EXPECT_EQ(tooSmall.error().kind, ErrorKind::exhausted);
  const size_t at = tooSmall.error().message.find("at least ");
  ASSERT_NE(at, std::string::npos) << tooSmall.error().message;
  const uint64_t least = std::stoull(tooSmall.error().message.substr(at + 9));
  EXPECT_TRUE(chooseViews(scene.input(), {.packBudgetBytes = least}));
  EXPECT_FALSE(chooseViews(scene.input(), {.packBudgetBytes = least - 1}));
}

TEST(Choose, ReportsALineForEachReason) {
  const Scene scene = randomScene(1);
  const uint64_t whole = chooseViews(scene.input(), {})->packBytes;
  const Choice choice = *chooseViews(scene.input(), {.packBudgetBytes = whole - 1});
  const std::vector<std::string> lines = reportLines(choice);
  EXPECT_EQ(lines.size(), choice.viewsLeftOut().size());
  EXPECT_NE(lines.back().find("packBudget"), std::string::npos);
}

}  // namespace
}  // namespace farcell
