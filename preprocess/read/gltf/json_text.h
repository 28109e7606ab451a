// JSON from outside, in bounded time and memory: depth and number of values are counted before anything is built.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "cache/base/result.h"

namespace farcell {

// `offset`: of the text in the file, for messages.
Result<nlohmann::json> parseJsonText(const std::string& path, uint64_t offset, const std::string& text);

}  // namespace farcell
