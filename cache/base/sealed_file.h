// Small files that are whole or as good as absent: written at once, with a checksum.
#pragma once

#include <cstring>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "cache/base/file.h"

namespace farcell {

// Values one after another, as they lie in memory: for the machine that wrote them.
class SealedWriter {
 public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    append(std::as_bytes(std::span(&value, 1)));
  }
  void put(const std::string& text) {
    put(uint64_t{text.size()});
    append(std::as_bytes(std::span(text)));
  }
  // Through OutputFile: it appears when it is whole, and outlives a loss of power.
  Result<> commit(const std::filesystem::path& path);

 private:
  void append(std::span<const std::byte> bytes);
  std::vector<std::byte> bytes_;
};

class SealedReader {
 public:
  // Nothing when the file is missing or damaged.
  static std::optional<SealedReader> open(const std::filesystem::path& path);

  // False, and no more is read, when the file ends before.
  template <class T>
  bool get(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (bytes_.size() - at_ < sizeof(T)) return false;
    std::memcpy(static_cast<void*>(&value), bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    return true;
  }
  bool get(std::string& text);

 private:
  std::vector<std::byte> bytes_;
  size_t at_ = 0;
};

}  // namespace farcell
