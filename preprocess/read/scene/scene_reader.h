// Several meshes as one.
//
// - Colours: where one of them has any, those without have the default albedo.
// - Normals: where one of them has any, those without have the normals of their faces, so that they stay flat.
// - Up and unit are the first one's unless said otherwise: nothing is turned or scaled but by its placements.
// - A file is read once a pass, however often it is placed: triangles come by file, batch, placement.
#pragma once

#include <memory>
#include <optional>

#include "preprocess/mesh/read_memory.h"
#include "preprocess/read/scene/placement.h"

namespace farcell {

inline constexpr size_t kMaxSceneFiles = 1000;  // each stays open

struct ScenePart {
  std::unique_ptr<MeshReader> mesh;
  std::vector<Placement> placements;  // at least one
  MemoryClaim claim{};                // to them
};

struct SceneOptions {
  std::filesystem::path file;  // that names the parts, the first of MeshReader::files(); empty: none
  std::optional<UpAxis> up;
  std::optional<double> metresPerUnit;
};

// At least one part. unsupported when there are more triangles or vertices than 64 bits can count.
Result<std::unique_ptr<MeshReader>> composeMeshes(std::vector<ScenePart> parts, const SceneOptions& options);

}  // namespace farcell
