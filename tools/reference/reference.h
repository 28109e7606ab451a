// What a program says about itself, each text made from its description alone.
#pragma once

#include <string>
#include <vector>

#include "tools/reference/description.h"

namespace farcell {

// The widest line of a help text, in characters.
inline constexpr size_t kHelpColumns = 100;

std::string helpText(const CommandDescription& command);

// roff with the man macros, section 1. `date` is YYYY-MM-DD.
std::string manualPage(const CommandDescription& program, const std::string& version, const std::string& date);

// Completion scripts: files named `farcell-build` (bash), `_farcell-build` (zsh) and `farcell-build.fish`. Those of a
// program with commands that are programs (`farcell`) hand over to theirs, which lie beside them.
std::string bashCompletion(const CommandDescription& program);
std::string zshCompletion(const CommandDescription& program);
std::string fishCompletion(const CommandDescription& program);

}  // namespace farcell
