#include "tools/view/controls/keys.h"

#include <fmt/format.h>

#include <array>

namespace farcell {
namespace {

struct Binding {
  Key key;
  Command command;
  const char* name;
  const char* purpose;  // null: the same as of the line before
};

constexpr std::array<Binding, 21> kBindings = {{
    {Key::tab, Command::changeNavigation, "Tab", "orbit or fly"},
    {Key::f, Command::fit, "F", "fit the model into the window"},
    {Key::home, Command::home, "Home", "back to the overview"},
    {Key::one, Command::frontView, "1", "look from the front; 2 back, 3 left, 4 right, 5 top, 6 bottom"},
    {Key::two, Command::backView, "2", nullptr},
    {Key::three, Command::leftView, "3", nullptr},
    {Key::four, Command::rightView, "4", nullptr},
    {Key::five, Command::topView, "5", nullptr},
    {Key::six, Command::bottomView, "6", nullptr},
    {Key::m, Command::nextMode, "M", "what is drawn: auto, impostors, full"},
    {Key::k, Command::nextKind, "K", "kind of the impostors: A, B, flat"},
    {Key::l, Command::nextLight, "L", "light: sun, headlight (of relightable packs)"},
    {Key::left, Command::sunLeft, "Arrows", "left, right, up, down: move the sun (of relightable packs)"},
    {Key::right, Command::sunRight, "Right", nullptr},
    {Key::up, Command::sunHigher, "Up", nullptr},
    {Key::down, Command::sunLower, "Down", nullptr},
    {Key::p, Command::capture, "P, F12", "save the picture (PNG) and the camera (JSON) here"},
    {Key::f12, Command::capture, "F12", nullptr},
    {Key::h, Command::help, "H, F1", "this help"},
    {Key::f1, Command::help, "F1", nullptr},
    {Key::escape, Command::quit, "Esc", "quit"},
}};

constexpr const char* kMouse =
    "orbit:  left drag turns around the pivot; wheel goes to what is under the pointer;\n"
    "        middle, right or Shift drag pans; WASD and QE move\n"
    "fly:    left or right drag looks around; W A S D forward, left, back, right; Q E down, up;\n"
    "        Shift faster; wheel changes the speed\n"
    "A pack dropped on the window is opened.\n";

}  // namespace

std::optional<Command> commandOf(Key key) {
  for (const Binding& binding : kBindings)
    if (binding.key == key) return binding.command;
  return std::nullopt;
}

std::string keyHelp() {
  std::string text = kMouse;
  for (const Binding& binding : kBindings)
    if (binding.purpose != nullptr) text += fmt::format("{:<8}{}\n", binding.name, binding.purpose);
  return text;
}

}  // namespace farcell
