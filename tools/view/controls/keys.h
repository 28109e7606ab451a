// The keys of the viewer and what each is for: one table that the program obeys and the help prints.
#pragma once

#include <optional>
#include <string>

#include "runtime/gl/window/event.h"

namespace farcell {

enum class Command {
  fit,
  home,
  frontView,
  backView,
  leftView,
  rightView,
  topView,
  bottomView,
  changeNavigation,
  nextMode,
  nextKind,
  nextLight,
  sunLeft,
  sunRight,
  sunHigher,
  sunLower,
  capture,
  help,
  quit,
};

std::optional<Command> commandOf(Key key);

// For a terminal.
std::string keyHelp();

}  // namespace farcell
