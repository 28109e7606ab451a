#include "tools/report/build_summary.h"

#include <fmt/format.h>

#include <algorithm>

#include "cache/base/progress_text.h"

namespace farcell {
namespace {

std::string secondsText(std::optional<double> seconds) { return seconds ? fmt::format("{:.2f}", *seconds) : "-"; }

std::string bytesOrNone(std::optional<uint64_t> bytes) { return bytes ? bytesText(*bytes) : "-"; }

std::string rateText(const BuildSummary::Stage& stage) {
  if (stage.units == 0 || !(stage.seconds > 0)) return "-";
  return fmt::format("{} {}/s", countText(static_cast<double>(stage.units) / stage.seconds), stage.unit);
}

// "2.15 GB of 4.00 GB"
std::string ofLimit(uint64_t bytes, uint64_t limit) {
  return limit == 0 ? bytesText(bytes) : fmt::format("{} of {}", bytesText(bytes), bytesText(limit));
}

std::string stageTable(const BuildSummary& summary) {
  std::string text = fmt::format("{:<12}{:>10}{:>10}{:>22}{:>12}\n", "stage", "seconds", "CPU s", "rate", "bytes");
  for (const BuildSummary::Stage& stage : summary.stages)
    text += fmt::format("{:<12}{:>10.2f}{:>10}{:>22}{:>12}\n", stage.name, stage.seconds, secondsText(stage.cpuSeconds),
                        rateText(stage), bytesOrNone(stage.bytes));
  const BuildSummary::Stage total{"total", summary.seconds, summary.cpuSeconds, summary.triangles, "triangles", {}};
  text += fmt::format("{:<12}{:>10.2f}{:>10.2f}{:>22}{:>12}\n", total.name, total.seconds, summary.cpuSeconds,
                      rateText(total), bytesText(summary.packBytes));
  return text;
}

std::string partLine(const std::string& name, uint64_t bytes, const BuildSummary& summary) {
  if (summary.packBytes == 0) return fmt::format("{:<12}{:>10}\n", name, bytesText(bytes));
  const double share = 100 * static_cast<double>(bytes) / static_cast<double>(summary.packBytes);
  const double each = static_cast<double>(bytes) / static_cast<double>(std::max<uint64_t>(summary.triangles, 1));
  return fmt::format("{:<12}{:>10}{:>9.1f}%{:>22.2f}\n", name, bytesText(bytes), share, each);
}

std::string partTable(const BuildSummary& summary) {
  std::string text = fmt::format("{:<12}{:>10}{:>10}{:>22}\n", "pack", "bytes", "share", "bytes a triangle");
  uint64_t known = 0;
  for (const BuildSummary::Part& part : summary.parts) {
    text += partLine(part.name, part.bytes, summary);
    known += part.bytes;
  }
  if (known < summary.packBytes) text += partLine("other", summary.packBytes - known, summary);
  return text;
}

std::string leftOutTable(const BuildSummary& summary) {
  if (summary.leftOut.empty()) return "";
  std::string text = fmt::format("\n{:<12}{:>10}{:>12}  {}\n", "left out", "count", "bytes saved", "why");
  for (const BuildSummary::LeftOut& row : summary.leftOut)
    text += fmt::format("{:<12}{:>10}{:>12}  {}\n", row.what, row.count, bytesOrNone(row.bytesSaved), row.why);
  return text;
}

std::string expectedTable(const BuildSummary& summary) {
  if (summary.expected.empty()) return "";
  std::string text = fmt::format("\n{:<16}{:>8}", "expected errors", "cells");
  for (const std::string& scale : summary.expected[0].scales) text += fmt::format("{:>14}", scale);
  text += "   median, 90 % off by\n";
  for (const BuildSummary::Expected& row : summary.expected) {
    text += fmt::format("{:<16}{:>8}", row.way, row.cells);
    for (size_t scale = 0; scale < row.median.size(); ++scale)
      text +=
          fmt::format("{:>14}", fmt::format("{:.0f} %, {:.0f} %", 100 * row.median[scale], 100 * row.ninetieth[scale]));
    text += '\n';
  }
  return text;
}

std::string formsTable(const BuildSummary& summary) {
  if (summary.forms.empty()) return "";
  std::string text =
      fmt::format("\n{:<20}{:>10}{:>10}{:>10}{:>14}\n", "views chosen", "cells", "views", "size", "bytes a cell");
  for (const BuildSummary::Form& row : summary.forms)
    text += fmt::format("{:<20}{:>10}{:>10}{:>10}{:>14}\n", row.kind, row.cells, row.views, row.imageSize,
                        bytesText(static_cast<uint64_t>(row.bytes)));
  return text;
}

}  // namespace

std::string buildSummaryText(const BuildSummary& summary) {
  return fmt::format(
      "{} triangles, {} + {} inner cells, {} of {} views kept\n\n{}\n{}{}{}{}\npack {}; peak memory {}\n",
      summary.triangles, summary.leaves, summary.innerCells, summary.viewsKept, summary.viewsBaked, stageTable(summary),
      partTable(summary), leftOutTable(summary), expectedTable(summary), formsTable(summary),
      ofLimit(summary.packBytes, summary.packBudget), ofLimit(summary.peakRssBytes, summary.memoryLimit));
}

}  // namespace farcell
