#include "preprocess/read/obj/obj_map.h"

#include <algorithm>
#include <array>
#include <string>

#include "preprocess/mesh/number_text.h"
#include "preprocess/read/obj/obj_text.h"

namespace farcell {
namespace {

// How many words may follow an option; those of -s, -o and -t need not all be there.
struct Option {
  std::string_view name;
  int words;
  bool numbers;
};
constexpr std::array<Option, 13> kOptions = {{{"-blendu", 1, false},
                                              {"-blendv", 1, false},
                                              {"-bm", 1, true},
                                              {"-boost", 1, true},
                                              {"-cc", 1, false},
                                              {"-clamp", 1, false},
                                              {"-imfchan", 1, false},
                                              {"-mm", 2, true},
                                              {"-o", 3, true},
                                              {"-s", 3, true},
                                              {"-t", 3, true},
                                              {"-texres", 1, true},
                                              {"-type", 1, false}}};

glm::vec2 firstTwo(const std::array<double, 3>& numbers, int count, float otherwise) {
  return glm::vec2(count > 0 ? static_cast<float>(numbers[0]) : otherwise,
                   count > 1 ? static_cast<float>(numbers[1]) : otherwise);
}

void takeOption(const Option& option, std::string_view& rest, ObjMap& map) {
  std::array<double, 3> numbers{};
  std::string_view word;
  int count = 0;
  for (; count < option.words; ++count) {
    std::string_view after = rest;
    word = takeWord(after);
    if (option.numbers && !parseNumber(word, numbers[static_cast<size_t>(count)])) break;
    rest = after;
  }
  if (option.name == "-clamp") map.clamped = word == "on";
  if (option.name == "-s") map.scale = firstTwo(numbers, count, 1);
  if (option.name == "-o") map.offset = firstTwo(numbers, count, 0);
}

// The rest of the line: a name may hold what would begin a comment elsewhere.
std::filesystem::path nameIn(std::string_view rest) {
  std::string name(trimmed(rest));
  std::replace(name.begin(), name.end(), '\\', '/');
  const std::filesystem::path path = std::filesystem::path(name).lexically_normal();
  const bool isDrive = name.size() > 1 && name[1] == ':';
  return staysInside(path) && !isDrive ? path : path.filename();
}

}  // namespace

std::optional<ObjMap> parseObjMap(std::string_view rest) {
  ObjMap map;
  for (std::string_view after = rest;; after = rest) {
    const std::string_view word = takeWord(after);
    const auto option =
        std::find_if(kOptions.begin(), kOptions.end(), [&](const Option& known) { return known.name == word; });
    if (option == kOptions.end()) break;
    rest = after;
    takeOption(*option, rest, map);
  }
  map.name = nameIn(rest);
  if (!staysInside(map.name)) return std::nullopt;
  return map;
}

bool staysInside(const std::filesystem::path& name) {
  return !name.empty() && name.is_relative() && std::find(name.begin(), name.end(), "..") == name.end();
}

}  // namespace farcell
