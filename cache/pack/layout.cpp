#include "cache/pack/layout.h"

#include <cstring>

#include "cache/base/hash.h"
#include "cache/pack/bytes.h"
#include "cache/pack/pack_file.h"

namespace farcell {
namespace {

constexpr size_t kChecksumBytes = 8;
constexpr size_t kMagicBytes = 8;

bool magicIs(std::span<const std::byte> found, const std::array<char, 8>& magic) {
  return found.size() == magic.size() && std::memcmp(found.data(), magic.data(), magic.size()) == 0;
}

Result<> checkVersion(uint32_t version, uint64_t offset, const std::string& path) {
  if (version == kPackVersion) return {};
  return fail(ErrorKind::unsupported, "{}: offset {}: expected a pack of version {}, found version {}", path, offset,
              kPackVersion, version);
}

Result<> checkSum(std::span<const std::byte> bytes, uint64_t expected, uint64_t offset, const std::string& path) {
  const uint64_t found = hashBytes(bytes);
  if (found == expected) return {};
  return corrupt(path, offset, fmt::format("checksum {:016x}", expected), fmt::format("{:016x}", found));
}

}  // namespace

std::vector<std::byte> encodeHeader() {
  ByteWriter out;
  out.append(std::as_bytes(std::span(kHeaderMagic)));
  out.u32(kPackVersion);
  out.bytes.resize(kHeaderBytes - kChecksumBytes);
  out.u64(hashBytes(out.bytes));
  return std::move(out.bytes);
}

Result<> checkHeader(std::span<const std::byte> bytes, const std::string& path) {
  ByteReader in(bytes);
  if (!magicIs(in.take(kMagicBytes), kHeaderMagic)) return corrupt(path, 0, "the magic of a pack", "other bytes");
  const uint64_t versionOffset = in.position();
  FARCELL_TRY(checkVersion(in.u32(), versionOffset, path));
  const uint64_t reservedOffset = in.position();
  for (const std::byte reserved : in.take(in.remaining() - kChecksumBytes))
    if (reserved != std::byte{0}) return corrupt(path, reservedOffset, "reserved bytes of 0", "others");
  const std::span<const std::byte> summed = bytes.first(in.position());
  return checkSum(summed, in.u64(), 0, path);
}

std::vector<std::byte> encodeFooter(const Footer& footer) {
  ByteWriter out;
  for (const uint64_t value : {footer.directoryOffset, footer.directoryBytes, footer.directoryChecksum,
                               footer.settingsHash, footer.sourceHash, footer.fileBytes})
    out.u64(value);
  out.u32(kPackVersion);
  out.bytes.resize(kFooterBytes - kChecksumBytes - kMagicBytes);
  out.u64(hashBytes(out.bytes));
  out.append(std::as_bytes(std::span(kFooterMagic)));
  return std::move(out.bytes);
}

Result<Footer> decodeFooter(std::span<const std::byte> bytes, uint64_t fileBytes, const std::string& path) {
  const uint64_t start = fileBytes - kFooterBytes;
  const std::span<const std::byte> summed = bytes.first(kFooterBytes - kChecksumBytes - kMagicBytes);
  if (!magicIs(bytes.last(kMagicBytes), kFooterMagic))
    return corrupt(path, fileBytes - kMagicBytes, "the magic that ends a pack", "other bytes (a file cut short?)");
  ByteReader in(bytes);
  const Footer footer{in.u64(), in.u64(), in.u64(), in.u64(), in.u64(), in.u64()};
  const uint64_t versionOffset = start + in.position();
  FARCELL_TRY(checkVersion(in.u32(), versionOffset, path));
  if (in.u32() != 0 || in.u64() != 0) return corrupt(path, versionOffset + 4, "reserved bytes of 0", "others");
  FARCELL_TRY(checkSum(summed, in.u64(), start, path));
  if (footer.fileBytes != fileBytes)
    return corrupt(path, start + 40, fmt::format("a file of {} bytes", footer.fileBytes), fmt::format("{}", fileBytes));
  if (footer.directoryOffset < kHeaderBytes || footer.directoryOffset > start)
    return corrupt(path, start, fmt::format("a directory from {} to {}", kHeaderBytes, start),
                   fmt::format("{}", footer.directoryOffset));
  if (footer.directoryBytes != start - footer.directoryOffset)
    return corrupt(path, start + 8, fmt::format("a directory of {} bytes", start - footer.directoryOffset),
                   fmt::format("{}", footer.directoryBytes));
  return footer;
}

}  // namespace farcell
