#include "cache/base/progress_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace farcell {
namespace {
constexpr size_t kLeastBar = 4;
constexpr size_t kMostBar = 40;

int percentOf(double share) { return static_cast<int>(share * 100); }

// A number in [0, 1000) in three digits; a factor of 1000 a unit.
std::string scaled(double value, std::span<const std::string_view> units) {
  size_t unit = 0;
  while (unit + 1 < units.size() && value >= 999.5) {
    value /= 1000;
    ++unit;
  }
  const int digits = unit == 0 || value >= 99.95 ? 0 : value >= 9.995 ? 1 : 2;
  return fmt::format("{:.{}f}{}", value, digits, units[unit]);
}

// ", 1:23 left"
std::string timeLeft(const StageProgress& stage) {
  const std::optional<double> left = stage.secondsLeft();
  return left ? fmt::format(", {} left", durationText(*left)) : "";
}

// "memory 38%"
std::string shareUsed(const BudgetUse& budget) {
  if (budget.limit == 0) return fmt::format("{} {}", budget.name, bytesText(budget.used));
  return fmt::format("{} {}%", budget.name,
                     percentOf(static_cast<double>(budget.used) / static_cast<double>(budget.limit)));
}

// "memory 812 MB of 2.15 GB"
std::string amountUsed(const BudgetUse& budget) {
  std::string text = fmt::format("{} {}", budget.name, bytesText(budget.used));
  if (budget.limit > 0) text += fmt::format(" of {}", bytesText(budget.limit));
  return text;
}

// Names are words of ours; what JSON would have escaped is left out.
std::string jsonQuoted(std::string_view name) {
  std::string text = "\"";
  for (const char c : name)
    if (c != '"' && c != '\\' && static_cast<unsigned char>(c) >= ' ') text += c;
  text += '"';
  return text;
}

std::string budgetsJson(std::span<const BudgetUse> budgets) {
  std::string text = "[";
  for (const BudgetUse& budget : budgets) {
    if (text.size() > 1) text += ',';
    text += fmt::format("{{\"name\":{},\"used\":{}", jsonQuoted(budget.name), budget.used);
    if (budget.limit > 0) text += fmt::format(",\"limit\":{}", budget.limit);
    text += '}';
  }
  text += ']';
  return text;
}
}  // namespace

double StageProgress::share() const {
  return total > 0 ? std::min(1.0, static_cast<double>(done) / static_cast<double>(total)) : 1.0;
}

double StageProgress::unitsPerSecond() const { return seconds > 0 ? static_cast<double>(done) / seconds : 0; }

std::optional<double> StageProgress::secondsLeft() const {
  if (done == 0 || total == 0) return std::nullopt;
  return seconds * (1 - share()) / share();
}

std::string progressBar(const StageProgress& stage, std::span<const BudgetUse> budgets, size_t columns) {
  const std::string head = fmt::format("{:<10} {:3}% ", stage.stage, percentOf(stage.share()));
  std::string tail = fmt::format("{} {}/s{}", countText(stage.unitsPerSecond()), stage.unit, timeLeft(stage));
  std::string_view separator = "; ";
  for (const BudgetUse& budget : budgets) {
    tail += fmt::format("{}{}", separator, shareUsed(budget));
    separator = ", ";
  }
  const size_t fixed = head.size() + tail.size() + 3;
  if (fixed + kLeastBar > columns) return fmt::format("{}{}", head, tail).substr(0, columns);
  const size_t width = std::min(kMostBar, columns - fixed);
  const auto full = static_cast<size_t>(stage.share() * static_cast<double>(width));
  return fmt::format("{}[{:#<{}}{:.<{}}] {}", head, "", full, "", width - full, tail);
}

std::string progressLine(const StageProgress& stage, std::span<const BudgetUse> budgets, bool ended) {
  std::string line = fmt::format("{:<10} {:3}% {:>12}/{} {}, {}/s", stage.stage, percentOf(stage.share()), stage.done,
                                 stage.total, stage.unit, countText(stage.unitsPerSecond()));
  line += ended ? fmt::format(", {}", durationText(stage.seconds)) : timeLeft(stage);
  std::string_view separator = "; ";
  for (const BudgetUse& budget : budgets) {
    line += fmt::format("{}{}", separator, amountUsed(budget));
    separator = ", ";
  }
  return line;
}

std::string progressJson(std::string_view event, const StageProgress& stage, std::span<const BudgetUse> budgets) {
  std::string text =
      fmt::format("{{\"event\":{},\"stage\":{},\"unit\":{},\"done\":{},\"total\":{},\"seconds\":{:.3f},\"rate\":{:.1f}",
                  jsonQuoted(event), jsonQuoted(stage.stage), jsonQuoted(stage.unit), stage.done, stage.total,
                  stage.seconds, stage.unitsPerSecond());
  if (const std::optional<double> left = stage.secondsLeft(); left && event == "advance")
    text += fmt::format(",\"secondsLeft\":{:.1f}", *left);
  text += fmt::format(",\"budgets\":{}}}", budgetsJson(budgets));
  return text;
}

std::string countText(double count) {
  static constexpr std::string_view kUnits[] = {"", "k", "M", "G", "T"};
  if (count > 0 && count < 9.95) return fmt::format("{:.1f}", count);
  return scaled(count, kUnits);
}

std::string durationText(double seconds) {
  if (!(seconds < 1e9)) return "ages";
  if (seconds < 9.95) return fmt::format("{:.1f} s", seconds);
  const auto whole = static_cast<uint64_t>(std::llround(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string bytesText(uint64_t bytes) {
  static constexpr std::string_view kUnits[] = {" B", " kB", " MB", " GB", " TB"};
  return scaled(static_cast<double>(bytes), kUnits);
}

}  // namespace farcell
