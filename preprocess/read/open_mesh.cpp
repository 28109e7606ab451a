#include "preprocess/read/open_mesh.h"

#include <array>
#include <cctype>

#include "preprocess/read/gltf/gltf_reader.h"
#include "preprocess/read/obj/obj_reader.h"
#include "preprocess/read/off/off_reader.h"
#include "preprocess/read/ply/ply_header.h"
#include "preprocess/read/ply/ply_reader.h"
#include "preprocess/read/scene/scene_file.h"
#include "preprocess/read/scene/scene_reader.h"
#include "preprocess/read/stl/stl_reader.h"

namespace farcell {
namespace {

using OpenedMesh = Result<std::unique_ptr<MeshReader>>;
using Memory = std::shared_ptr<ReadMemory>;

std::string lowerExtension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

// Has nothing to keep.
OpenedMesh openStlWithout(InputFile file, const Memory&) { return openStl(std::move(file)); }

struct Format {
  const char* extension;
  OpenedMesh (*open)(InputFile, const Memory&);
  bool (*startsLike)(const InputFile&);  // null: the content alone says too little
};
constexpr std::array<Format, 6> kFormats = {{{".ply", openPly, startsLikePly},
                                             {".glb", openGltf, startsLikeGltf},
                                             {".off", openOff, startsLikeOff},
                                             {".stl", openStlWithout, hasBinaryStlSize},
                                             {".obj", openObj, nullptr},
                                             {".gltf", openGltf, nullptr}}};

OpenedMesh openFile(const std::filesystem::path& path, const Memory& memory) {
  FARCELL_ASSIGN(InputFile file, InputFile::open(path));
  const std::string extension = lowerExtension(path);
  for (const Format& format : kFormats)
    if (format.startsLike && format.startsLike(file)) return format.open(std::move(file), memory);
  for (const Format& format : kFormats)
    if (extension == format.extension) return format.open(std::move(file), memory);
  return fail(ErrorKind::unsupported,
              "{}: expected a mesh, with a name in .ply, .obj, .stl, .off, .gltf or .glb, found '{}'", file.path(),
              extension);
}

OpenedMesh openScene(const std::filesystem::path& path, const Memory& memory) {
  FARCELL_ASSIGN(Scene scene, readScene(path));
  std::vector<ScenePart> parts;
  for (SceneFile& file : scene.files) {
    FARCELL_ASSIGN(std::unique_ptr<MeshReader> mesh, openFile(file.path, memory));
    FARCELL_ASSIGN(MemoryClaim claim, memory->claim(file.placements.size() * sizeof(Placement),
                                                    fmt::format("{}: placements", path.string())));
    parts.push_back({std::move(mesh), std::move(file.placements), std::move(claim)});
  }
  return composeMeshes(std::move(parts), {path, scene.up, scene.metresPerUnit});
}

OpenedMesh openAny(const std::filesystem::path& path, const Memory& memory) {
  return lowerExtension(path) == ".json" ? openScene(path, memory) : openFile(path, memory);
}

}  // namespace

OpenedMesh openMesh(const std::filesystem::path& path, const ReadOptions& options) {
  return openMeshes({&path, 1}, options);
}

OpenedMesh openMeshes(std::span<const std::filesystem::path> paths, const ReadOptions& options) {
  FARCELL_ASSIGN(const Memory memory, ReadMemory::create(options));
  return openMeshes(paths, memory);
}

OpenedMesh openMeshes(std::span<const std::filesystem::path> paths, const Memory& memory) {
  if (paths.empty() || paths.size() > kMaxSceneFiles)
    return fail(ErrorKind::invalidArgument, "expected 1 to {} mesh files, found {}", kMaxSceneFiles, paths.size());
  if (paths.size() == 1) return openAny(paths[0], memory);
  std::vector<ScenePart> parts;
  for (const std::filesystem::path& path : paths) {
    FARCELL_ASSIGN(std::unique_ptr<MeshReader> mesh, openAny(path, memory));
    parts.push_back({std::move(mesh), {Placement(Pose{})}, {}});
  }
  return composeMeshes(std::move(parts), {});
}

}  // namespace farcell
