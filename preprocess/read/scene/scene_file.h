// A scene file: JSON that names meshes and where they stand.
//
//   {"up": "z",                              optional: x, y or z; else that of the first file
//    "unit": "m",                            optional: mm, cm, m, km, in, ft, or a number of metres; else likewise
//    "files": [                              at least one
//      {"path": "tower.obj",                 from the scene file's directory; a mesh, not another scene
//       "translation": [x, y, z],            optional, as are the next three; model units
//       "rotation": [x, y, z, w],            a quaternion of any length, or {"axis": [x, y, z], "angleDeg": number}
//       "scale": 2,                          or [x, y, z]; 1e-12 to 1e12 in magnitude; negative: a mirror
//       "instances": [{"translation": ..., "rotation": ..., "scale": ...}]}]}   copies; else there is one
//
// A point of the file is scaled, turned and moved by the file's own transform, then in the same way by its instance's.
// A rotation is right-handed; quarter turns about a coordinate axis are exact. Other names than these, or one of them
// twice, are errors.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "preprocess/read/scene/placement.h"

namespace farcell {

inline constexpr uint64_t kMaxSceneBytes = uint64_t{16} << 20;
inline constexpr size_t kMaxPlacements = 1'000'000;  // of all files together

struct SceneFile {
  std::filesystem::path path;  // as it can be opened
  std::vector<Placement> placements;
};

struct Scene {
  std::vector<SceneFile> files;
  std::optional<UpAxis> up;
  std::optional<double> metresPerUnit;
};

// corrupt, naming the member: "scene.json: files[2].scale: expected ..., found ..."; exhausted above the limits.
Result<Scene> readScene(const std::filesystem::path& path);

}  // namespace farcell
