// What every farcell-<verb> program shares: exit codes, help, messages, interrupts.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <cstdint>
#include <functional>
#include <string>

#include "cache/base/progress.h"
#include "cache/base/result.h"
#include "cache/schema/model.h"

namespace farcell {

// Parses the command line into `app` (already holding its options) and runs `work`.
// --help, --version and the hidden --print-reference man|bash|zsh|fish are added to it (tools/reference); what they
// print takes the place of the work. `app` is named as its program is, "farcell-build". Exit codes: 0 success, 1
// failed, 2 misused (also ErrorKind::invalidArgument). Errors go to stderr as "verb: message".
int runProgram(CLI::App& app, int argc, char** argv, const std::function<Result<>()>& work);

// --progress none|auto|bar|json, and --quiet, which is short for none.
void addProgressOption(CLI::App& app, ProgressForm& form);

// "5M", "500k", "2G", "1234" -> a count (decimal factors). invalidArgument otherwise.
Result<uint64_t> parseCount(const std::string& text);
// "512M", "2G", "1234" -> bytes (K, M, G, T are powers of 1024). invalidArgument otherwise.
Result<uint64_t> parseBytes(const std::string& text);
// "1280x720"; both in [1, 16384].
struct ImageSize {
  int width = 0;
  int height = 0;
};
Result<ImageSize> parseImageSize(const std::string& text);

// "179,204,230"; the option's name is for the message.
Result<std::array<uint8_t, 3>> parseColour(const std::string& option, const std::string& text);

// "120,30": azimuth of -360 to 360 and elevation of -90 to 90 degrees.
Result<Sun> parseSun(const std::string& option, const std::string& text);

}  // namespace farcell
