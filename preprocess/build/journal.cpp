#include "preprocess/build/journal.h"

#include <chrono>
#include <mutex>
#include <optional>

#include "cache/base/check.h"
#include "cache/base/hash.h"
#include "cache/pack/bytes.h"

namespace farcell {
namespace {

using Clock = std::chrono::steady_clock;

// Frame: magic, kind, id, head bytes, body bytes, checksum of the body, checksum of all before it and of the head;
// then the head, then the body.
constexpr uint32_t kFrameMagic = 0x31524a46;  // "FJR1"
constexpr size_t kFrameBytes = 40;
constexpr uint32_t kMaxHeadBytes = 1u << 24;
constexpr uint32_t kMaxWriters = 4096;
constexpr std::chrono::seconds kSyncEvery{2};
constexpr size_t kScanBytes = size_t{1} << 20;

struct Frame {
  JournalRecord record;
  uint32_t headBytes = 0;
  uint32_t bodyBytes = 0;
  uint64_t bodyChecksum = 0;
};

uint64_t headChecksum(std::span<const std::byte> frame, std::span<const std::byte> head) {
  Hasher hasher;
  hasher.add(frame.first(kFrameBytes - 8));
  hasher.add(head);
  return hasher.value();
}

std::vector<std::byte> frameBytes(const Frame& frame, std::span<const std::byte> head) {
  ByteWriter out;
  out.u32(kFrameMagic);
  out.u32(frame.record.kind);
  out.u64(frame.record.id);
  out.u32(frame.headBytes);
  out.u32(frame.bodyBytes);
  out.u64(frame.bodyChecksum);
  out.u64(0);
  const uint64_t checksum = headChecksum(out.bytes, head);
  out.bytes.resize(kFrameBytes - 8);
  out.u64(checksum);
  out.append(head);
  return std::move(out.bytes);
}

}  // namespace

struct Journal::Impl {
  struct File {
    GrowingFile file;
    uint64_t scanned = 0;  // bytes known to be whole records
  };

  std::filesystem::path pathOf(size_t number) const { return directory / fmt::format("cells.{}.log", number); }

  // Opens the files there are, up to the first that is missing; the own one is made.
  Result<> openFiles() {
    while (files.size() < kMaxWriters && (files.size() <= writer || std::filesystem::exists(pathOf(files.size())))) {
      FARCELL_ASSIGN(GrowingFile file, GrowingFile::open(pathOf(files.size())));
      files.push_back(std::make_unique<File>(File{std::move(file), 0}));
    }
    return {};
  }

  // Tells of all whole records after what was scanned before.
  Result<> scan(uint32_t index) {
    File& file = *files[index];
    FARCELL_ASSIGN(const InputFile input, InputFile::open(file.file.path()));
    std::vector<std::byte> bytes;
    while (const auto frame = readFrame(input, file.scanned, bytes)) {
      const uint64_t body = file.scanned + kFrameBytes + frame->headBytes;
      if (!bodyIsWhole(input, body, *frame)) break;
      sink(frame->record, std::span(bytes).subspan(kFrameBytes), {index, frame->bodyBytes, body, frame->bodyChecksum});
      file.scanned = body + frame->bodyBytes;
    }
    return {};
  }

  // bytes: the frame and its head. Nothing at the end of what is whole.
  static std::optional<Frame> readFrame(const InputFile& input, uint64_t offset, std::vector<std::byte>& bytes) {
    bytes.resize(kFrameBytes);
    if (input.sizeBytes() - offset < kFrameBytes || !input.readAt(offset, bytes)) return {};
    ByteReader in(bytes);
    if (in.u32() != kFrameMagic) return {};
    Frame frame;
    frame.record.kind = in.u32();
    frame.record.id = in.u64();
    frame.headBytes = in.u32();
    frame.bodyBytes = in.u32();
    frame.bodyChecksum = in.u64();
    const uint64_t checksum = in.u64();
    if (frame.headBytes > kMaxHeadBytes ||
        input.sizeBytes() - offset - kFrameBytes < uint64_t{frame.headBytes} + frame.bodyBytes)
      return {};
    bytes.resize(kFrameBytes + frame.headBytes);
    if (!input.readAt(offset + kFrameBytes, std::span(bytes).subspan(kFrameBytes))) return {};
    if (headChecksum(bytes, std::span(bytes).subspan(kFrameBytes)) != checksum) return {};
    return frame;
  }

