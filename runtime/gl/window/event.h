// What a person does to a window, as values: who takes them can be tested without one.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>

namespace farcell {

// By their place on a US keyboard, so that WASD lie together on any.
enum class Key {
  other,
  a,
  d,
  e,
  f,
  h,
  k,
  l,
  m,
  p,
  q,
  s,
  w,
  one,
  two,
  three,
  four,
  five,
  six,
  left,
  right,
  up,
  down,
  tab,
  home,
  escape,
  f1,
  f12
};
enum class MouseButton { left, right, middle };

enum class EventKind {
  keyDown,  // not again while it is held
  keyUp,
  buttonDown,
  buttonUp,
  moved,      // the pointer, to `atPx`
  scrolled,   // by `steps`; away from the person is positive
  exposed,    // the content is lost or its size is another: draw again
  unfocused,  // keys and buttons that are let go now are not told
  dropped,    // a file, `path`
};

struct Event {
  EventKind kind = EventKind::exposed;
  Key key = Key::other;
  MouseButton button = MouseButton::left;
  bool shift = false;  // was held
  glm::dvec2 atPx{0};  // the pointer, in framebuffer pixels from the top left corner
  double steps = 0;
  std::filesystem::path path = {};
};

}  // namespace farcell
