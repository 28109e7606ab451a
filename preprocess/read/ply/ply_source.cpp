#include "preprocess/read/ply/ply_source.h"

#include "preprocess/mesh/number_text.h"

namespace farcell {
namespace {

constexpr size_t kMaxWordBytes = 4096;

bool isBlank(std::byte b) {
  const auto c = static_cast<unsigned char>(b);
  return c == ' ' || (c >= '\t' && c <= '\r');
}

Error endOfFile(const std::string& path, const ByteStream& stream, const std::string& expected,
                std::optional<int64_t> rejectedCount) {
  if (stream.failure()) return *stream.failure();
  const std::string rest = fmt::format("{} bytes up to the end of the file", stream.remaining());
  const std::string found = rejectedCount ? fmt::format("a list of {} items, with {}", *rejectedCount, rest) : rest;
  return corrupt(path, stream.offset(), expected, found).value();
}

}  // namespace

template <bool kSwapBytes>
Error PlyBinarySource<kSwapBytes>::error(const std::string& expected) const {
  return endOfFile(stream_.file().path(), stream_, expected, rejected_);
}
template class PlyBinarySource<false>;
template class PlyBinarySource<true>;

bool PlyTextSource::skipBlanks() {
  while (true) {
    const std::byte* at = stream_.cursor();
    const std::byte* end = at + stream_.available();
    for (; at != end && isBlank(*at); ++at) line_ += *at == std::byte{'\n'};
    stream_.advance(static_cast<size_t>(at - stream_.cursor()));
    if (at != end) return true;
    if (!stream_.need(1)) return false;
  }
}

bool PlyTextSource::nextWord() {
  word_ = {};
  if (!skipBlanks()) return false;
  size_t length = 1;
  while (true) {
    const std::byte* at = stream_.cursor();
    while (length < stream_.available() && !isBlank(at[length])) ++length;
    const bool whole = length < stream_.available() || !stream_.need(length + 1);
    if (whole || length > kMaxWordBytes) break;
  }
  word_ = std::string_view(reinterpret_cast<const char*>(stream_.cursor()), length);
  misread_ = length > kMaxWordBytes;
  return !misread_ && !stream_.failure();
}

bool PlyTextSource::real(PlyType type, double& value) {
  if (!nextWord()) return false;
  float rounded = 0;
  misread_ = type == PlyType::float32 ? !parseNumber(word_, rounded) : !parseNumber(word_, value);
  if (misread_) return false;
  if (type == PlyType::float32) value = rounded;
  stream_.advance(word_.size());
  return true;
}

bool PlyTextSource::integer(PlyType, int64_t& value) {
  if (!nextWord()) return false;
  misread_ = !parseInteger(word_, value);
  if (!misread_) stream_.advance(word_.size());
  return !misread_;
}

bool PlyTextSource::skip(PlyType, uint64_t count) {
  for (; count > 0; --count) {
    if (!nextWord()) return false;
    stream_.advance(word_.size());
  }
  return true;
}

Error PlyTextSource::error(const std::string& expected) const {
  constexpr size_t kMaxQuoted = 40;
  const std::string path = fmt::format("{}: line {}", stream_.file().path(), line_);
  if (!misread_) return endOfFile(path, stream_, expected, rejected_);
  return corrupt(path, stream_.offset(), expected, fmt::format("'{}'", word_.substr(0, kMaxQuoted))).value();
}

}  // namespace farcell
