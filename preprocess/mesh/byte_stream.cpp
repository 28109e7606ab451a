#include "preprocess/mesh/byte_stream.h"

#include <algorithm>
#include <cstring>

#include "cache/base/check.h"
#include "cache/base/interrupt.h"

namespace farcell {
namespace {
constexpr size_t kBufferBytes = size_t{1} << 18;  // stays in the second-level cache
}

ByteStream::ByteStream(const InputFile& file, uint64_t offset)
    : file_(file),
      fileOffset_(offset),
      buffer_(static_cast<size_t>(std::min<uint64_t>(kBufferBytes, file.sizeBytes()))) {
  FARCELL_CHECK(offset <= file.sizeBytes());
}

bool ByteStream::refill(size_t count) {
  if (failure_ || remaining() < count) return false;
  if (const Result<> going = checkInterrupt(); !going) {
    failure_ = going.error();
    return false;
  }
  const size_t kept = available();
  std::memmove(buffer_.data(), cursor(), kept);
  begin_ = 0;
  end_ = kept;
  if (buffer_.size() < count) buffer_.resize(std::max(count, std::min(2 * buffer_.size(), kept + remaining())));
  const size_t more = std::min<uint64_t>(buffer_.size() - kept, file_.sizeBytes() - fileOffset_);
  if (Result<> read = file_.readAt(fileOffset_, std::span(buffer_).subspan(kept, more)); !read) {
    failure_ = std::move(read).error();
    return false;
  }
  fileOffset_ += more;
  end_ += more;
  return true;
}

bool ByteStream::skip(uint64_t count) {
  if (count <= available()) {
    advance(static_cast<size_t>(count));
    return true;
  }
  if (count > remaining()) return false;
  fileOffset_ += count - available();
  begin_ = end_ = 0;
  return true;
}

}  // namespace farcell
