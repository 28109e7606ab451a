// Triangles that Embree can be asked about, in a frame of their own: local = (world - origin) / unit. The frame keeps
// float coordinates near 1 wherever the model lies and whatever its size.
#pragma once

#include <embree3/rtcore.h>

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <type_traits>
#include <vector>

#include "cache/base/result.h"
#include "tools/evaluate/reference/whole_textures.h"

namespace farcell {

struct LocalTriangles {
  glm::dvec3 origin{0};
  double unit = 1;            // world length of 1
  glm::dvec3 min{0}, max{0};  // world box around them
  std::vector<glm::vec3> positions;
  std::vector<uint32_t> colours;  // as in GeometryPage; empty: kDefaultAlbedo
  std::vector<uint32_t> normals;  // octahedral per position, as in GeometryPage; empty: flat faces
  std::vector<glm::uvec3> triangles;
  // What multiplies the colours; empty: no triangle has a texture.
  std::vector<uint32_t> textureOf;     // per triangle: index into textures, or kNoTexture
  std::vector<glm::vec2> coordinates;  // per position
  WholeTextures textures;
};

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using EmbreeDevice = std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice>;
using EmbreeScene = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene>;

// threads: of one build; 0: all the machine offers.
Result<EmbreeDevice> createEmbreeDevice(int threads);

// The triangles with their ray tracing scene. Movable; must not outlive its device.
struct TracedGeometry {
  LocalTriangles triangles;
  EmbreeScene scene;  // empty when there are no triangles
};
// What decides of hits on geometry that is not a surface everywhere or for everyone; Embree is given its context, in
// which it follows. Rays are named by RTCRay::id.
class HitFilter {
 public:
  virtual bool accepts(uint32_t ray, uint32_t triangle, float u, float v, float distance) = 0;

 protected:
  ~HitFilter() = default;
};
struct TraceContext {
  RTCIntersectContext embree;  // first
  HitFilter* filter;
};

// Robust: rays along shared edges do not slip through. `exhausted` when Embree cannot.
Result<TracedGeometry> buildTracedGeometry(RTCDevice device, LocalTriangles triangles);

// How much of what a ray meets there the surface makes, in [0, 1]; 0 where it runs against the back of a triangle that
// is seen from its front only.
float opacityAt(const LocalTriangles& geometry, uint32_t triangle, float u, float v, glm::dvec3 direction);

// Lit colour, R, G, B in [0, 1], at barycentric (u, v) of a triangle as Embree reports them. `light` as in shading.h.
glm::vec3 shadeHit(const LocalTriangles& geometry, uint32_t triangle, float u, float v, glm::vec3 light);

}  // namespace farcell
