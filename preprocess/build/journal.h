// Files to which records are only ever added, so that what was finished before a crash is found again.
//
// A journal is a directory of them: each process adds to its own file and reads everybody's. A record has a head,
// small, which is told to the sink when it is found, and a body, which is checked then and read when it is needed. Both
// have checksums. What a crash left at the end of a file - half a record, or after a loss of power bytes that never
// reached the disk - ends the file there; only the process that owns the file cuts it off.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "cache/base/file.h"

namespace farcell {

struct JournalPlace {
  uint32_t file = 0;
  uint32_t bodyBytes = 0;
  uint64_t bodyOffset = 0;
  uint64_t bodyChecksum = 0;
};

struct JournalRecord {
  uint32_t kind = 0;
  uint64_t id = 0;
};

class Journal {
 public:
  // `head` is valid during the call. One call at a time.
  using Sink = std::function<void(const JournalRecord&, std::span<const std::byte> head, const JournalPlace&)>;

  // Reads the files that are in `directory`; this process adds to that of `writer`, which no other process may use,
  // after it has cut off what a crash left there.
  static Result<Journal> open(const std::filesystem::path& directory, uint32_t writer, Sink sink);
  Journal(Journal&&) noexcept;
  ~Journal();

  // Any thread. Once this returns the end of this process loses nothing; a loss of power may lose what was added in the
  // last two seconds. The body has fewer than 2^32 bytes, the head at most 16 MiB.
  Result<> add(const JournalRecord& record, std::span<const std::byte> head, std::span<const std::byte> body);
  // What was added is on the disk, or with the server of a shared directory.
  Result<> sync();
  // Finds what other processes have added since.
  Result<> refresh();
  // Any thread. corrupt when the body is not what was added.
  Result<std::vector<std::byte>> read(const JournalPlace& place) const;

 private:
  struct Impl;
  explicit Journal(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace farcell
