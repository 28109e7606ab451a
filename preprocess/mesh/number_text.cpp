#include "preprocess/mesh/number_text.h"

#include <charconv>
#include <limits>

namespace farcell {
namespace {

std::string_view withoutPlus(std::string_view text) {
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+';
  return plus ? text.substr(1) : text;
}

// from_chars does not say in which direction a number left the range.
template <class T>
T outOfRange(std::string_view text) {
  const bool negative = text[0] == '-';
  const size_t exponent = text.find_first_of("eE");
  const bool tiny = exponent != std::string_view::npos ? text.substr(exponent + 1, 1) == "-"
                                                       : text.find_first_not_of("-0") == text.find('.');
  const T magnitude = tiny ? T{0} : std::numeric_limits<T>::infinity();
  return negative ? -magnitude : magnitude;
}

template <class T>
bool parseReal(std::string_view given, T& value) {
  const std::string_view text = withoutPlus(given);
  const char* end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data(), end, value);
  if (code == std::errc{} && stop == end) return true;
  if (code == std::errc::result_out_of_range && stop == end) {
    value = outOfRange<T>(text);
    return true;
  }
  const bool windowsNan = code == std::errc{} && text.substr(static_cast<size_t>(stop - text.data())).starts_with('#');
  if (windowsNan) value = std::numeric_limits<T>::quiet_NaN();
  return windowsNan;
}

}  // namespace

bool parseNumber(std::string_view text, double& value) { return parseReal(text, value); }
bool parseNumber(std::string_view text, float& value) { return parseReal(text, value); }

bool parseInteger(std::string_view given, int64_t& value) {
  const std::string_view text = withoutPlus(given);
  const char* end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data(), end, value);
  return code == std::errc{} && stop == end;
}

}  // namespace farcell
