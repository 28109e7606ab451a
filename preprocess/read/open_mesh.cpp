#include "preprocess/read/open_mesh.h"

#include <array>
#include <cctype>

#include "preprocess/read/gltf/gltf_reader.h"
#include "preprocess/read/obj/obj_reader.h"
#include "preprocess/read/ply/ply_header.h"
#include "preprocess/read/ply/ply_reader.h"

namespace farcell {
namespace {

std::string lowerExtension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

struct OtherFormat {
  const char* extension;
  const char* name;
};
constexpr std::array<OtherFormat, 2> kOtherFormats = {{{".stl", "STL"}, {".off", "OFF"}}};

}  // namespace

Result<std::unique_ptr<MeshReader>> openMesh(const std::filesystem::path& path) {
  FARCELL_ASSIGN(InputFile file, InputFile::open(path));
  const std::string extension = lowerExtension(path);
  if (startsLikePly(file) || extension == ".ply") return openPly(std::move(file));
  if (startsLikeGltf(file) || extension == ".gltf" || extension == ".glb") return openGltf(std::move(file));
  if (extension == ".obj") return openObj(std::move(file));
  for (const OtherFormat& other : kOtherFormats)
    if (extension == other.extension)
      return fail(ErrorKind::unsupported, "{}: {} files cannot be read yet; expected PLY, OBJ or glTF", file.path(),
                  other.name);
  return fail(ErrorKind::unsupported,
              "{}: expected a PLY or GLB file, or a name ending in .ply, .obj, .gltf or .glb, found '{}'", file.path(),
              extension);
}

}  // namespace farcell
