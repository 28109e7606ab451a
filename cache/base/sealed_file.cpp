#include "cache/base/sealed_file.h"

#include "cache/base/hash.h"

namespace farcell {

void SealedWriter::append(std::span<const std::byte> bytes) {
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
}

Result<> SealedWriter::commit(const std::filesystem::path& path) {
  FARCELL_ASSIGN(OutputFile file, OutputFile::create(path));
  const uint64_t hash = hashBytes(bytes_);
  FARCELL_TRY(file.append(bytes_));
  FARCELL_TRY(file.append(std::as_bytes(std::span(&hash, 1))));
  return file.commit();
}

std::optional<SealedReader> SealedReader::open(const std::filesystem::path& path) {
  const Result<InputFile> file = InputFile::open(path);
  uint64_t hash = 0;
  if (!file || file->sizeBytes() < sizeof(hash)) return std::nullopt;
  SealedReader reader;
  reader.bytes_.resize(file->sizeBytes() - sizeof(hash));
  if (!file->readAt(0, reader.bytes_)) return std::nullopt;
  if (!file->readAt(reader.bytes_.size(), std::as_writable_bytes(std::span(&hash, 1)))) return std::nullopt;
  if (hash != hashBytes(reader.bytes_)) return std::nullopt;
  return reader;
}

bool SealedReader::get(std::string& text) {
  uint64_t size = 0;
  if (!get(size) || size > bytes_.size() - at_) return false;
  text.assign(reinterpret_cast<const char*>(bytes_.data() + at_), size);
  at_ += size;
  return true;
}

}  // namespace farcell
