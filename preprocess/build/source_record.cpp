#include "preprocess/build/source_record.h"

#include "cache/base/sealed_file.h"
#include "preprocess/mesh/source_hash.h"
#include "preprocess/mesh/source_identity.h"

namespace farcell {
namespace {

constexpr uint64_t kMagic = 0x31656372'756f7366;  // "fsource1"

std::filesystem::path fileIn(const std::filesystem::path& workDirectory) { return workDirectory / "source"; }

// Names as they were given: the same names may mean other files only where the identity differs too.
std::string textOf(std::span<const std::filesystem::path> paths) {
  std::string text;
  for (const std::filesystem::path& path : paths) text += path.string() + '\0';
  return text;
}

void put(SealedWriter& writer, const MeshInfo& info) {
  writer.put(info.hasColours);
  writer.put(info.hasNormals);
  writer.put(info.declaredTriangles);
  writer.put(info.vertices);
  writer.put(info.format);
  writer.put(info.up);
  writer.put(info.metresPerUnit);
}

bool get(SealedReader& reader, MeshInfo& info) {
  return reader.get(info.hasColours) && reader.get(info.hasNormals) && reader.get(info.declaredTriangles) &&
         reader.get(info.vertices) && reader.get(info.format) && reader.get(info.up) && reader.get(info.metresPerUnit);
}

}  // namespace

Result<SourceRecord> SourceRecord::of(const MeshReader& mesh) {
  FARCELL_ASSIGN(const SourceIdentity identity, sourceIdentity(mesh.files()));
  FARCELL_ASSIGN(const uint64_t hash, sourceHash(mesh));
  return SourceRecord{mesh.info(), mesh.files(), identity.text(), hash, mesh.textures().size()};
}

std::optional<SourceRecord> SourceRecord::load(const std::filesystem::path& workDirectory,
                                               std::span<const std::filesystem::path> meshes) {
  std::optional<SealedReader> reader = SealedReader::open(fileIn(workDirectory));
  SourceRecord record;
  uint64_t magic = 0, files = 0;
  std::string names;
  if (!reader || !reader->get(magic) || magic != kMagic || !reader->get(names) || names != textOf(meshes) ||
      !get(*reader, record.info) || !reader->get(record.identity) || !reader->get(record.hash) ||
      !reader->get(record.textures) || !reader->get(files))
    return std::nullopt;
  for (std::string file; files > 0; --files) {
    if (!reader->get(file)) return std::nullopt;
    record.files.emplace_back(file);
  }
  const Result<SourceIdentity> now = sourceIdentity(record.files);
  if (!now || now->text() != record.identity) return std::nullopt;
  return record;
}

Result<> SourceRecord::save(const std::filesystem::path& workDirectory,
                            std::span<const std::filesystem::path> meshes) const {
  SealedWriter writer;
  writer.put(kMagic);
  writer.put(textOf(meshes));
  put(writer, info);
  writer.put(identity);
  writer.put(hash);
  writer.put(textures);
  writer.put(uint64_t{files.size()});
  for (const std::filesystem::path& file : files) writer.put(file.string());
  return writer.commit(fileIn(workDirectory));
}

}  // namespace farcell
