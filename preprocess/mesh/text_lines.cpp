#include "preprocess/mesh/text_lines.h"

#include <cstring>

namespace farcell {
namespace {
constexpr size_t kMaxLineBytes = size_t{64} << 20;  // a polygon of some ten million corners

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }
}  // namespace

bool TextLines::nextPhysical(std::string_view& line) {
  stream_.advance(unread_);
  unread_ = 0;
  size_t length = 0;
  const void* newline = nullptr;
  while (true) {
    const size_t available = stream_.available();
    newline = available > length ? std::memchr(stream_.cursor() + length, '\n', available - length) : nullptr;
    length = newline ? static_cast<size_t>(static_cast<const std::byte*>(newline) - stream_.cursor()) : available;
    if (newline || length > kMaxLineBytes || !stream_.need(length + 1)) break;
  }
  failure_ = stream_.failure();
  if (length > kMaxLineBytes)
    failure_ = Error{ErrorKind::unsupported,
                     fmt::format("{}: line {}: offset {}: expected at most {} bytes in a line, found more",
                                 stream_.file().path(), nextNumber_, stream_.offset(), kMaxLineBytes)};
  if (failure_ || (length == 0 && !newline)) return false;
  line = std::string_view(reinterpret_cast<const char*>(stream_.cursor()), length);
  if (line.ends_with('\r')) line.remove_suffix(1);
  unread_ = length + (newline ? 1 : 0);
  ++nextNumber_;
  return true;
}

bool TextLines::next(std::string_view& line) {
  lineNumber_ = nextNumber_;
  lineOffset_ = stream_.offset() + unread_;
  if (!nextPhysical(line)) return false;
  if (continuation_ == Continuation::none || !line.ends_with('\\')) return true;
  joined_.clear();
  bool more = true;
  while (more && line.ends_with('\\') && joined_.size() <= kMaxLineBytes) {
    joined_.append(line.substr(0, line.size() - 1)).push_back(' ');
    more = nextPhysical(line);
  }
  if (failure_) return false;
  if (more) joined_.append(line);
  line = joined_;
  return true;
}

tl::unexpected<Error> TextLines::bad(const std::string& expected, std::string_view found) const {
  constexpr size_t kMaxQuoted = 60;
  return corrupt(fmt::format("{}: line {}", stream_.file().path(), lineNumber_), lineOffset_, expected,
                 fmt::format("'{}'", found.substr(0, kMaxQuoted)));
}

tl::unexpected<Error> TextLines::ended(const std::string& expected) const {
  if (failure_) return tl::unexpected<Error>(*failure_);
  return corrupt(fmt::format("{}: line {}", file().path(), nextNumber_), file().sizeBytes(), expected,
                 "the end of the file");
}

std::string_view takeWord(std::string_view& rest) {
  size_t begin = 0;
  while (begin < rest.size() && isBlank(rest[begin])) ++begin;
  size_t end = begin;
  if (begin < rest.size() && rest[begin] == '#') begin = end = rest.size();
  while (end < rest.size() && !isBlank(rest[end])) ++end;
  const std::string_view word = rest.substr(begin, end - begin);
  rest.remove_prefix(end);
  return word;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  return text;
}

}  // namespace farcell
