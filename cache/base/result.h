// Failures from outside - a file, a pack, an argument, the machine - are values, not exceptions.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace farcell {

enum class ErrorKind {
  notFound,         // a named thing does not exist
  corrupt,          // a file contradicts itself or its format
  unsupported,      // valid, but more than this version can do
  invalidArgument,  // the caller or user asked for something meaningless: exit code 2
  io,               // the machine refused: permissions, disk full, read error
  exhausted,        // a stated budget (memory, disk, depth) is not enough
  cancelled,        // the user interrupted
};

// Messages are for people: "city.ply: offset 1234: expected 'end_header', found end of file".
struct Error {
  ErrorKind kind;
  std::string message;
};

template <class T = void>
using Result = tl::expected<T, Error>;

template <class... Args>
[[nodiscard]] tl::unexpected<Error> fail(ErrorKind kind, fmt::format_string<Args...> format, Args&&... args) {
  return tl::unexpected<Error>(Error{kind, fmt::format(format, std::forward<Args>(args)...)});
}

// The usual shape of "this file is not what it claims to be".
[[nodiscard]] inline tl::unexpected<Error> corrupt(const std::string& path, uint64_t offset,
                                                   const std::string& expected, const std::string& found) {
  return fail(ErrorKind::corrupt, "{}: offset {}: expected {}, found {}", path, offset, expected, found);
}

}  // namespace farcell

#define FARCELL_CONCAT_(a, b) a##b
#define FARCELL_CONCAT(a, b) FARCELL_CONCAT_(a, b)

// FARCELL_TRY(expression): returns the error of a Result<...> from the enclosing function.
#define FARCELL_TRY(...) FARCELL_TRY_(FARCELL_CONCAT(farcellTried, __COUNTER__), __VA_ARGS__)
#define FARCELL_TRY_(tried, ...)                                                                               \
  do {                                                                                                         \
    if (auto tried = (__VA_ARGS__); !tried) return tl::unexpected<::farcell::Error>(std::move(tried).error()); \
  } while (false)

// FARCELL_ASSIGN(auto x, expression): the same, and names the value.
#define FARCELL_ASSIGN(declaration, ...) \
  FARCELL_ASSIGN_(FARCELL_CONCAT(farcellAssigned, __COUNTER__), declaration, __VA_ARGS__)
#define FARCELL_ASSIGN_(assigned, declaration, ...)                                    \
  auto assigned = (__VA_ARGS__);                                                       \
  if (!assigned) return tl::unexpected<::farcell::Error>(std::move(assigned).error()); \
  declaration = std::move(*assigned)
