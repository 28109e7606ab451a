#include "tools/batch/plan/build_record.h"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "cache/base/file.h"

namespace farcell {
namespace {

using Json = nlohmann::ordered_json;

constexpr uint64_t kMaxRecordBytes = uint64_t{64} << 20;

// Paths may be of any bytes, JSON only of UTF-8: a byte a character, none is lost.
std::string inLatin1(const std::string& path) {
  std::string text;
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      text += c;
    } else {
      text += static_cast<char>(0xc0 | byte >> 6);
      text += static_cast<char>(0x80 | (byte & 0x3f));
    }
  }
  return text;
}

Json identityJson(const FileIdentity& file) {
  return {{"path", inLatin1(file.path)}, {"bytes", file.bytes}, {"modifiedNs", file.modifiedNs}};
}

std::string fromLatin1(const std::string& text) {
  std::string bytes;
  for (size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (byte >= 0x80 && (byte > 0xc3 || ++i == text.size())) throw std::invalid_argument("not of Latin-1");
    bytes += byte < 0x80 ? text[i] : static_cast<char>(byte << 6 | (static_cast<unsigned char>(text[i]) & 0x3f));
  }
  return bytes;
}

FileIdentity identityFrom(const Json& json) {
  return {fromLatin1(json.at("path").get<std::string>()), json.at("bytes").get<uint64_t>(),
          json.at("modifiedNs").get<int64_t>()};
}

bool isAsItWas(const FileIdentity& file) {
  const Result<FileIdentity> now = identityOf(file.path);
  return now && *now == file;
}

}  // namespace

Result<FileIdentity> identityOf(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::absolute(path, error);
  struct stat info {};
  if (error || ::stat(whole.c_str(), &info) != 0)
    return fail(ErrorKind::notFound, "{}: {}", path.string(), std::strerror(errno));
  return FileIdentity{whole.lexically_normal().string(), static_cast<uint64_t>(info.st_size),
                      int64_t{info.st_mtim.tv_sec} * 1'000'000'000 + info.st_mtim.tv_nsec};
}

std::string recordText(const BuildRecord& record) {
  Json files = Json::array();
  for (const FileIdentity& file : record.files) files.push_back(identityJson(file));
  Json arguments = Json::array();
  for (const std::string& argument : record.arguments) arguments.push_back(inLatin1(argument));
  const Json json = {{"version", record.version},
                     {"arguments", arguments},
                     {"pack", identityJson(record.pack)},
                     {"files", files},
                     {"triangles", record.triangles}};
  return fmt::format("{}\n", json.dump(2));
}

std::optional<BuildRecord> parseRecord(const std::string& text) {
  try {
    const Json json = Json::parse(text);
    BuildRecord record;
    record.version = json.at("version").get<std::string>();
    for (const Json& argument : json.at("arguments"))
      record.arguments.push_back(fromLatin1(argument.get<std::string>()));
    record.pack = identityFrom(json.at("pack"));
    for (const Json& file : json.at("files")) record.files.push_back(identityFrom(file));
    record.triangles = json.at("triangles").get<uint64_t>();
    return record;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

std::optional<BuildRecord> currentRecord(const std::filesystem::path& path, const std::vector<std::string>& arguments) {
  const Result<std::string> text = readTextFile(path, kMaxRecordBytes);
  if (!text) return std::nullopt;
  std::optional<BuildRecord> record = parseRecord(*text);
  if (!record || record->version != FARCELL_VERSION || record->arguments != arguments || record->files.empty())
    return std::nullopt;
  if (!isAsItWas(record->pack) || !std::all_of(record->files.begin(), record->files.end(), isAsItWas))
    return std::nullopt;
  return record;
}

}  // namespace farcell
