// JSON from outside, in bounded time and memory: depth and number of values are counted before anything is built.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "cache/base/result.h"

namespace farcell {

// `offset`: of the text in the file, for messages.
// About the most bytes that it takes to open a file of such JSON: the text, trees of its values, and what tinygltf and
// the reader make of them. Refuses text that is too large or too deep.
Result<uint64_t> openingBytes(const std::string& path, uint64_t offset, const std::string& text);
// REQUIRES: text that openingBytes accepts.
Result<nlohmann::json> parseJsonText(const std::string& path, uint64_t offset, const std::string& text);

}  // namespace farcell
