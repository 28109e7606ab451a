// Measured costs, kept from one start to the next: a small text file for each machine and OpenGL renderer.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cache/base/result.h"
#include "runtime/cost/draw_costs.h"

namespace farcell {

inline constexpr int kCostsVersion = 1;  // of the file and of what its numbers multiply: others are measured again

// <XDG_CACHE_HOME, or HOME/.cache>/farcell/costs-<hash of host, cores and renderer>.txt; nothing where neither variable
// holds an absolute path.
std::optional<std::filesystem::path> costsPath(const std::string& renderer);

// A line "farcell-costs <version>", one of the renderer, then a line for each of CostModel::draws.
std::string costsText(const CostModel& costs, const std::string& renderer);
// Trusts nothing: numbers must be finite and not negative, and something must cost something. corrupt: what else it is.
Result<CostModel> parseCosts(const std::string& text, const std::string& renderer);

// Nothing where there is no such file or it says something else.
std::optional<CostModel> loadCosts(const std::filesystem::path& path, const std::string& renderer);
// Makes the directories.
Result<> saveCosts(const std::filesystem::path& path, const CostModel& costs, const std::string& renderer);

}  // namespace farcell
