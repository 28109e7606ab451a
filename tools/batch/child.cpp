#include "tools/batch/child.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <utility>

#include "cache/base/interrupt.h"

namespace farcell {
namespace {
constexpr size_t kMaxOutBytes = size_t{64} << 20;
constexpr size_t kMaxLineBytes = size_t{1} << 16;
constexpr int kLookForInterruptMs = 100;
constexpr int kCannotRun = 127;

struct Pipe {
  int read = -1;
  int write = -1;
  Pipe() {
    std::array<int, 2> ends{-1, -1};
    if (::pipe2(ends.data(), O_CLOEXEC) == 0) read = ends[0], write = ends[1];
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() {
    close(read);
    close(write);
  }
  static void close(int& end) {
    if (end >= 0) ::close(end);
    end = -1;
  }
};

// Between fork and exec: nothing but system calls.
[[noreturn]] void become(const char* program, char* const* arguments, const char* directory, const Pipe& out,
                         const Pipe& err) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  const int null = ::open("/dev/null", O_RDONLY);
  const bool ready = ::dup2(null, STDIN_FILENO) >= 0 && ::dup2(out.write, STDOUT_FILENO) >= 0 &&
                     ::dup2(err.write, STDERR_FILENO) >= 0 && ::chdir(directory) == 0;
  if (ready) ::execv(program, arguments);
  const char* reason = std::strerror(errno);
  (void)!::write(STDERR_FILENO, reason, std::strlen(reason));
  ::_exit(kCannotRun);
}

// Bytes into lines; a line without end is cut.
class Lines {
 public:
  explicit Lines(const std::function<void(std::string_view)>& sink) : sink_(sink) {}
  void add(std::string_view bytes) {
    for (const char c : bytes) {
      if (c == '\n')
        finish();
      else if (line_.size() < kMaxLineBytes)
        line_ += c;
    }
  }
  void finish() {
    if (!line_.empty()) sink_(line_);
    line_.clear();
  }

 private:
  const std::function<void(std::string_view)>& sink_;
  std::string line_;
};

// What there is to read; closed at its end.
void readSome(int& end, const std::function<void(std::string_view)>& sink) {
  std::array<char, 1 << 16> buffer;
  const ssize_t count = ::read(end, buffer.data(), buffer.size());
  if (count > 0) sink({buffer.data(), static_cast<size_t>(count)});
  if (count == 0 || (count < 0 && errno != EINTR)) Pipe::close(end);
}

// Until the child has closed both.
void listen(pid_t child, Pipe& out, Pipe& err, std::string& text,
            const std::function<void(std::string_view)>& onErrorLine) {
  bool passedOn = false;
  Lines lines(onErrorLine);
  while (out.read >= 0 || err.read >= 0) {
    if (interrupted() && !std::exchange(passedOn, true)) ::kill(child, SIGINT);
    std::array<pollfd, 2> ends = {pollfd{out.read, POLLIN, 0}, pollfd{err.read, POLLIN, 0}};  // one below 0 is skipped
    if (::poll(ends.data(), ends.size(), kLookForInterruptMs) <= 0) continue;
    if (ends[0].revents != 0)
      readSome(out.read, [&](std::string_view bytes) {
        text.append(bytes.substr(0, kMaxOutBytes - std::min(kMaxOutBytes, text.size())));
      });
    if (ends[1].revents != 0) readSome(err.read, [&](std::string_view bytes) { lines.add(bytes); });
  }
  lines.finish();
}

ChildOutcome waitFor(pid_t child) {
  ChildOutcome outcome;
  int status = 0;
  rusage usage{};
  while (::wait4(child, &status, 0, &usage) < 0 && errno == EINTR) continue;
  outcome.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  outcome.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + outcome.signal;
  outcome.peakRssBytes = static_cast<uint64_t>(usage.ru_maxrss) * 1024;
  return outcome;
}

}  // namespace

Result<ChildOutcome> runChild(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                              const std::filesystem::path& directory,
                              const std::function<void(std::string_view)>& onErrorLine) {
  const auto start = std::chrono::steady_clock::now();
  std::vector<std::string> words = {program.filename().string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  Pipe out, err;
  const pid_t child = out.read < 0 || err.read < 0 ? -1 : ::fork();
  if (child < 0) return fail(ErrorKind::io, "cannot run {}: {}", program.string(), std::strerror(errno));
  if (child == 0) become(program.c_str(), pointers.data(), directory.c_str(), out, err);
  Pipe::close(out.write);
  Pipe::close(err.write);
  std::string text;
  listen(child, out, err, text, onErrorLine);
  ChildOutcome outcome = waitFor(child);
  outcome.out = std::move(text);
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return outcome;
}

}  // namespace farcell
