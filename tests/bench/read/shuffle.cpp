#include "tests/bench/read/shuffle.h"

#include <array>
#include <charconv>
#include <random>
#include <string>
#include <vector>

#include "cache/base/file.h"

namespace farcell {
namespace {

using Row = std::array<std::byte, 13>;

// The number after "element face ".
Result<uint64_t> faceCount(const InputFile& file) {
  std::string header(std::min<uint64_t>(file.sizeBytes(), 4096), '\0');
  FARCELL_TRY(file.readAt(0, std::as_writable_bytes(std::span(header))));
  constexpr std::string_view kBefore = "element face ";
  const size_t at = header.find(kBefore);
  uint64_t count = 0;
  if (at != std::string::npos)
    std::from_chars(header.data() + at + kBefore.size(), header.data() + header.size(), count);
  if (count == 0 || count > file.sizeBytes() / sizeof(Row))
    return corrupt(file.path(), 0, "faces of 13 bytes at the end", fmt::format("{} of them", count));
  return count;
}

}  // namespace

Result<> shufflePly(const std::filesystem::path& from, const std::filesystem::path& to) {
  FARCELL_ASSIGN(const InputFile file, InputFile::open(from));
  FARCELL_ASSIGN(const uint64_t count, faceCount(file));
  std::vector<Row> rows(count);
  const uint64_t facesOffset = file.sizeBytes() - count * sizeof(Row);
  FARCELL_TRY(file.readAt(facesOffset, std::as_writable_bytes(std::span(rows))));
  std::mt19937_64 random(1);
  for (size_t i = rows.size(); i > 1; --i) std::swap(rows[i - 1], rows[random() % i]);
  FARCELL_ASSIGN(OutputFile out, OutputFile::create(to));
  std::vector<std::byte> chunk(size_t{1} << 20);
  for (uint64_t offset = 0; offset < facesOffset; offset += chunk.size()) {
    const auto part = std::span(chunk).first(std::min<uint64_t>(chunk.size(), facesOffset - offset));
    FARCELL_TRY(file.readAt(offset, part));
    FARCELL_TRY(out.append(part));
  }
  for (size_t i = 0; i < rows.size(); ++i) FARCELL_TRY(out.append(rows[i]));
  return out.commit();
}

}  // namespace farcell
