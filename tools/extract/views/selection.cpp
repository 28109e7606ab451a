#include <algorithm>
#include <array>
#include <charconv>
#include <numeric>
#include <string_view>

#include "tools/extract/views/extract.h"

namespace farcell {
namespace {

// All of `text` as whole numbers with a separator between them; false for anything else.
bool parseNumbers(std::string_view text, char separator, std::span<uint32_t> out) {
  const char* at = text.data();
  const char* const end = at + text.size();
  for (size_t i = 0; i < out.size(); ++i) {
    const auto [next, code] = std::from_chars(at, end, out[i]);
    const bool last = i + 1 == out.size();
    if (code != std::errc{} || (last ? next != end : next == end || *next != separator)) return false;
    at = next + 1;
  }
  return true;
}

}  // namespace

Result<std::vector<uint32_t>> parseCells(const std::string& text, const Directory& directory) {
  std::vector<uint32_t> cells;
  if (text == "all") {
    for (uint32_t i = 0; i < directory.cells.size(); ++i)
      if (directory.cells[i].firstViewPage != kNone) cells.push_back(i);
    return cells;
  }
  std::array<uint32_t, 1> index{};
  std::array<uint32_t, 4> key{};
  if (parseNumbers(text, '/', index)) {
    if (index[0] < directory.cells.size()) return std::vector<uint32_t>{index[0]};
    return fail(ErrorKind::invalidArgument, "--cell: expected a number below {}, found {}", directory.cells.size(),
                index[0]);
  }
  if (!parseNumbers(text, '/', key))
    return fail(ErrorKind::invalidArgument, "--cell: expected a number, level/x/y/z or all, found '{}'", text);
  for (uint32_t i = 0; i < directory.cells.size(); ++i)
    if (directory.cells[i].key == CellKey{key[0], key[1], key[2], key[3]}) cells.push_back(i);
  if (cells.empty()) return fail(ErrorKind::invalidArgument, "--cell: the pack has no cell {}", text);
  return cells;
}

Result<std::vector<uint32_t>> parseViews(const std::string& text, uint32_t count) {
  std::vector<bool> wanted(count, text == "all");
  std::string_view rest = text == "all" ? std::string_view() : std::string_view(text);
  while (text != "all") {
    const std::string_view item = rest.substr(0, rest.find(','));
    std::array<uint32_t, 2> range{};
    const bool single = parseNumbers(item, '-', std::span(range).first(1));
    if (single) range[1] = range[0];
    if ((!single && !parseNumbers(item, '-', range)) || range[0] > range[1] || range[1] >= count)
      return fail(ErrorKind::invalidArgument, "--views: expected all or numbers below {} such as 0,7,12-20, found '{}'",
                  count, text);
    std::fill(wanted.begin() + range[0], wanted.begin() + range[1] + 1, true);
    if (item.size() == rest.size()) break;
    rest.remove_prefix(item.size() + 1);
  }
  std::vector<uint32_t> views;
  for (uint32_t view = 0; view < count; ++view)
    if (wanted[view]) views.push_back(view);
  return views;
}

Result<ViewChannel> parseChannel(const std::string& text) {
  if (text == "colour") return ViewChannel::colour;
  if (text == "coverage") return ViewChannel::coverage;
  if (text == "depth") return ViewChannel::depth;
  if (text == "normal") return ViewChannel::normal;
  return fail(ErrorKind::invalidArgument, "--channel: expected colour, coverage, depth or normal, found '{}'", text);
}

}  // namespace farcell