  static bool bodyIsWhole(const InputFile& input, uint64_t offset, const Frame& frame) {
    Hasher hasher;
    std::vector<std::byte> part;
    for (uint64_t done = 0; done < frame.bodyBytes; done += part.size()) {
      part.resize(std::min<uint64_t>(kScanBytes, frame.bodyBytes - done));
      if (!input.readAt(offset + done, part)) return false;
      hasher.add(part);
    }
    return hasher.value() == frame.bodyChecksum;
  }

  std::filesystem::path directory;
  uint32_t writer;
  Sink sink;
  std::mutex mutex;
  // Guarded by mutex while records are added:
  std::vector<std::unique_ptr<File>> files;
  Clock::time_point synced = Clock::now();
};

Journal::Journal(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Journal::Journal(Journal&&) noexcept = default;
Journal::~Journal() = default;

Result<Journal> Journal::open(const std::filesystem::path& directory, uint32_t writer, Sink sink) {
  FARCELL_CHECK(writer < kMaxWriters);
  auto impl = std::make_unique<Impl>();
  impl->directory = directory;
  impl->writer = writer;
  impl->sink = std::move(sink);
  Journal journal(std::move(impl));
  FARCELL_TRY(journal.refresh());
  Impl::File& own = *journal.impl_->files[writer];
  if (own.scanned < own.file.sizeBytes()) FARCELL_TRY(own.file.truncate(own.scanned));
  return journal;
}

Result<> Journal::add(const JournalRecord& record, std::span<const std::byte> head, std::span<const std::byte> body) {
  FARCELL_CHECK(head.size() <= kMaxHeadBytes && body.size() <= UINT32_MAX);
  const Frame frame{record, static_cast<uint32_t>(head.size()), static_cast<uint32_t>(body.size()), hashBytes(body)};
  std::vector<std::byte> bytes = frameBytes(frame, head);
  bytes.insert(bytes.end(), body.begin(), body.end());
  const std::lock_guard lock(impl_->mutex);
  Impl::File& own = *impl_->files[impl_->writer];
  const uint64_t bodyOffset = own.file.sizeBytes() + kFrameBytes + head.size();
  FARCELL_TRY(own.file.append(bytes));
  own.scanned = own.file.sizeBytes();
  impl_->sink(record, head, {impl_->writer, frame.bodyBytes, bodyOffset, frame.bodyChecksum});
  if (Clock::now() - impl_->synced < kSyncEvery) return {};
  impl_->synced = Clock::now();
  return own.file.sync();
}

Result<> Journal::sync() {
  const std::lock_guard lock(impl_->mutex);
  impl_->synced = Clock::now();
  return impl_->files[impl_->writer]->file.sync();
}

Result<> Journal::refresh() {
  const std::lock_guard lock(impl_->mutex);
  FARCELL_TRY(impl_->openFiles());
  for (uint32_t file = 0; file < impl_->files.size(); ++file) FARCELL_TRY(impl_->scan(file));
  return {};
}

Result<std::vector<std::byte>> Journal::read(const JournalPlace& place) const {
  std::vector<std::byte> body(place.bodyBytes);
  const GrowingFile& file = impl_->files[place.file]->file;
  FARCELL_TRY(file.readAt(place.bodyOffset, body));
  const uint64_t checksum = hashBytes(body);
  if (checksum != place.bodyChecksum)
    return corrupt(file.path(), place.bodyOffset, fmt::format("checksum {:016x}", place.bodyChecksum),
                   fmt::format("{:016x}", checksum));
  return body;
}

}  // namespace farcell
