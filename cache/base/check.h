// A broken promise of our own code prints what broke and stops the program.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>

namespace farcell {
[[noreturn]] inline void checkFailed(const char* file, int line, const char* what, const std::string& values) {
  std::fprintf(stderr, "%s:%d: broken promise: %s%s\n", file, line, what, values.c_str());
  std::abort();
}
}  // namespace farcell

// __FILE_NAME__: a program does not tell where it was built.
#define FARCELL_CHECK(condition)                                                       \
  do {                                                                                 \
    if (!(condition)) ::farcell::checkFailed(__FILE_NAME__, __LINE__, #condition, ""); \
  } while (false)

#define FARCELL_CHECK_EQ(a, b)                                                                              \
  do {                                                                                                      \
    if (!((a) == (b)))                                                                                      \
      ::farcell::checkFailed(__FILE_NAME__, __LINE__, #a " == " #b, fmt::format(" ({} against {})", a, b)); \
  } while (false)
