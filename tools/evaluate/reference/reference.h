// The truth that pictures are measured against: rays through the full geometry, many samples a pixel, with the shading
// that baker and runtime use (shaders/shared/shading.h).
//
// 1. `traceReference` walks the octree from the eye outwards (leaves.h). Leaf cubes are disjoint, so the first leaf in
//    which a sample's ray hits anything owns the sample: leaves are read, traced and dropped a few at a time, however
//    large the model.
// 2. `MeshReference` holds the original files' triangles in memory. It alone can see what was lost on the way into
//    the pack.
// Both trace the same rays (tracer.h), so that their difference is the geometry's alone. Selection and culling of the
// runtime are not used: a fault there must show as an error.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>

#include "cache/base/result.h"
#include "cache/pack/pack_file.h"
#include "runtime/camera/light.h"
#include "tools/evaluate/metrics/images.h"

namespace farcell {

inline constexpr int kMaxReferenceSamples = 64;

struct ReferenceSettings {
  int width = 1280;
  int height = 720;
  int samples = kMaxReferenceSamples;  // per pixel: a square number up to 64
  int threads = 0;                     // 0: all. The picture does not depend on it
  Light light{};
};

// invalidArgument unless `samples` is a square number in [1, 64].
Result<> checkReferenceSamples(int samples);

// From the pack's own leaves, with their atlases, out of core. Ends with `cancelled` on Ctrl-C.
Result<ReferenceImage> traceReference(const PackFile& pack, const Camera& camera, const ReferenceSettings& settings);

// From the files a pack was built from; about 250 bytes of memory a triangle and 4 a pixel of their textures.
class MeshReference {
 public:
  // The files as they were given to the build; invalidArgument when their hash is not the pack's sourceHash. `progress`
  // is told of triangles read.
  static Result<MeshReference> load(std::span<const std::filesystem::path> meshes, const Directory& directory,
                                    const std::function<void(uint64_t triangles)>& progress);
  MeshReference(MeshReference&&) noexcept;
  ~MeshReference();

  uint64_t triangles() const;
  Result<ReferenceImage> trace(const Camera& camera, const ReferenceSettings& settings) const;

 private:
  struct Impl;
  explicit MeshReference(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace farcell
