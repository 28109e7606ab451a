// The cut of the least loss that budgets allow, over a tree of cells each of which may be drawn in two ways or by those
// below it.
//
// Budgets are met by prices (Everett, Generalized Lagrange multiplier method, 1963): the best cut of a price vector is
// found exactly, bottom up, and no cut that takes as little loses less. A budget that is passed has its price raised
// until it is kept, one after the other until all are: in most frames one binds. What such a cut leaves free is then
// filled with the best of what lower prices would change. The prices also bound what any cut could reach.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace farcell {

inline constexpr double kNever = std::numeric_limits<double>::infinity();

// What a cut takes of each; budgets and prices likewise.
enum class Resource : uint8_t { milliseconds, triangles, texels, bytes };
inline constexpr size_t kResources = 4;
using Amounts = std::array<double, kResources>;
inline constexpr Amounts kNoBudgets = {kNever, kNever, kNever, kNever};
inline double& at(Amounts& amounts, Resource resource) { return amounts[static_cast<size_t>(resource)]; }

struct Way {
  double loss = kNever;  // kNever: it is not drawn so
  Amounts amounts{};
};

// Nodes lie in depth-first order.
struct CutNode {
  uint32_t cell = 0;
  uint32_t end = 0;   // index after the last node below it
  bool open = false;  // those below may be drawn instead
  double areaPixels = 0;
  Way views{};
  Way mesh{};
};

enum class Drawn : uint8_t { byChildren, asMesh, asViews };

struct CutDecision {
  std::vector<Drawn> drawn;  // by node; what lies below one that is drawn itself has no meaning
  double loss = 0;           // of the cut
  Amounts amounts{};         // that it takes: within the budgets unless no cut is
  double cost = 0;           // loss and amounts at the prices: what is made least
  double bound = 0;          // no cut within the budgets costs less
  bool budgetBinds = false;
};

// `prices`: what every unit costs even where no budget binds.
CutDecision decideCut(const std::vector<CutNode>& nodes, const Amounts& prices, const Amounts& budgets);

}  // namespace farcell
