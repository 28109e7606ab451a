#include "preprocess/mesh/source_identity.h"

#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <system_error>

namespace farcell {
namespace {

constexpr int64_t kNsPerSecond = 1'000'000'000;

Result<FileIdentity> identityOf(const std::filesystem::path& path) {
  struct stat info {};
  if (::stat(path.c_str(), &info) != 0)
    return fail(errno == ENOENT ? ErrorKind::notFound : ErrorKind::io, "{}: cannot stat: {}", path.string(),
                std::strerror(errno));
  std::error_code code;
  const std::filesystem::path absolute = std::filesystem::absolute(path, code);
  if (code) return fail(ErrorKind::io, "{}: cannot make the path absolute: {}", path.string(), code.message());
  return FileIdentity{absolute.lexically_normal().string(), static_cast<uint64_t>(info.st_size),
                      int64_t{info.st_mtim.tv_sec} * kNsPerSecond + info.st_mtim.tv_nsec,
                      static_cast<uint64_t>(info.st_ino)};
}

std::string escaped(std::string_view path) {
  std::string out;
  for (const char c : path) {
    if (c == '\\' || c == '\n') out += '\\';
    out += c == '\n' ? 'n' : c;
  }
  return out;
}

}  // namespace

std::string SourceIdentity::text() const {
  std::string lines;
  for (const FileIdentity& file : files)
    lines += fmt::format("{} {} {} {}\n", file.sizeBytes, file.modifiedNs, file.inode, escaped(file.path));
  return lines;
}

Result<SourceIdentity> sourceIdentity(std::span<const std::filesystem::path> files) {
  SourceIdentity identity;
  for (const std::filesystem::path& path : files) {
    FARCELL_ASSIGN(identity.files.emplace_back(), identityOf(path));
  }
  return identity;
}

}  // namespace farcell
