// Loaded into a program with LD_PRELOAD: makes its Nth change to the file system fail, or the process end there.
//
// FARCELL_FAULT_AT: which call, from 1; 0 or none: none. FARCELL_FAULT_KIND: kill (half of a write is done, then
// SIGKILL), enospc, eio, short (a write of half: not an error, the caller must go on). FARCELL_FAULT_COUNT: a file that
// gets the number of calls at the end of the program.
#include <dlfcn.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

std::atomic<long> calls{0};

long faultAt() {
  static const long at = [] {
    const char* text = std::getenv("FARCELL_FAULT_AT");
    return text != nullptr ? std::atol(text) : 0;
  }();
  return at;
}

bool kindIs(const char* kind) {
  const char* text = std::getenv("FARCELL_FAULT_KIND");
  return text != nullptr && std::strcmp(text, kind) == 0;
}

struct Count {
  ~Count() {
    const char* path = std::getenv("FARCELL_FAULT_COUNT");
    if (path == nullptr) return;
    if (std::FILE* file = std::fopen(path, "w")) {
      std::fprintf(file, "%ld\n", calls.load());
      std::fclose(file);
    }
  }
} count;

[[noreturn]] void die() {
  ::kill(::getpid(), SIGKILL);
  ::_exit(137);
}

bool isRegular(int descriptor) {
  struct stat info {};
  return ::fstat(descriptor, &info) == 0 && S_ISREG(info.st_mode);
}

// Whether this call is the one.
bool strikes() { return ++calls == faultAt(); }
// The same where nothing can be short.
bool strikesWhole() { return strikes() && !kindIs("short"); }

// -1 and errno, or the end.
int failure() {
  if (kindIs("kill")) die();
  errno = kindIs("enospc") ? ENOSPC : EIO;
  return -1;
}

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

template <class Write>
ssize_t faultyWrite(int descriptor, size_t size, const Write& write) {
  if (!isRegular(descriptor) || !strikes()) return write(size);
  if (kindIs("short")) return write(size / 2 + (size < 2 ? size : 0));
  if (size > 1) write(size / 2);  // what was torn off stays
  return failure();
}

}  // namespace

extern "C" {

ssize_t write(int descriptor, const void* bytes, size_t size) {
  static const auto real = next<ssize_t (*)(int, const void*, size_t)>("write");
  return faultyWrite(descriptor, size, [&](size_t part) { return real(descriptor, bytes, part); });
}
ssize_t pwrite(int descriptor, const void* bytes, size_t size, off_t offset) {
  static const auto real = next<ssize_t (*)(int, const void*, size_t, off_t)>("pwrite");
  return faultyWrite(descriptor, size, [&](size_t part) { return real(descriptor, bytes, part, offset); });
}
ssize_t pwrite64(int descriptor, const void* bytes, size_t size, off_t offset) {
  return pwrite(descriptor, bytes, size, offset);
}
int fsync(int descriptor) {
  static const auto real = next<int (*)(int)>("fsync");
  return strikesWhole() ? failure() : real(descriptor);
}
int fdatasync(int descriptor) {
  static const auto real = next<int (*)(int)>("fdatasync");
  return strikesWhole() ? failure() : real(descriptor);
}
int rename(const char* from, const char* to) {
  static const auto real = next<int (*)(const char*, const char*)>("rename");
  return strikesWhole() ? failure() : real(from, to);
}
int ftruncate(int descriptor, off_t size) {
  static const auto real = next<int (*)(int, off_t)>("ftruncate");
  return strikesWhole() ? failure() : real(descriptor, size);
}
int ftruncate64(int descriptor, off_t size) { return ftruncate(descriptor, size); }
int unlink(const char* path) {
  static const auto real = next<int (*)(const char*)>("unlink");
  return strikesWhole() ? failure() : real(path);
}
int mkdir(const char* path, mode_t mode) {
  static const auto real = next<int (*)(const char*, mode_t)>("mkdir");
  return strikesWhole() ? failure() : real(path, mode);
}
}
