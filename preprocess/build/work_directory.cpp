#include "preprocess/build/work_directory.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "cache/base/file.h"
#include "cache/base/hash.h"

namespace farcell {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLockName = "lock";
constexpr const char* kIdentityName = "identity";
constexpr uint64_t kMaxIdentityBytes = uint64_t{1} << 24;

tl::unexpected<Error> ioError(const fs::path& path, const char* what, const std::error_code& code) {
  return fail(ErrorKind::io, "{}: {}: {}", path.string(), what, code.message());
}

// All but the lock, which this process holds.
Result<> empty(const fs::path& directory) {
  std::error_code code;
  for (fs::directory_iterator entry(directory, code), end; !code && entry != end; entry.increment(code))
    if (entry->path().filename() != kLockName) fs::remove_all(entry->path(), code);
  if (code) return ioError(directory, "cannot empty the work directory", code);
  return {};
}

}  // namespace

fs::path WorkDirectory::placeOf(const fs::path& parent, const fs::path& pack) {
  const std::string name = pack.filename().string();
  const fs::path beside = pack.has_parent_path() ? pack.parent_path() : fs::path(".");
  if (parent.empty() || parent == beside) return beside / (name + ".work");
  std::error_code code;
  const std::string whole = fs::absolute(pack, code).lexically_normal().string();
  return parent / fmt::format("{}.{:016x}.work", name, hashBytes(std::as_bytes(std::span(whole))));
}

Result<WorkDirectory> WorkDirectory::open(const fs::path& parent, const fs::path& pack) {
  const fs::path path = placeOf(parent, pack);
  std::error_code code;
  fs::create_directory(path, code);
  if (code) return ioError(path, "cannot make the work directory", code);
  const fs::path lockPath = path / kLockName;
  const int lock = ::open(lockPath.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (lock < 0) return ioError(lockPath, "cannot open", {errno, std::generic_category()});
  WorkDirectory directory(path, lock);
  if (::flock(lock, LOCK_EX | LOCK_NB) != 0)
    return fail(ErrorKind::io, "{}: expected no other build at work there, found one (or: {})", path.string(),
                std::strerror(errno));
  return directory;
}

WorkDirectory::WorkDirectory(WorkDirectory&& other) noexcept
    : path_(std::move(other.path_)), lock_(std::exchange(other.lock_, -1)) {}

WorkDirectory::~WorkDirectory() {
  if (lock_ >= 0) ::close(lock_);
}

Result<bool> WorkDirectory::belongsTo(const std::string& identity) const {
  const fs::path file = path_ / kIdentityName;
  if (const Result<std::string> found = readTextFile(file, kMaxIdentityBytes); found && *found == identity) return true;
  FARCELL_TRY(empty(path_));
  FARCELL_TRY(writeTextFile(file, identity));
  return false;
}

bool WorkDirectory::holdsWork() const {
  std::error_code code;
  for (fs::directory_iterator entry(path_, code), end; !code && entry != end; entry.increment(code)) {
    const fs::path name = entry->path().filename();
    if (name != kLockName && name != kIdentityName && entry->file_size(code) > 0) return true;
  }
  return false;
}

Result<> WorkDirectory::remove() {
  std::error_code code;
  // The identity goes first: what a crash leaves of the rest belongs to nothing.
  fs::remove(path_ / kIdentityName, code);
  if (!code) fs::remove_all(path_, code);
  if (code) return ioError(path_, "cannot remove the work directory", code);
  return {};
}

Result<uint64_t> freeBytes(const fs::path& directory) {
  std::error_code code;
  const fs::space_info space = fs::space(directory, code);
  if (code) return ioError(directory, "cannot ask for its free space", code);
  return space.available;
}

uint64_t directoryBytes(const fs::path& directory) {
  uint64_t bytes = 0;
  std::error_code code, ignored;
  for (fs::recursive_directory_iterator entry(directory, code), end; !code && entry != end; entry.increment(code)) {
    const uint64_t size = entry->is_regular_file(ignored) ? entry->file_size(ignored) : 0;
    if (!ignored) bytes += size;
  }
  return bytes;
}

}  // namespace farcell
