#include "tests/bench/wscg2010/measure/table.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cache/base/check.h"

namespace farcell::wscg {
namespace {

std::string joined(const std::vector<std::string>& cells, const char* between) {
  std::string line;
  for (size_t i = 0; i < cells.size(); ++i) line += (i > 0 ? between : "") + cells[i];
  return line;
}

}  // namespace

std::string Table::csv() const {
  std::string text = joined(header, ",") + "\n";
  for (const auto& row : rows) {
    FARCELL_CHECK_EQ(row.size(), header.size());
    text += joined(row, ",") + "\n";
  }
  return text;
}

std::string Table::markdown() const {
  std::string text = "| " + joined(header, " | ") + " |\n|";
  for (size_t i = 0; i < header.size(); ++i) text += "---|";
  text += "\n";
  for (const auto& row : rows) text += "| " + joined(row, " | ") + " |\n";
  return text;
}

std::string number(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : std::string("-");
}

std::string percent(double share) { return number(100 * share, 1) + " %"; }

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double mean(const std::vector<double>& values) {
  return values.empty() ? 0 : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace farcell::wscg
