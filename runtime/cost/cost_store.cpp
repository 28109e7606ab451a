#include "runtime/cost/cost_store.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <span>
#include <sstream>
#include <thread>

#include "cache/base/file.h"
#include "cache/base/hash.h"

namespace farcell {
namespace {

constexpr uint64_t kMaxFileBytes = 1 << 14;
constexpr size_t kNumbers = 5;

std::array<double, kNumbers> numbersOf(const DrawCosts& costs) {
  return {costs.picturePixelMs, costs.triangleMs, costs.meshPixelMs, costs.impostorMs, costs.impostorPixelMs};
}

std::string hostName() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

// A line of a file that anybody may have written.
std::string oneLine(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

Result<DrawCosts> parseLine(const std::string& line, size_t number) {
  std::array<double, kNumbers> values{};
  const char* at = line.data();
  const char* end = at + line.size();
  for (double& value : values) {
    while (at != end && *at == ' ') ++at;
    const auto read = std::from_chars(at, end, value);
    if (read.ec != std::errc{} || !std::isfinite(value) || value < 0)
      return fail(ErrorKind::corrupt, "line {}: expected {} numbers of at least 0, found '{}'", number, kNumbers, line);
    at = read.ptr;
  }
  if (at != end) return fail(ErrorKind::corrupt, "line {}: expected {} numbers, found '{}'", number, kNumbers, line);
  return DrawCosts{values[0], values[1], values[2], values[3], values[4]};
}

}  // namespace

std::optional<std::filesystem::path> costsPath(const std::string& renderer) {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  const char* home = std::getenv("HOME");
  std::filesystem::path directory;
  if (cache != nullptr && cache[0] == '/')
    directory = cache;
  else if (home != nullptr && home[0] == '/')
    directory = std::filesystem::path(home) / ".cache";
  else
    return std::nullopt;
  const std::string machine = fmt::format("{}\n{}\n{}", hostName(), std::thread::hardware_concurrency(), renderer);
  return directory / "farcell" / fmt::format("costs-{:016x}.txt", hashBytes(std::as_bytes(std::span(machine))));
}

std::string costsText(const CostModel& costs, const std::string& renderer) {
  std::string text = fmt::format("farcell-costs {}\n{}\n", kCostsVersion, oneLine(renderer));
  for (const DrawCosts& draw : costs.draws) text += fmt::format("{}\n", fmt::join(numbersOf(draw), " "));
  return text;
}

Result<CostModel> parseCosts(const std::string& text, const std::string& renderer) {
  std::istringstream stream(text);
  std::string line;
  const std::string head = fmt::format("farcell-costs {}", kCostsVersion);
  if (!std::getline(stream, line) || line != head)
    return fail(ErrorKind::corrupt, "line 1: expected '{}', found '{}'", head, line);
  if (!std::getline(stream, line) || line != oneLine(renderer))
    return fail(ErrorKind::corrupt, "line 2: expected '{}', found '{}'", renderer, line);
  CostModel costs;
  for (size_t i = 0; i < costs.draws.size(); ++i) {
    line.clear();
    std::getline(stream, line);
    FARCELL_ASSIGN(costs.draws[i], parseLine(line, i + 3));
    if (costs.draws[i] == DrawCosts{}) return fail(ErrorKind::corrupt, "line {}: nothing costs anything", i + 3);
  }
  return costs;
}

std::optional<CostModel> loadCosts(const std::filesystem::path& path, const std::string& renderer) {
  const Result<std::string> text = readTextFile(path, kMaxFileBytes);
  if (!text) return std::nullopt;
  const Result<CostModel> costs = parseCosts(*text, renderer);
  return costs ? std::optional(*costs) : std::nullopt;
}

Result<> saveCosts(const std::filesystem::path& path, const CostModel& costs, const std::string& renderer) {
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);
  if (error)
    return fail(ErrorKind::io, "{}: cannot make the directory: {}", path.parent_path().string(), error.message());
  return writeTextFile(path, costsText(costs, renderer));
}

}  // namespace farcell
