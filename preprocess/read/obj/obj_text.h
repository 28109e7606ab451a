// Lines and words of OBJ and MTL files.
#pragma once

#include <string>
#include <string_view>

#include "preprocess/mesh/byte_stream.h"

namespace farcell {

// The lines of a file, those ended by '\' joined with the next one, without line ends.
class ObjLines {
 public:
  explicit ObjLines(const InputFile& file) : stream_(file, 0) {}

  // `line` is valid until the next call. False at the end and after a failure, which failure() gives.
  bool next(std::string_view& line);
  const std::optional<Error>& failure() const { return failure_; }
  // "file.obj: line 12: offset 345: expected ..., found ..." for the line last given.
  tl::unexpected<Error> bad(const std::string& expected, std::string_view found) const;

 private:
  bool nextPhysical(std::string_view& line);

  ByteStream stream_;
  std::optional<Error> failure_;
  std::string joined_;
  size_t unread_ = 0;        // bytes of the stream that the line last given still occupies
  uint64_t lineOffset_ = 0;  // of the line last given
  uint64_t lineNumber_ = 0;  // likewise, from 1
  uint64_t nextNumber_ = 1;
};

// Takes the first word off `rest`; empty at its end or at a comment.
std::string_view takeWord(std::string_view& rest);
// Without blanks at both ends: names may hold blanks inside.
std::string_view trimmed(std::string_view text);

}  // namespace farcell
