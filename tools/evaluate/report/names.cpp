#include "tools/evaluate/report/names.h"

#include <fmt/format.h>

#include <set>

namespace farcell {
namespace {

constexpr size_t kMaxLength = 60;  // without the number

bool isPlain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
}

std::string plain(const std::string& name) {
  std::string stem = name.substr(0, kMaxLength);
  for (char& c : stem)
    if (!isPlain(c)) c = '_';
  return stem.empty() ? "camera" : stem;
}

std::string lowered(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

}  // namespace

std::vector<std::string> fileStems(const std::vector<std::string>& names) {
  std::set<std::string> taken;
  std::vector<std::string> stems;
  for (const std::string& name : names) {
    const std::string stem = plain(name);
    std::string unique = stem;
    for (int number = 2; !taken.insert(lowered(unique)).second; ++number) unique = fmt::format("{}-{}", stem, number);
    stems.push_back(unique);
  }
  return stems;
}

}  // namespace farcell
