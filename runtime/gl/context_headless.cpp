#include <epoxy/egl.h>

#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/gl/context.h"

namespace farcell {
namespace {

constexpr int kMaxDevices = 32;

bool lists(const char* extensions, std::string_view name) {
  if (extensions == nullptr) return false;
  std::string_view rest = extensions;
  while (!rest.empty()) {
    const size_t end = rest.find(' ');
    if (rest.substr(0, end) == name) return true;
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
  }
  return false;
}

// A display that may give a context, and how to name it in a message.
struct Candidate {
  EGLDisplay display;
  std::string name;
};

// Devices of GPU drivers; Mesa lists its software renderer as a device too, which has no DRM node.
std::vector<Candidate> deviceDisplays(const char* clientExtensions) {
  std::vector<Candidate> result;
  if (!lists(clientExtensions, "EGL_EXT_platform_device") ||
      !(lists(clientExtensions, "EGL_EXT_device_enumeration") || lists(clientExtensions, "EGL_EXT_device_base")))
    return result;
  std::array<EGLDeviceEXT, kMaxDevices> devices{};
  EGLint count = 0;
  if (!eglQueryDevicesEXT(kMaxDevices, devices.data(), &count)) return result;
  for (int i = 0; i < count; ++i) {
    const char* extensions = eglQueryDeviceStringEXT(devices[i], EGL_EXTENSIONS);
    if (lists(extensions, "EGL_MESA_device_software")) continue;
    result.push_back(
        {eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr), fmt::format("device {}", i)});
  }
  return result;
}

std::vector<Candidate> candidates() {
  const char* clientExtensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  std::vector<Candidate> result = deviceDisplays(clientExtensions);
  if (lists(clientExtensions, "EGL_MESA_platform_surfaceless"))
    result.push_back(
        {eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr), "Mesa surfaceless"});
  return result;
}

EGLContext createContext(EGLDisplay display) {
  constexpr std::array<EGLint, 5> kConfig = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                             EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!eglChooseConfig(display, kConfig.data(), &config, 1, &count) || count == 0) config = EGL_NO_CONFIG_KHR;
  const std::array<EGLint, 9> attributes = {EGL_CONTEXT_MAJOR_VERSION,
                                            4,
                                            EGL_CONTEXT_MINOR_VERSION,
                                            5,
                                            EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                            EGL_CONTEXT_OPENGL_DEBUG,
                                            kDebugContext ? EGL_TRUE : EGL_FALSE,
                                            EGL_NONE};
  return eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
}

struct EglPlatform : GlContext::Platform {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;

  // The display is the process's, shared by all contexts on it: it is not terminated.
  ~EglPlatform() override {
    if (context == EGL_NO_CONTEXT) return;
    if (eglGetCurrentContext() == context) eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display, context);
  }
};

}  // namespace

Result<GlContext> GlContext::createHeadless() {
  std::string tried;
  for (const Candidate& candidate : candidates()) {
    auto platform = std::make_unique<EglPlatform>();
    platform->display = candidate.display;
    const char* step = nullptr;
    if (candidate.display == EGL_NO_DISPLAY || !eglInitialize(candidate.display, nullptr, nullptr)) {
      step = "eglInitialize";
    } else if (!eglBindAPI(EGL_OPENGL_API) ||
               (platform->context = createContext(candidate.display)) == EGL_NO_CONTEXT) {
      step = "a 4.5 core context";
    } else if (!eglMakeCurrent(candidate.display, EGL_NO_SURFACE, EGL_NO_SURFACE, platform->context)) {
      step = "eglMakeCurrent";
    }
    if (step != nullptr) {
      tried += fmt::format("; {}: {} failed (EGL error {:#x})", candidate.name, step, eglGetError());
      continue;
    }
    return GlContext(std::move(platform));
  }
  if (tried.empty()) tried = "; EGL offers neither a GPU device nor Mesa's surfaceless platform";
  return fail(ErrorKind::unsupported, "no OpenGL 4.5 core context without a window{}", tried);
}

}  // namespace farcell
