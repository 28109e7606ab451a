// What a Progress says, as text: no colour, no cursor, widths as asked for.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace farcell {

// One stage as it stands.
struct StageProgress {
  std::string stage;  // "bake"
  std::string unit;   // "views"
  uint64_t done = 0;
  uint64_t total = 0;
  double seconds = 0;  // since it began

  double share() const;  // in [0, 1]; 1 for a stage of nothing
  double unitsPerSecond() const;
  std::optional<double> secondsLeft() const;  // at the rate so far; nothing before the first unit
};

// A bounded thing and how much of it is used, in bytes.
struct BudgetUse {
  std::string name;  // "memory"
  uint64_t used = 0;
  uint64_t limit = 0;  // 0: not known
};

// "bake       45% [####.....] 12.3k views/s, 1:23 left; memory 38%, disk 34%": at most `columns` wide. What does not
// fit is left out from the end; the bar takes what is left over.
std::string progressBar(const StageProgress& stage, std::span<const BudgetUse> budgets, size_t columns);
// "bake       45%       6300/14000 views, 12.3k/s, 1:23 left; memory 0.81 of 2.15 GB"; of an ended stage its duration.
std::string progressLine(const StageProgress& stage, std::span<const BudgetUse> budgets, bool ended);
// {"event":"advance","stage":"bake","unit":"views","done":6300,"total":14000,"seconds":5.1,"rate":1235.3,
//  "secondsLeft":6.2,"budgets":[{"name":"memory","used":812000000,"limit":2147483648}]}
// The event: "begin", "advance" or "end". secondsLeft and a limit are absent where they are not known.
std::string progressJson(std::string_view event, const StageProgress& stage, std::span<const BudgetUse> budgets);

// Three digits: 999, "12.3k", "4.56M", "789G".
std::string countText(double count);
// "0.4 s" below ten seconds, "48 s" below a minute, else "1:23" or "2:03:10".
std::string durationText(double seconds);
// Decimal units: "812 B", "8.12 MB", "2.15 GB".
std::string bytesText(uint64_t bytes);

}  // namespace farcell
