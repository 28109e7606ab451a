#include "runtime/gl/window/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <array>
#include <cstdlib>
#include <utility>

namespace farcell {

namespace {
// What GLFW's callbacks leave for the program.
struct Inbox {
  std::vector<Event> events;
  glm::dvec2 pointer{0};  // in the units GLFW counts a window in
};
}  // namespace

struct Window::Platform : GlContext::Platform {
  GLFWwindow* window = nullptr;
  Inbox inbox;

  // GLFW is the process's, as the display is: ending it would unload the driver, which then leaks what it holds.
  ~Platform() override {
    if (window != nullptr) glfwDestroyWindow(window);
  }
};

namespace {

constexpr std::array<std::pair<int, Key>, 27> kKeys = {
    {{GLFW_KEY_A, Key::a},           {GLFW_KEY_D, Key::d},         {GLFW_KEY_E, Key::e},
     {GLFW_KEY_F, Key::f},           {GLFW_KEY_H, Key::h},         {GLFW_KEY_K, Key::k},
     {GLFW_KEY_L, Key::l},           {GLFW_KEY_M, Key::m},         {GLFW_KEY_P, Key::p},
     {GLFW_KEY_Q, Key::q},           {GLFW_KEY_S, Key::s},         {GLFW_KEY_W, Key::w},
     {GLFW_KEY_1, Key::one},         {GLFW_KEY_2, Key::two},       {GLFW_KEY_3, Key::three},
     {GLFW_KEY_4, Key::four},        {GLFW_KEY_5, Key::five},      {GLFW_KEY_6, Key::six},
     {GLFW_KEY_LEFT, Key::left},     {GLFW_KEY_RIGHT, Key::right}, {GLFW_KEY_UP, Key::up},
     {GLFW_KEY_DOWN, Key::down},     {GLFW_KEY_TAB, Key::tab},     {GLFW_KEY_HOME, Key::home},
     {GLFW_KEY_ESCAPE, Key::escape}, {GLFW_KEY_F1, Key::f1},       {GLFW_KEY_F12, Key::f12}}};

Key keyOf(int code) {
  for (const auto& [number, key] : kKeys)
    if (number == code) return key;
  return Key::other;
}

Inbox& inboxOf(GLFWwindow* window) { return *static_cast<Inbox*>(glfwGetWindowUserPointer(window)); }

bool shiftHeld(GLFWwindow* window) {
  return glfwGetKey(window, GLFW_KEY_LEFT_SHIFT) == GLFW_PRESS ||
         glfwGetKey(window, GLFW_KEY_RIGHT_SHIFT) == GLFW_PRESS;
}

// Framebuffer pixels of a window's unit: more than one where the desktop scales.
glm::dvec2 pixelsPerUnit(GLFWwindow* window) {
  glm::ivec2 units, pixels;
  glfwGetWindowSize(window, &units.x, &units.y);
  glfwGetFramebufferSize(window, &pixels.x, &pixels.y);
  return units.x > 0 && units.y > 0 ? glm::dvec2(pixels) / glm::dvec2(units) : glm::dvec2(1);
}

void push(GLFWwindow* window, Event event) {
  Inbox& inbox = inboxOf(window);
  event.shift = shiftHeld(window);
  event.atPx = inbox.pointer * pixelsPerUnit(window);
  inbox.events.push_back(std::move(event));
}

void onKey(GLFWwindow* window, int code, int, int action, int) {
  if (action != GLFW_REPEAT)
    push(window, {.kind = action == GLFW_PRESS ? EventKind::keyDown : EventKind::keyUp, .key = keyOf(code)});
}
void onButton(GLFWwindow* window, int code, int action, int) {
  if (code > GLFW_MOUSE_BUTTON_MIDDLE) return;
  const MouseButton button = code == GLFW_MOUSE_BUTTON_LEFT    ? MouseButton::left
                             : code == GLFW_MOUSE_BUTTON_RIGHT ? MouseButton::right
                                                               : MouseButton::middle;
  push(window, {.kind = action == GLFW_PRESS ? EventKind::buttonDown : EventKind::buttonUp, .button = button});
}
void onMove(GLFWwindow* window, double x, double y) {
  inboxOf(window).pointer = {x, y};
  push(window, {.kind = EventKind::moved});
}
void onScroll(GLFWwindow* window, double, double steps) { push(window, {.kind = EventKind::scrolled, .steps = steps}); }
void onExpose(GLFWwindow* window) { push(window, {.kind = EventKind::exposed}); }
void onSize(GLFWwindow* window, int, int) { push(window, {.kind = EventKind::exposed}); }
void onFocus(GLFWwindow* window, int focused) {
  if (!focused) push(window, {.kind = EventKind::unfocused});
}
void onDrop(GLFWwindow* window, int count, const char** paths) {
  if (count > 0) push(window, {.kind = EventKind::dropped, .path = paths[0]});
}

void listen(GLFWwindow* window, Inbox& inbox) {
  glfwGetCursorPos(window, &inbox.pointer.x, &inbox.pointer.y);
  glfwSetWindowUserPointer(window, &inbox);
  glfwSetKeyCallback(window, onKey);
  glfwSetMouseButtonCallback(window, onButton);
  glfwSetCursorPosCallback(window, onMove);
  glfwSetScrollCallback(window, onScroll);
  glfwSetWindowRefreshCallback(window, onExpose);
  glfwSetFramebufferSizeCallback(window, onSize);
  glfwSetWindowFocusCallback(window, onFocus);
  glfwSetDropCallback(window, onDrop);
}

GLFWwindow* createWindow(const WindowSettings& settings) {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, kDebugContext ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHint(GLFW_SAMPLES, 0);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
  return glfwCreateWindow(settings.width, settings.height, settings.title.c_str(), nullptr, nullptr);
}

// Why the last call failed, in GLFW's words.
std::string reason() {
  const char* description = nullptr;
  glfwGetError(&description);
  return description != nullptr ? description : "no reason given";
}

tl::unexpected<Error> noWindow(const std::string& why) {
  return fail(ErrorKind::unsupported, "no window: {}; `farcell render` draws without one", why);
}

bool displayNamed() { return std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr; }

}  // namespace

Result<Window> Window::open(const WindowSettings& settings) {
  if (!displayNamed()) return noWindow("DISPLAY is not set");
  if (!glfwInit()) return noWindow(reason());
  auto platform = std::make_unique<Platform>();
  platform->window = createWindow(settings);
  if (platform->window == nullptr) return noWindow("OpenGL 4.5 is needed: " + reason());
  listen(platform->window, platform->inbox);
  glfwMakeContextCurrent(platform->window);
  glfwSwapInterval(settings.waitForScreen ? 1 : 0);
  Platform* const borrowed = platform.get();
  return Window(std::move(platform), borrowed);
}

Window::Window(std::unique_ptr<Platform> platform, Platform* borrowed)
    : context_(std::move(platform)), platform_(borrowed) {}

glm::ivec2 Window::sizePx() const {
  glm::ivec2 size;
  glfwGetFramebufferSize(platform_->window, &size.x, &size.y);
  return size;
}

bool Window::closeAsked() const { return glfwWindowShouldClose(platform_->window) != 0; }

std::vector<Event> Window::poll() {
  glfwPollEvents();
  return std::exchange(platform_->inbox.events, {});
}

std::vector<Event> Window::wait(std::chrono::milliseconds longest) {
  glfwWaitEventsTimeout(std::chrono::duration<double>(longest).count());
  return std::exchange(platform_->inbox.events, {});
}

void Window::show() { glfwSwapBuffers(platform_->window); }

void Window::setTitle(const std::string& title) { glfwSetWindowTitle(platform_->window, title.c_str()); }

void Window::holdPointer(bool held) {
  glfwSetInputMode(platform_->window, GLFW_CURSOR, held ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
}

}  // namespace farcell
