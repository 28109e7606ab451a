// File names from camera names, which come from a file anyone may have written.
#pragma once

#include <string>
#include <vector>

namespace farcell {

// For each name a different one of at most 70 characters out of letters, digits, '-' and '_', also where case does not
// count. What is left of a name's own characters stays readable; repetitions get a number.
std::vector<std::string> fileStems(const std::vector<std::string>& names);

}  // namespace farcell
