#include "tests/support/display.h"

#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <utility>

namespace farcell {
namespace {

constexpr int kPatienceMs = 20'000;

// Becomes Xvfb, which writes the number of its display to the pipe; dies with the test.
[[noreturn]] void becomeServer(int pipe) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const std::string descriptor = std::to_string(pipe);
  ::execlp("Xvfb", "Xvfb", "-displayfd", descriptor.c_str(), "-screen", "0", "1024x768x24", "-nolisten", "tcp",
           "-noreset", nullptr);
  ::_exit(127);
}

// The line the server writes when it takes clients; empty when it does not.
std::string readLine(int pipe) {
  std::string line;
  pollfd wanted{pipe, POLLIN, 0};
  char c = 0;
  while (::poll(&wanted, 1, kPatienceMs) == 1 && ::read(pipe, &c, 1) == 1) {
    if (c == '\n') return line;
    line += c;
  }
  return {};
}

}  // namespace

std::unique_ptr<TestDisplay> TestDisplay::start() {
  std::array<int, 2> pipe{};
  if (::pipe(pipe.data()) != 0) return nullptr;
  const int process = ::fork();
  if (process == 0) becomeServer(pipe[1]);
  ::close(pipe[1]);
  const std::string number = process > 0 ? readLine(pipe[0]) : std::string();
  ::close(pipe[0]);
  if (process < 0) return nullptr;
  std::unique_ptr<TestDisplay> display(new TestDisplay(process, ":" + number));
  return number.empty() ? nullptr : std::move(display);
}

TestDisplay::~TestDisplay() {
  ::kill(process_, SIGTERM);
  ::waitpid(process_, nullptr, 0);
}

}  // namespace farcell
