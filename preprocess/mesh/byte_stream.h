// A file read from some offset onward through one buffer: the only way bytes of a mesh file come in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "cache/base/file.h"

namespace farcell {

// Hot loops ask `need(n)` and then use cursor()[0, n). The buffer's memory may move at every need or skip.
class ByteStream {
 public:
  // `file` must outlive the stream. offset <= file.sizeBytes().
  ByteStream(const InputFile& file, uint64_t offset);

  const std::byte* cursor() const { return buffer_.data() + begin_; }
  size_t available() const { return end_ - begin_; }  // bytes at the cursor without another read
  // Whether at least `count` bytes are available, reading more where necessary. False at the end of the file,
  // and after a failed read or an interrupt (then failure() says which).
  bool need(size_t count) { return available() >= count || refill(count); }
  void advance(size_t count) { begin_ += count; }  // count <= available()
  // Moves on without reading. False, and nowhere, when the file has fewer bytes left.
  bool skip(uint64_t count);

  uint64_t offset() const { return fileOffset_ - available(); }  // of the cursor, in the file
  uint64_t remaining() const { return file_.sizeBytes() - offset(); }
  const InputFile& file() const { return file_; }
  const std::optional<Error>& failure() const { return failure_; }

 private:
  bool refill(size_t count);

  const InputFile& file_;
  uint64_t fileOffset_;  // of the first byte after the buffer
  std::vector<std::byte> buffer_;
  size_t begin_ = 0;
  size_t end_ = 0;
  std::optional<Error> failure_;
};

}  // namespace farcell
