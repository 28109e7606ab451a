#include "tools/evaluate/reference/traced_geometry.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "cache/pack/pages.h"
#include "cache/schema/model.h"
#include "shaders/shared/shading.h"

namespace farcell {
namespace {

Result<> embreeResult(RTCDevice device, const char* what) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return {};
  return fail(ErrorKind::exhausted, "the ray tracer (Embree) failed to {}: error code {}{}", what,
              static_cast<int>(error), error == RTC_ERROR_OUT_OF_MEMORY ? ", out of memory" : "");
}

glm::vec3 colourFromBytes(uint32_t bgr) {
  return glm::vec3(static_cast<float>(bgr & 255), static_cast<float>(bgr >> 8 & 255),
                   static_cast<float>(bgr >> 16 & 255)) /
         255.0f;
}

glm::vec3 unitFromBits(uint32_t octahedral) {
  const auto component = [](uint32_t bits) {
    return std::max(-1.0f, static_cast<float>(static_cast<int16_t>(bits)) / 32767.0f);
  };
  return shared::unitFromOctahedral(glm::vec2(component(octahedral & 0xffff), component(octahedral >> 16)));
}

// In double: the float cross product of a sliver's edges is mostly rounding.
glm::vec3 faceNormal(const LocalTriangles& geometry, glm::uvec3 corners) {
  const glm::dvec3 a(geometry.positions[corners.x]);
  const glm::dvec3 normal =
      glm::cross(glm::dvec3(geometry.positions[corners.y]) - a, glm::dvec3(geometry.positions[corners.z]) - a);
  const double length = glm::length(normal);
  return length > 0 ? glm::vec3(normal / length) : glm::vec3(0, 0, 1);
}

template <class Value>
glm::vec3 interpolate(const std::vector<uint32_t>& values, glm::uvec3 corners, float u, float v, Value&& value) {
  return (1 - u - v) * value(values[corners.x]) + u * value(values[corners.y]) + v * value(values[corners.z]);
}

glm::vec3 normalAt(const LocalTriangles& geometry, glm::uvec3 corners, float u, float v) {
  if (geometry.normals.empty()) return faceNormal(geometry, corners);
  const glm::vec3 normal = interpolate(geometry.normals, corners, u, v, unitFromBits);
  const float length = glm::length(normal);
  return length > 1e-6f ? normal / length : faceNormal(geometry, corners);
}

glm::vec3 albedoAt(const LocalTriangles& geometry, glm::uvec3 corners, float u, float v) {
  if (geometry.colours.empty()) return glm::vec3(kDefaultAlbedo[0], kDefaultAlbedo[1], kDefaultAlbedo[2]) / 255.0f;
  return interpolate(geometry.colours, corners, u, v, colourFromBytes);
}

glm::vec4 textureAt(const LocalTriangles& geometry, uint32_t triangle, float u, float v) {
  if (geometry.textureOf.empty() || geometry.textureOf[triangle] == kNoTexture) return glm::vec4(1);
  const glm::uvec3 corners = geometry.triangles[triangle];
  const glm::vec2 at = (1 - u - v) * geometry.coordinates[corners.x] + u * geometry.coordinates[corners.y] +
                       v * geometry.coordinates[corners.z];
  return geometry.textures.colourAt(geometry.textureOf[triangle], at);
}

bool isFrontOnly(const LocalTriangles& geometry, uint32_t triangle) {
  return !geometry.colours.empty() && (geometry.colours[geometry.triangles[triangle].x] & kSeenFromFront) != 0;
}

bool isWhole(const LocalTriangles& geometry) {
  for (uint32_t triangle = 0; triangle < geometry.triangles.size(); ++triangle)
    if (isFrontOnly(geometry, triangle)) return false;
  return std::all_of(geometry.textureOf.begin(), geometry.textureOf.end(), [&](uint32_t texture) {
    return texture == kNoTexture || geometry.textures.surface(texture).whole();
  });
}

void filterHits(const RTCFilterFunctionNArguments* args) {
  HitFilter& filter = *reinterpret_cast<const TraceContext*>(args->context)->filter;
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] != -1) continue;
    const bool accepted = filter.accepts(RTCRayN_id(args->ray, args->N, i), RTCHitN_primID(args->hit, args->N, i),
                                         RTCHitN_u(args->hit, args->N, i), RTCHitN_v(args->hit, args->N, i),
                                         RTCRayN_tfar(args->ray, args->N, i));
    if (!accepted) args->valid[i] = 0;
  }
}

void shareBuffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, const void* data, size_t count) {
  rtcSetSharedGeometryBuffer(geometry, type, 0, format, data, 0, 3 * sizeof(uint32_t), count);
}

}  // namespace

Result<EmbreeDevice> createEmbreeDevice(int threads) {
  EmbreeDevice device(rtcNewDevice(fmt::format("threads={}", threads).c_str()));
  if (!device) return fail(ErrorKind::unsupported, "the ray tracer (Embree) does not start on this machine");
  return device;
}

Result<TracedGeometry> buildTracedGeometry(RTCDevice device, LocalTriangles triangles) {
  TracedGeometry traced{std::move(triangles), nullptr};
  LocalTriangles& local = traced.triangles;
  if (local.triangles.empty()) return traced;
  const size_t positions = local.positions.size();
  local.positions.emplace_back(0);  // Embree reads 16 bytes from the last position on
  traced.scene.reset(rtcNewScene(device));
  rtcSetSceneFlags(traced.scene.get(), RTC_SCENE_FLAG_ROBUST);
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  shareBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, local.positions.data(), positions);
  shareBuffer(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, local.triangles.data(), local.triangles.size());
  if (!isWhole(local)) rtcSetGeometryIntersectFilterFunction(geometry, filterHits);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(traced.scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(traced.scene.get());
  FARCELL_TRY(embreeResult(device, "build its tree"));
  return traced;
}

float opacityAt(const LocalTriangles& geometry, uint32_t triangle, float u, float v, glm::dvec3 direction) {
  const bool textured = !geometry.textureOf.empty() && geometry.textureOf[triangle] != kNoTexture;
  const SurfaceKind surface = textured ? geometry.textures.surface(geometry.textureOf[triangle]) : SurfaceKind{};
  const glm::uvec3 corners = geometry.triangles[triangle];
  const glm::dvec3 a(geometry.positions[corners.x]), b(geometry.positions[corners.y]), c(geometry.positions[corners.z]);
  const bool isOneSided = !surface.doubleSided || isFrontOnly(geometry, triangle);
  if (isOneSided && glm::dot(glm::cross(b - a, c - a), direction) >= 0) return 0;
  return surface.alpha == AlphaMode::opaque ? 1 : textureAt(geometry, triangle, u, v).w;
}

glm::vec3 shadeHit(const LocalTriangles& geometry, uint32_t triangle, float u, float v, glm::vec3 light) {
  const glm::uvec3 corners = geometry.triangles[triangle];
  const glm::vec3 albedo = albedoAt(geometry, corners, u, v) * glm::vec3(textureAt(geometry, triangle, u, v));
  return shared::shade(albedo, normalAt(geometry, corners, u, v), light);
}

}  // namespace farcell
