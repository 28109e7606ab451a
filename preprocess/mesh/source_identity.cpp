#include "preprocess/mesh/source_identity.h"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
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

// False when it is no such text.
bool unescape(std::string_view text, std::string& path) {
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\\') {
      path += text[i];
      continue;
    }
    if (++i == text.size() || (text[i] != 'n' && text[i] != '\\')) return false;
    path += text[i] == 'n' ? '\n' : '\\';
  }
  return !path.empty();
}

template <class T>
bool takeNumber(std::string_view& rest, T& value) {
  const auto [stop, code] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  const auto length = static_cast<size_t>(stop - rest.data());
  if (code != std::errc{} || length >= rest.size() || rest[length] != ' ') return false;
  rest.remove_prefix(length + 1);
  return true;
}

std::string changeOf(const FileIdentity& now, const FileIdentity& before) {
  if (now.path != before.path) return fmt::format("{}, before {}", now.path, before.path);
  if (now.sizeBytes != before.sizeBytes)
    return fmt::format("{}: {} bytes, before {}", now.path, now.sizeBytes, before.sizeBytes);
  if (now.modifiedNs != before.modifiedNs)
    return fmt::format("{}: written at {} ns, before at {}", now.path, now.modifiedNs, before.modifiedNs);
  return fmt::format("{}: another file of the same name", now.path);
}

}  // namespace

std::string SourceIdentity::text() const {
  std::string lines;
  for (const FileIdentity& file : files)
    lines += fmt::format("{} {} {} {}\n", file.sizeBytes, file.modifiedNs, file.inode, escaped(file.path));
  return lines;
}

Result<SourceIdentity> SourceIdentity::parse(const std::string& name, std::string_view text) {
  SourceIdentity identity;
  for (uint64_t offset = 0; offset < text.size();) {
    const size_t end = text.find('\n', offset);
    std::string_view line = text.substr(offset, end - offset);
    FileIdentity& file = identity.files.emplace_back();
    if (end == std::string_view::npos || !takeNumber(line, file.sizeBytes) || !takeNumber(line, file.modifiedNs) ||
        !takeNumber(line, file.inode) || !unescape(line, file.path))
      return corrupt(name, offset, "a line of size, time, inode and path of a file",
                     fmt::format("'{}'", text.substr(offset, std::min<size_t>(end - offset, 60))));
    offset = end + 1;
  }
  return identity;
}

std::string SourceIdentity::changeSince(const SourceIdentity& before) const {
  for (size_t i = 0; i < std::min(files.size(), before.files.size()); ++i)
    if (files[i] != before.files[i]) return changeOf(files[i], before.files[i]);
  if (files.size() == before.files.size()) return {};
  return fmt::format("{} files, before {}", files.size(), before.files.size());
}

Result<SourceIdentity> sourceIdentity(const MeshReader& mesh) {
  SourceIdentity identity;
  for (const std::filesystem::path& path : mesh.files()) {
    FARCELL_ASSIGN(identity.files.emplace_back(), identityOf(path));
  }
  return identity;
}

}  // namespace farcell
