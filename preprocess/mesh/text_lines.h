// Lines and words of mesh files that are text.
#pragma once

#include <string>
#include <string_view>

#include "preprocess/mesh/byte_stream.h"

namespace farcell {

// The beginning of a line.
struct TextPlace {
  uint64_t offset = 0;
  uint64_t lineNumber = 1;
};

// The lines of a file, without line ends.
class TextLines {
 public:
  enum class Continuation { none, backslash };  // backslash: a line ended by '\' goes on in the next one

  // `file` must outlive the lines.
  TextLines(const InputFile& file, Continuation continuation, TextPlace start = {})
      : stream_(file, start.offset), continuation_(continuation), nextNumber_(start.lineNumber) {}

  // `line` is valid until the next call. False at the end and after a failure, which failure() gives.
  bool next(std::string_view& line);
  const std::optional<Error>& failure() const { return failure_; }
  const InputFile& file() const { return stream_.file(); }
  TextPlace nextPlace() const {
    return {stream_.offset() + unread_, nextNumber_};
  }  // of the line after the one last given
  // "file.obj: line 12: offset 345: expected ..., found ..." for the line last given.
  tl::unexpected<Error> bad(const std::string& expected, std::string_view found) const;
  // The same at the end of the file, or the failure that ended it.
  tl::unexpected<Error> ended(const std::string& expected) const;

 private:
  bool nextPhysical(std::string_view& line);

  ByteStream stream_;
  Continuation continuation_;
  std::optional<Error> failure_;
  std::string joined_;
  size_t unread_ = 0;        // bytes of the stream that the line last given still occupies
  uint64_t lineOffset_ = 0;  // of the line last given
  uint64_t lineNumber_ = 0;  // likewise, from 1
  uint64_t nextNumber_;
};

// Takes the first word off `rest`; empty at its end or at a comment ('#').
std::string_view takeWord(std::string_view& rest);
// Without blanks at both ends: names may hold blanks inside.
std::string_view trimmed(std::string_view text);

}  // namespace farcell
