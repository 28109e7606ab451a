#include "tools/evaluate/plan/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <set>
#include <sstream>

#include "tools/cli/cli.h"

namespace farcell {
namespace {

// Values are doubles: counts below 2^53 are exact in them, and parseCount() goes through one.
struct Setting {
  const char* name;
  bool (*isOf)(const RendererPlan& plan);
  Result<double> (*parse)(const std::string& text);
  std::string (*text)(double value);  // one for each value, however it was written
  void (*set)(SelectionSettings& settings, double value);
};

struct Sweep {
  const Setting* setting = nullptr;
  std::vector<double> values;
};

Result<double> parseNumber(const std::string& text, double least, double most) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, value);
  if (read.ec != std::errc{} || read.ptr != end || !(value >= least && value <= most))
    return fail(ErrorKind::invalidArgument, "expected a number from {} to {}, found '{}'", least, most, text);
  return value;
}

Result<double> parseBudget(const std::string& text) {
  FARCELL_ASSIGN(const uint64_t count, parseCount(text));
  return static_cast<double>(count);
}

// As short as parseCount() reads it.
std::string countText(double value) {
  auto count = static_cast<uint64_t>(value);
  std::string_view unit = "";
  for (const char* next : {"k", "M", "G"}) {
    if (count == 0 || count % 1000 != 0) break;
    count /= 1000;
    unit = next;
  }
  return fmt::format("{}{}", count, unit);
}

std::string numberText(double value) { return fmt::format("{}", value); }

constexpr std::array kSettings = {
    Setting{"texel-pixels", [](const RendererPlan& plan) { return usesTexelPixels(plan.settings.selection.mode); },
            [](const std::string& text) { return parseNumber(text, kLeastTexelPixels, kMostTexelPixels); }, numberText,
            [](SelectionSettings& settings, double value) { settings.texelPixels = value; }},
    Setting{
        "mesh-pixels",
        [](const RendererPlan& plan) { return usesMeshPixels(plan.settings.selection.mode) && plan.timeOf.empty(); },
        [](const std::string& text) { return parseNumber(text, 0, kMostMeshPixels); }, numberText,
        [](SelectionSettings& settings, double value) { settings.meshPixels = value; }},
    Setting{"triangle-budget",
            [](const RendererPlan& plan) { return usesTriangleBudget(plan.settings.selection.mode); }, parseBudget,
            countText,
            [](SelectionSettings& settings, double value) { settings.triangleBudget = static_cast<uint64_t>(value); }},
    Setting{"time-budget-ms", [](const RendererPlan& plan) { return usesTimeBudget(plan.settings.selection.mode); },
            [](const std::string& text) { return parseNumber(text, 0, kMostTimeBudgetMs); }, numberText,
            [](SelectionSettings& settings, double value) { settings.timeBudgetMs = value; }},
};

std::string knownSettings() {
  std::string text;
  for (const Setting& setting : kSettings) text += fmt::format("{}{}=VALUES", text.empty() ? "" : ", ", setting.name);
  return text;
}

Result<Sweep> parseSweep(const std::string& text) {
  const size_t equals = std::min(text.find('='), text.size());
  const std::string name = text.substr(0, equals);
  const auto* setting = std::find_if(kSettings.begin(), kSettings.end(),
                                     [&](const Setting& candidate) { return candidate.name == name; });
  if (setting == kSettings.end() || equals == text.size())
    return fail(ErrorKind::invalidArgument, "--sweep: expected one of {}; found '{}'", knownSettings(), text);
  Sweep sweep{setting, {}};
  // The comma at the end makes an empty value of nothing between commas, also at the end.
  std::istringstream stream(text.substr(equals + 1) + ",");
  for (std::string word; std::getline(stream, word, ',');) {
    const Result<double> value = setting->parse(word);
    if (!value) return fail(value.error().kind, "--sweep {}: {}", name, value.error().message);
    if (std::find(sweep.values.begin(), sweep.values.end(), *value) == sweep.values.end())
      sweep.values.push_back(*value);
  }
  return sweep;
}

Result<std::vector<RendererPlan>> applySweep(const std::vector<RendererPlan>& plans, const Sweep& sweep) {
  const auto isSwept = [&](const RendererPlan& plan) { return sweep.setting->isOf(plan); };
  const auto swept = static_cast<size_t>(std::count_if(plans.begin(), plans.end(), isSwept));
  if (swept == 0)
    return fail(ErrorKind::invalidArgument, "--sweep {}: none of the renderers has this setting", sweep.setting->name);
  const size_t count = plans.size() - swept + swept * sweep.values.size();
  if (count > kMaxRenderers)
    return fail(ErrorKind::invalidArgument, "--sweep {}: expected at most {} renderers, found {}", sweep.setting->name,
                kMaxRenderers, count);
  std::vector<RendererPlan> all;
  for (const RendererPlan& plan : plans) {
    if (!isSwept(plan)) {
      all.push_back(plan);
      continue;
    }
    for (const double value : sweep.values) {
      RendererPlan& variant = all.emplace_back(plan);
      variant.name += fmt::format("@{}={}", sweep.setting->name, sweep.setting->text(value));
      sweep.setting->set(variant.settings.selection, value);
    }
  }
  return all;
}

}  // namespace

Result<std::vector<RendererPlan>> sweepRenderers(std::vector<RendererPlan> plans, std::span<const std::string> sweeps) {
  std::set<std::string> done;
  for (const std::string& text : sweeps) {
    FARCELL_ASSIGN(const Sweep sweep, parseSweep(text));
    if (!done.insert(sweep.setting->name).second)
      return fail(ErrorKind::invalidArgument, "--sweep {}: given twice", sweep.setting->name);
    FARCELL_ASSIGN(plans, applySweep(plans, sweep));
  }
  return plans;
}

}  // namespace farcell
