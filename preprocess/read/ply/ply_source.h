// The body of a PLY file as a sequence of numbers: two sources of the same shape, one for each way of writing them.
// Their calls return false once the file is not what the header says; error() then tells what was wrong.
#pragma once

#include <bit>
#include <cstring>
#include <string_view>

#include "preprocess/mesh/byte_stream.h"
#include "preprocess/read/ply/ply_header.h"

namespace farcell {

// Where a body, or an element of it, starts.
struct PlyPlace {
  uint64_t offset = 0;
  uint64_t line = 1;  // text only
};

// One scalar at `bytes`; kSwap: its byte order is not the machine's.
template <class T, bool kSwap>
T loadScalar(const std::byte* bytes) {
  static_assert(std::endian::native == std::endian::little);
  T value;
  if constexpr (!kSwap) {
    std::memcpy(&value, bytes, sizeof(T));
  } else {
    std::byte turned[sizeof(T)];
    for (size_t i = 0; i < sizeof(T); ++i) turned[i] = bytes[sizeof(T) - 1 - i];
    std::memcpy(&value, turned, sizeof(T));
  }
  return value;
}

template <class T, bool kSwap>
T loadAs(PlyType type, const std::byte* bytes) {
  switch (type) {
    case PlyType::int8:
      return static_cast<T>(loadScalar<int8_t, kSwap>(bytes));
    case PlyType::uint8:
      return static_cast<T>(loadScalar<uint8_t, kSwap>(bytes));
    case PlyType::int16:
      return static_cast<T>(loadScalar<int16_t, kSwap>(bytes));
    case PlyType::uint16:
      return static_cast<T>(loadScalar<uint16_t, kSwap>(bytes));
    case PlyType::int32:
      return static_cast<T>(loadScalar<int32_t, kSwap>(bytes));
    case PlyType::uint32:
      return static_cast<T>(loadScalar<uint32_t, kSwap>(bytes));
    case PlyType::float32:
      return static_cast<T>(loadScalar<float, kSwap>(bytes));
    case PlyType::float64:
      return static_cast<T>(loadScalar<double, kSwap>(bytes));
  }
  return T{};
}

template <bool kSwapBytes>
class PlyBinarySource {
 public:
  static constexpr bool kText = false;
  static constexpr bool kSwap = kSwapBytes;

  PlyBinarySource(const InputFile& file, PlyPlace place) : stream_(file, place.offset) {}

  bool real(PlyType type, double& value) {
    if (!stream_.need(sizeBytes(type))) return false;
    value = loadAs<double, kSwap>(type, stream_.cursor());
    stream_.advance(sizeBytes(type));
    return true;
  }
  bool integer(PlyType type, int64_t& value) {  // REQUIRES: !isReal(type)
    if (!stream_.need(sizeBytes(type))) return false;
    value = loadAs<int64_t, kSwap>(type, stream_.cursor());
    stream_.advance(sizeBytes(type));
    return true;
  }
  bool skip(PlyType type, uint64_t count) { return stream_.skip(count * sizeBytes(type)); }
  // Whether `count` items can still be in the file.
  bool holds(PlyType type, uint64_t count) const { return count <= stream_.remaining() / sizeBytes(type); }

  // A list's count, when it cannot be one: always false, for error() to tell.
  bool rejectCount(int64_t count) {
    rejected_ = count;
    return false;
  }
  ByteStream& stream() { return stream_; }
  const InputFile& file() const { return stream_.file(); }
  PlyPlace place() const { return {stream_.offset(), 1}; }
  Error error(const std::string& expected) const;

 private:
  ByteStream stream_;
  std::optional<int64_t> rejected_;
};

class PlyTextSource {
 public:
  static constexpr bool kText = true;

  PlyTextSource(const InputFile& file, PlyPlace place) : stream_(file, place.offset), line_(place.line) {}

  bool real(PlyType type, double& value);  // rounded to a float where `type` is one
  bool integer(PlyType type, int64_t& value);
  bool skip(PlyType type, uint64_t count);
  bool holds(PlyType, uint64_t count) const { return count <= (stream_.remaining() + 1) / 2; }
  bool rejectCount(int64_t count) {
    rejected_ = count;
    return false;
  }

  const InputFile& file() const { return stream_.file(); }
  PlyPlace place() const { return {stream_.offset(), line_}; }
  Error error(const std::string& expected) const;

 private:
  bool nextWord();
  bool skipBlanks();

  ByteStream stream_;
  uint64_t line_;
  std::string_view word_;  // in the stream's buffer, until the next call
  bool misread_ = false;   // word_ is not a number
  std::optional<int64_t> rejected_;
};

}  // namespace farcell
