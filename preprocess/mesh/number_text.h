// Numbers as mesh files write them, whatever the locale: a leading '+' is allowed, "nan" and "inf" (and "1.#QNAN"
// of old Windows programs) are values that are not finite, what is too large is infinite, too small zero.
#pragma once

#include <cstdint>
#include <string_view>

namespace farcell {

// False when `text` is not, from its first to its last character, a number.
bool parseNumber(std::string_view text, double& value);
bool parseNumber(std::string_view text, float& value);  // rounded once, from the text
bool parseInteger(std::string_view text, int64_t& value);

}  // namespace farcell
