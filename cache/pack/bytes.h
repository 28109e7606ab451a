// Little-endian bytes, written and read field by field: no struct is ever copied whole, so neither the machine's byte
// order nor a compiler's padding reaches a file.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace farcell {

class ByteWriter {
 public:
  std::vector<std::byte> bytes;

  void u8(uint8_t value) { bytes.push_back(std::byte{value}); }
  void u16(uint16_t value) { integer(value, 2); }
  void u32(uint32_t value) { integer(value, 4); }
  void i32(int32_t value) { integer(static_cast<uint32_t>(value), 4); }
  void u64(uint64_t value) { integer(value, 8); }
  void f32(float value) { u32(std::bit_cast<uint32_t>(value)); }
  void f64(double value) { u64(std::bit_cast<uint64_t>(value)); }
  // Length (u32), then the bytes.
  void string(std::string_view text) {
    u32(static_cast<uint32_t>(text.size()));
    append(std::as_bytes(std::span(text)));
  }
  void append(std::span<const std::byte> more) { bytes.insert(bytes.end(), more.begin(), more.end()); }
  // As many bytes more, to be filled before anything else is written.
  std::span<std::byte> space(size_t count) {
    bytes.resize(bytes.size() + count);
    return std::span(bytes).last(count);
  }

 private:
  void integer(uint64_t value, int count) {
    for (int i = 0; i < count; ++i) u8(static_cast<uint8_t>(value >> (8 * i)));
  }
};

// Reads past the end give zero and set ok() to false for good: check ok() before a value is used as a size.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  bool ok() const { return ok_; }
  size_t position() const { return position_; }
  size_t remaining() const { return bytes_.size() - position_; }
  std::span<const std::byte> rest() const { return bytes_.subspan(position_); }

  uint8_t u8() { return static_cast<uint8_t>(integer(1)); }
  uint16_t u16() { return static_cast<uint16_t>(integer(2)); }
  uint32_t u32() { return static_cast<uint32_t>(integer(4)); }
  int32_t i32() { return static_cast<int32_t>(u32()); }
  uint64_t u64() { return integer(8); }
  float f32() { return std::bit_cast<float>(u32()); }
  double f64() { return std::bit_cast<double>(u64()); }
  // A string of at most maxLength bytes.
  std::string string(size_t maxLength) {
    const uint32_t length = u32();
    if (length > maxLength) ok_ = false;
    const std::span<const std::byte> text = take(length);
    return std::string(reinterpret_cast<const char*>(text.data()), text.size());
  }
  // The next `count` bytes; empty when there are fewer.
  std::span<const std::byte> take(size_t count) {
    ok_ = ok_ && count <= remaining();
    if (!ok_) return {};
    position_ += count;
    return bytes_.subspan(position_ - count, count);
  }

 private:
  uint64_t integer(size_t count) {
    uint64_t value = 0;
    const std::span<const std::byte> taken = take(count);
    for (size_t i = 0; i < taken.size(); ++i) value |= std::to_integer<uint64_t>(taken[i]) << (8 * i);
    return value;
  }

  std::span<const std::byte> bytes_;
  size_t position_ = 0;
  bool ok_ = true;
};

}  // namespace farcell
