#include "cache/base/file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace farcell {
namespace {

constexpr size_t kWriteBufferBytes = size_t{1} << 20;

tl::unexpected<Error> ioError(const std::string& path, const char* what, int code) {
  const ErrorKind kind = code == ENOENT ? ErrorKind::notFound : ErrorKind::io;
  return fail(kind, "{}: {}: {}", path, what, std::strerror(code));
}

Result<> readAll(int descriptor, const std::string& path, uint64_t offset, std::span<std::byte> out) {
  size_t done = 0;
  while (done < out.size()) {
    const ssize_t got = ::pread(descriptor, out.data() + done, out.size() - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return ioError(path, fmt::format("cannot read at offset {}", offset + done).c_str(), errno);
    if (got == 0) return corrupt(path, offset + done, fmt::format("{} more bytes", out.size() - done), "end of file");
    done += static_cast<size_t>(got);
  }
  return {};
}

Result<> writeAll(int descriptor, const std::string& path, uint64_t offset, std::span<const std::byte> bytes) {
  size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t put =
        ::pwrite(descriptor, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) return ioError(path, fmt::format("cannot write at offset {}", offset + done).c_str(), errno);
    done += static_cast<size_t>(put);
  }
  return {};
}

// The size of an opened file; an error when it is something else, which could block for ever or have no size.
Result<uint64_t> regularFileBytes(int descriptor, const std::string& path) {
  struct stat info {};
  if (::fstat(descriptor, &info) != 0) return ioError(path, "cannot stat", errno);
  if (!S_ISREG(info.st_mode)) return fail(ErrorKind::io, "{}: expected a regular file, found something else", path);
  return static_cast<uint64_t>(info.st_size);
}

std::filesystem::path directoryOf(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

// So that the name of `path` is on the disk.
Result<> syncDirectoryOf(const std::filesystem::path& path) {
  const std::filesystem::path directory = directoryOf(path);
  const int descriptor = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return ioError(path, "cannot open its directory", errno);
  const int status = ::fsync(descriptor);
  const int code = errno;
  ::close(descriptor);
  if (status != 0) return ioError(path, "cannot sync its directory", code);
  return {};
}

// Opens or creates a file that no other process writes, locked as long as it is open. What a killed process left of it
// may be there.
Result<int> openPartial(const std::filesystem::path& name) {
  for (;;) {
    const int descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
    if (descriptor < 0) return ioError(name, "cannot create", errno);
    struct stat opened {
    }, named{};
    const bool locked = ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
    if (locked && ::fstat(descriptor, &opened) == 0 && S_ISREG(opened.st_mode) && ::stat(name.c_str(), &named) == 0 &&
        opened.st_ino == named.st_ino)
      return descriptor;
    ::close(descriptor);
    if (!locked) return fail(ErrorKind::io, "{}: expected a file that no other process writes", name.string());
    if (opened.st_mode != 0 && !S_ISREG(opened.st_mode))
      return fail(ErrorKind::io, "{}: expected a regular file or nothing there, found something else", name.string());
    // Another process has just renamed or removed it: once more.
  }
}

}  // namespace

InputFile::InputFile(int descriptor, std::string path, uint64_t sizeBytes)
    : descriptor_(descriptor), path_(std::move(path)), sizeBytes_(sizeBytes) {}

InputFile::InputFile(InputFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), path_(std::move(other.path_)), sizeBytes_(other.sizeBytes_) {}

InputFile& InputFile::operator=(InputFile&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  std::swap(path_, other.path_);
  std::swap(sizeBytes_, other.sizeBytes_);
  return *this;
}

InputFile::~InputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Result<InputFile> InputFile::open(const std::filesystem::path& path) {
  // O_NONBLOCK: opening a FIFO must not wait for a writer; it has no effect on regular files.
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return ioError(path, "cannot open", errno);
  InputFile file(descriptor, path.string(), 0);
  FARCELL_ASSIGN(file.sizeBytes_, regularFileBytes(descriptor, file.path_));
  return file;
}

Result<> InputFile::readAt(uint64_t offset, std::span<std::byte> out) const {
  if (offset > sizeBytes_ || out.size() > sizeBytes_ - offset)
    return corrupt(path_, offset, fmt::format("{} bytes", out.size()), fmt::format("a file of {} bytes", sizeBytes_));
  return readAll(descriptor_, path_, offset, out);
}

OutputFile::OutputFile(int descriptor, std::filesystem::path path, std::filesystem::path temporary)
    : descriptor_(descriptor), path_(std::move(path)), temporary_(std::move(temporary)) {
  buffer_.reserve(kWriteBufferBytes);
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      path_(std::move(other.path_)),
      temporary_(std::exchange(other.temporary_, {})),
      buffer_(std::move(other.buffer_)),
      sizeBytes_(other.sizeBytes_) {}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

Result<OutputFile> OutputFile::create(const std::filesystem::path& path) {
  // A rename would put a plain file in the place of a device such as /dev/null.
  struct stat info {};
  if (::stat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode))
    return fail(ErrorKind::io, "{}: expected a regular file or nothing there, found something else", path.string());
  const std::filesystem::path name = directoryOf(path) / (path.filename().string() + ".partial");
  FARCELL_ASSIGN(const int descriptor, openPartial(name));
  OutputFile file(descriptor, path, name);
  if (::ftruncate(descriptor, 0) != 0) return ioError(name, "cannot truncate", errno);
  return file;
}

Result<> OutputFile::append(std::span<const std::byte> bytes) {
  sizeBytes_ += bytes.size();
  buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
  if (buffer_.size() >= kWriteBufferBytes) return flush();
  return {};
}

Result<> OutputFile::flush() {
  FARCELL_TRY(writeAll(descriptor_, path_.string(), sizeBytes_ - buffer_.size(), buffer_));
  buffer_.clear();
  return {};
}

Result<> OutputFile::commit() {
  FARCELL_TRY(flush());
  if (::fsync(descriptor_) != 0) return ioError(path_, "cannot sync", errno);
  if (::close(std::exchange(descriptor_, -1)) != 0) return ioError(path_, "cannot close", errno);
  if (::rename(temporary_.c_str(), path_.c_str()) != 0) return ioError(path_, "cannot rename into place", errno);
  temporary_.clear();
  return syncDirectoryOf(path_);
}

ScratchFile::ScratchFile(int descriptor, std::string path) : descriptor_(descriptor), path_(std::move(path)) {}

ScratchFile::ScratchFile(ScratchFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), path_(std::move(other.path_)) {}

ScratchFile& ScratchFile::operator=(ScratchFile&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  std::swap(path_, other.path_);
  return *this;
}

ScratchFile::~ScratchFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Result<ScratchFile> ScratchFile::create(const std::filesystem::path& directory) {
  std::string name = (directory / "farcell-scratch.XXXXXX").string();
  const int descriptor = ::mkostemp(name.data(), O_CLOEXEC);
  if (descriptor < 0) return ioError(directory, "cannot create a scratch file in", errno);
  ::unlink(name.c_str());
  return ScratchFile(descriptor, directory.string());
}

Result<ScratchFile> ScratchFile::open(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NONBLOCK, 0666);
  if (descriptor < 0) return ioError(path, "cannot open", errno);
  return ScratchFile(descriptor, path.string());
}

