#include "runtime/selection/cut_optimiser.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace farcell {
namespace {

// Random trees whose cuts can all be written down.
class Tree {
 public:
  explicit Tree(unsigned seed) : random_(seed) { grow(0); }

  std::vector<CutNode> nodes;

  // Every cut's loss and amounts.
  std::vector<Way> cuts(size_t place = 0) const {
    const CutNode& node = nodes[place];
    std::vector<Way> all;
    if (node.mesh.loss < kNever) all.push_back(node.mesh);
    if (node.views.loss < kNever) all.push_back(node.views);
    if (!node.open) return all;
    std::vector<Way> below = {{.loss = 0, .amounts = {}}};
    for (size_t child = place + 1; child < node.end; child = nodes[child].end) {
      std::vector<Way> sums;
      for (const Way& a : below)
        for (const Way& b : cuts(child)) {
          Way sum{a.loss + b.loss, a.amounts};
          for (size_t r = 0; r < kResources; ++r) sum.amounts[r] += b.amounts[r];
          sums.push_back(sum);
        }
      below = std::move(sums);
    }
    all.insert(all.end(), below.begin(), below.end());
    return all;
  }

 private:
  double part() { return std::uniform_real_distribution<double>(0, 1)(random_); }

  void grow(int level) {
    const size_t place = nodes.size();
    nodes.push_back({.cell = static_cast<uint32_t>(place)});
    const bool open = level < 1 || (level < 2 && part() < 0.5);
    if (open)
      for (int child = 0; child < 3; ++child) grow(level + 1);
    CutNode& node = nodes[place];
    node.open = open;
    node.end = static_cast<uint32_t>(nodes.size());
    const double size = std::pow(3.0, 2 - level);
    // A leaf can be drawn somehow.
    if (!open || part() < 0.5)
      node.mesh = way(size * (1 + part()), {3 * size * part(), std::ceil(100 * size * part()), 0, 50 * size * part()});
    if (part() < 0.5)
      node.views = way(size * (1 + 3 * part()), {size * part(), 0, 200 * size * part(), 100 * size * part()});
  }
  static Way way(double loss, const Amounts& amounts) { return {loss, amounts}; }

  std::mt19937 random_;
};

double costOf(const Way& way, const Amounts& prices) {
  double cost = way.loss;
  for (size_t r = 0; r < kResources; ++r) cost += prices[r] * way.amounts[r];
  return cost;
}

bool within(const Amounts& amounts, const Amounts& budgets) {
  for (size_t r = 0; r < kResources; ++r)
    if (amounts[r] > budgets[r]) return false;
  return true;
}

// What is drawn, summed anew.
Way drawnCut(const std::vector<CutNode>& nodes, const std::vector<Drawn>& drawn) {
  Way sum{.loss = 0, .amounts = {}};
  for (size_t i = 0; i < nodes.size();) {
    if (drawn[i] == Drawn::byChildren) {
      EXPECT_TRUE(nodes[i].open);
      ++i;
      continue;
    }
    const Way& way = drawn[i] == Drawn::asMesh ? nodes[i].mesh : nodes[i].views;
    sum.loss += way.loss;
    for (size_t r = 0; r < kResources; ++r) sum.amounts[r] += way.amounts[r];
    i = nodes[i].end;
  }
  return sum;
}

const Amounts kPrices = {0.1, 0, 0, 0};

TEST(CutOptimiser, withoutBudgetsFindsTheBestOfAllCuts) {
  for (unsigned seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    const Tree tree(seed);
    const CutDecision decision = decideCut(tree.nodes, kPrices, kNoBudgets);
    double best = kNever;
    for (const Way& cut : tree.cuts()) best = std::min(best, costOf(cut, kPrices));
    const Way drawn = drawnCut(tree.nodes, decision.drawn);
    EXPECT_NEAR(costOf(drawn, kPrices), best, 1e-9 * best);
    EXPECT_NEAR(decision.cost, best, 1e-9 * best);
    EXPECT_NEAR(decision.loss, drawn.loss, 1e-9 * best);
    EXPECT_NEAR(decision.bound, best, 1e-9 * best);
    EXPECT_FALSE(decision.budgetBinds);
  }
}

TEST(CutOptimiser, keepsBudgetsNearlyAsWellAsTheBestCutThatDoes) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(0.1, 0.9);
  size_t bound = 0, missed = 0;
  double gaps = 0, boundGaps = 0;
  for (unsigned seed = 1; seed <= 400; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    const Tree tree(seed);
    const std::vector<Way> cuts = tree.cuts();
    const CutDecision free = decideCut(tree.nodes, kPrices, kNoBudgets);
    // One budget, or two, below what the free cut takes.
    Amounts budgets = kNoBudgets;
    const size_t first = seed % kResources, second = (seed / kResources) % kResources;
    budgets[first] = free.amounts[first] * part(random);
    if (seed % 3 == 0) budgets[second] = free.amounts[second] * part(random);
    double best = kNever;
    for (const Way& cut : cuts)
      if (within(cut.amounts, budgets)) best = std::min(best, costOf(cut, kPrices));
    if (best == kNever) continue;
    const CutDecision decision = decideCut(tree.nodes, kPrices, budgets);
    const Way drawn = drawnCut(tree.nodes, decision.drawn);
    EXPECT_LE(decision.bound, best * (1 + 1e-9));
    EXPECT_NEAR(decision.loss, drawn.loss, 1e-9 * best);
    for (size_t r = 0; r < kResources; ++r)
      EXPECT_NEAR(decision.amounts[r], drawn.amounts[r], 1e-9 * (1 + drawn.amounts[r]));
    if (!within(drawn.amounts, budgets)) {
      ++missed;
      continue;
    }
    ++bound;
    EXPECT_GE(decision.cost, best * (1 - 1e-9));
    gaps += decision.cost / best - 1;
    boundGaps += 1 - decision.bound / best;
  }
  EXPECT_GT(bound, 200u);
  // Several budgets at once may defeat prices that are raised one after the other.
  EXPECT_LE(missed, bound / 20);
  const auto count = static_cast<double>(bound);
  RecordProperty("meanGap", fmt::format("{}", gaps / count));
  EXPECT_LT(gaps / count, 0.05);
  EXPECT_LT(boundGaps / count, 0.2);
  std::printf("%zu trees, mean gap %.4f, mean gap of the bound %.4f, missed %zu\n", bound, gaps / count,
              boundGaps / count, missed);
}

TEST(CutOptimiser, aBudgetThatNoCutKeepsGivesTheCutThatTakesLeast) {
  const Tree tree(3);
  Amounts budgets = kNoBudgets;
  at(budgets, Resource::triangles) = -1;
  const CutDecision decision = decideCut(tree.nodes, kPrices, budgets);
  double least = kNever;
  for (const Way& cut : tree.cuts()) least = std::min(least, cut.amounts[static_cast<size_t>(Resource::triangles)]);
  EXPECT_NEAR(decision.amounts[static_cast<size_t>(Resource::triangles)], least, 1e-9);
  EXPECT_TRUE(decision.budgetBinds);
}

TEST(CutOptimiser, ofNoNodesIsNothing) {
  const CutDecision decision = decideCut({}, kPrices, kNoBudgets);
  EXPECT_TRUE(decision.drawn.empty());
  EXPECT_EQ(decision.loss, 0);
}

}  // namespace
}  // namespace farcell
