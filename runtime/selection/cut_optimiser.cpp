#include "runtime/selection/cut_optimiser.h"

#include <algorithm>
#include <cmath>

namespace farcell {
namespace {

// A price is raised from `first` by this factor until its budget is kept or it is so high that no unit is worth it,
// whatever the size of a picture.
constexpr double kFirstPrice = 1e-6;
constexpr double kHighestPrice = 1e12;
constexpr double kPriceFactor = 16;
constexpr int kPriceSteps = 20;  // halvings of the logarithm between two prices
constexpr int kRounds = 4;       // through all budgets: raising one price may pass another budget
constexpr int kFillSteps = 12;   // halvings of the prices that fill what is left

// A node as decided, with all below it.
struct Choice {
  Drawn drawn = Drawn::byChildren;
  double loss = kNever;
  Amounts amounts{};
};

double costAt(const Amounts& prices, double loss, const Amounts& amounts) {
  double cost = loss;
  for (size_t r = 0; r < kResources; ++r) cost += prices[r] * amounts[r];
  return cost;
}

class Optimiser {
 public:
  Optimiser(const std::vector<CutNode>& nodes, const Amounts& prices, const Amounts& budgets)
      : nodes_(nodes), base_(prices), budgets_(budgets), prices_(prices), best_(nodes.size()), trial_(nodes.size()) {}

  CutDecision run() {
    if (nodes_.empty()) return {};
    raisePrices();
    best_ = trial_;
    if (prices_ != base_) fill();
    CutDecision decision;
    for (const Choice& choice : best_) decision.drawn.push_back(choice.drawn);
    decision.loss = best_[0].loss;
    decision.amounts = best_[0].amounts;
    decision.cost = costAt(base_, decision.loss, decision.amounts);
    decision.bound = std::min(bound_, decision.cost);
    decision.budgetBinds = prices_ != base_;
    return decision;
  }

 private:
  Choice sumOfChildren(const std::vector<Choice>& choices, size_t place) const {
    Choice sum{.drawn = Drawn::byChildren, .loss = 0, .amounts = {}};
    for (size_t child = place + 1; child < nodes_[place].end; child = nodes_[child].end) {
      sum.loss += choices[child].loss;
      for (size_t r = 0; r < kResources; ++r) sum.amounts[r] += choices[child].amounts[r];
    }
    return sum;
  }

  // The best cut at these prices, in trial_. Of equal ones that of the children, then the mesh.
  void decide(const Amounts& prices) {
    for (size_t i = nodes_.size(); i-- > 0;) {
      Choice& choice = trial_[i];
      choice = nodes_[i].open ? sumOfChildren(trial_, i) : Choice{};
      double cost = costAt(prices, choice.loss, choice.amounts);
      const auto offer = [&](Drawn drawn, const Way& way) {
        const double offered = costAt(prices, way.loss, way.amounts);
        if (!(offered < cost)) return;
        cost = offered;
        choice = {drawn, way.loss, way.amounts};
      };
      offer(Drawn::asMesh, nodes_[i].mesh);
      offer(Drawn::asViews, nodes_[i].views);
    }
    double bound = costAt(prices, trial_[0].loss, trial_[0].amounts);
    for (size_t r = 0; r < kResources; ++r)
      if (prices[r] > base_[r]) bound -= (prices[r] - base_[r]) * budgets_[r];
    bound_ = std::max(bound_, bound);
  }

  bool passes(size_t r) const { return trial_[0].amounts[r] > budgets_[r]; }

  void raisePrices() {
    decide(prices_);
    for (int round = 0; round < kRounds; ++round)
      for (size_t r = 0; r < kResources; ++r)
        if (passes(r)) raise(r);
  }

  // The least price, from the present one up, that keeps the budget.
  void raise(size_t r) {
    const auto passesAt = [&](double price) {
      prices_[r] = price;
      decide(prices_);
      return passes(r);
    };
    double low = std::max(prices_[r], kFirstPrice), high = low * kPriceFactor;
    while (high < kHighestPrice && passesAt(high)) {
      low = high;
      high *= kPriceFactor;
    }
    for (int step = 0; step < kPriceSteps; ++step) {
      const double middle = std::sqrt(low * high);
      (passesAt(middle) ? low : high) = middle;
    }
    passesAt(high);
  }

  bool fits(const Choice& old, const Choice& replacement) const {
    for (size_t r = 0; r < kResources; ++r) {
      const double change = replacement.amounts[r] - old.amounts[r];
      if (change > 0 && best_[0].amounts[r] + change > budgets_[r]) return false;
    }
    return costAt(base_, replacement.loss, replacement.amounts) < costAt(base_, old.loss, old.amounts);
  }

  // Where the trial draws something else, front to back, it is taken over if that fits and costs less.
  void adopt() {
    for (size_t i = 0; i < nodes_.size();) {
      if (best_[i].drawn == trial_[i].drawn && best_[i].drawn == Drawn::byChildren) {
        ++i;
        continue;
      }
      if (best_[i].drawn != trial_[i].drawn && fits(best_[i], trial_[i])) {
        std::copy(trial_.begin() + static_cast<ptrdiff_t>(i), trial_.begin() + nodes_[i].end,
                  best_.begin() + static_cast<ptrdiff_t>(i));
        for (size_t above = i; above-- > 0;)
          if (nodes_[above].end > i && best_[above].drawn == Drawn::byChildren) {
            const Choice sum = sumOfChildren(best_, above);
            best_[above] = sum;
          }
      }
      i = nodes_[i].end;
    }
  }

  void fill() {
    Amounts lower = prices_;
    for (int step = 0; step < kFillSteps; ++step) {
      for (size_t r = 0; r < kResources; ++r) lower[r] = std::max(base_[r], lower[r] / 2);
      decide(lower);
      adopt();
    }
  }

  const std::vector<CutNode>& nodes_;
  const Amounts base_;
  const Amounts budgets_;
  Amounts prices_;
  std::vector<Choice> best_;
  std::vector<Choice> trial_;
  double bound_ = -kNever;
};

}  // namespace

CutDecision decideCut(const std::vector<CutNode>& nodes, const Amounts& prices, const Amounts& budgets) {
  return Optimiser(nodes, prices, budgets).run();
}

}  // namespace farcell