Result<> ScratchFile::writeAt(uint64_t offset, std::span<const std::byte> bytes) {
  return writeAll(descriptor_, path_, offset, bytes);
}

Result<> ScratchFile::readAt(uint64_t offset, std::span<std::byte> out) const {
  return readAll(descriptor_, path_, offset, out);
}

Result<uint64_t> ScratchFile::sizeBytes() const {
  struct stat info {};
  if (::fstat(descriptor_, &info) != 0) return ioError(path_, "cannot stat", errno);
  return static_cast<uint64_t>(info.st_size);
}

Result<> ScratchFile::truncate(uint64_t sizeBytes) {
  if (::ftruncate(descriptor_, static_cast<off_t>(sizeBytes)) != 0) return ioError(path_, "cannot truncate", errno);
  return {};
}

Result<> ScratchFile::sync() {
  if (::fdatasync(descriptor_) != 0) return ioError(path_, "cannot sync", errno);
  return {};
}

GrowingFile::GrowingFile(int descriptor, std::string path, uint64_t sizeBytes)
    : descriptor_(descriptor), path_(std::move(path)), sizeBytes_(sizeBytes) {}

GrowingFile::GrowingFile(GrowingFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), path_(std::move(other.path_)), sizeBytes_(other.sizeBytes_) {}

GrowingFile::~GrowingFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Result<GrowingFile> GrowingFile::open(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NONBLOCK, 0666);
  if (descriptor < 0) return ioError(path, "cannot open for writing", errno);
  GrowingFile file(descriptor, path.string(), 0);
  FARCELL_ASSIGN(file.sizeBytes_, regularFileBytes(descriptor, file.path_));
  return file;
}

Result<> GrowingFile::readAt(uint64_t offset, std::span<std::byte> out) const {
  return readAll(descriptor_, path_, offset, out);
}

Result<> GrowingFile::append(std::span<const std::byte> bytes) {
  FARCELL_TRY(writeAll(descriptor_, path_, sizeBytes_, bytes));
  sizeBytes_ += bytes.size();
  return {};
}

Result<> GrowingFile::truncate(uint64_t sizeBytes) {
  if (::ftruncate(descriptor_, static_cast<off_t>(sizeBytes)) != 0) return ioError(path_, "cannot truncate", errno);
  sizeBytes_ = sizeBytes;
  return {};
}

Result<> GrowingFile::sync() {
  if (::fdatasync(descriptor_) != 0) return ioError(path_, "cannot sync", errno);
  return {};
}

Result<std::string> readTextFile(const std::filesystem::path& path, uint64_t maxBytes) {
  FARCELL_ASSIGN(InputFile file, InputFile::open(path));
  if (file.sizeBytes() > maxBytes)
    return fail(ErrorKind::exhausted, "{}: expected at most {} bytes, found {}", file.path(), maxBytes,
                file.sizeBytes());
  std::string text(file.sizeBytes(), '\0');
  FARCELL_TRY(file.readAt(0, std::as_writable_bytes(std::span(text))));
  return text;
}

Result<> writeTextFile(const std::filesystem::path& path, const std::string& text) {
  FARCELL_ASSIGN(OutputFile file, OutputFile::create(path));
  FARCELL_TRY(file.append(std::as_bytes(std::span(text))));
  return file.commit();
}

}  // namespace farcell
