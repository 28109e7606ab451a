// The window of a program, with an OpenGL 4.5 core context. The one place that knows GLFW.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "cache/base/result.h"
#include "runtime/gl/context.h"
#include "runtime/gl/window/event.h"

namespace farcell {

struct WindowSettings {
  std::string title;
  int width = 1280;  // pixels, or what the desktop calls a pixel where it scales
  int height = 720;
  bool waitForScreen = true;  // frames appear at the screen's pace; false: as fast as they are drawn
};

// At most one at a time, on the main thread. The default framebuffer has one sample a pixel, no depth that is of use,
// and takes display values as they are (not sRGB-encoded by OpenGL).
class Window {
 public:
  // unsupported when there is no display or no OpenGL 4.5 on it, saying which.
  static Result<Window> open(const WindowSettings& settings);
  Window(Window&&) noexcept = default;

  GlContext& context() { return context_; }
  // Of the framebuffer: 0 x 0 while the window is minimised.
  glm::ivec2 sizePx() const;
  bool closeAsked() const;

  // What happened since the last call, in order; at once, or after something happened or `longest` passed.
  std::vector<Event> poll();
  std::vector<Event> wait(std::chrono::milliseconds longest);

  // Shows what was drawn into the default framebuffer.
  void show();
  void setTitle(const std::string& title);
  // Held, the pointer is not seen and moves without end.
  void holdPointer(bool held);

 private:
  struct Platform;
  Window(std::unique_ptr<Platform> platform, Platform* borrowed);
  GlContext context_;
  Platform* platform_;  // the context owns it
};

}  // namespace farcell
