// A page opened by headless Chromium, as a person would open it from disk.
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace farcell::testing {

inline bool haveChromium() { return std::system("command -v chromium > /dev/null 2>&1") == 0; }

// How often `part` occurs in a document.
inline size_t countOf(const std::string& text, const std::string& part) {
  size_t count = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

// What Chromium makes of a page. `scratch`: an empty directory for its profile and files.
class Chromium {
 public:
  explicit Chromium(std::filesystem::path scratch) : scratch_(std::move(scratch)) {}

  // The document after its scripts have run, as text; empty when Chromium failed (log()).
  std::string domOf(const std::filesystem::path& page, const std::string& fragment = "") {
    return run("--dump-dom", page, fragment);
  }
  // Writes a PNG of the window.
  void screenshot(const std::filesystem::path& page, const std::filesystem::path& png,
                  const std::string& fragment = "") {
    run("--screenshot=" + png.string(), page, fragment);
  }
  std::string log() const { return textOf(scratch_ / "log"); }

 private:
  static std::string textOf(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }

  // Fragments are ASCII without quotes. A profile of its own each time, and no longer than half a minute.
  std::string run(const std::string& what, const std::filesystem::path& page, const std::string& fragment) {
    const std::string profile = (scratch_ / ("profile" + std::to_string(++runs_))).string();
    const std::string command =
        "timeout -k 5 30 chromium --headless --no-sandbox --disable-gpu --disable-quic --no-first-run "
        "--disable-background-networking --disable-component-update --disable-sync --disable-dev-shm-usage "
        "--hide-scrollbars --window-size=1200,1600 --virtual-time-budget=5000 '--user-data-dir=" +
        profile + "' '" + what + "' 'file://" + page.string() + fragment + "' > '" + (scratch_ / "out").string() +
        "' 2> '" + (scratch_ / "log").string() + "'";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? textOf(scratch_ / "out") : "";
  }

  std::filesystem::path scratch_;
  int runs_ = 0;
};

}  // namespace farcell::testing
