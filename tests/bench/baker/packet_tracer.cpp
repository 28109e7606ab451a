#include "tests/bench/baker/packet_tracer.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "shaders/shared/shading.h"

namespace farcell::bench {
namespace {

constexpr int kPacket = 16;
constexpr float kStartW = 2;  // outside of every grown cube

glm::vec3 albedoOf(uint32_t colour) {
  return glm::vec3(static_cast<float>(colour & 0xff), static_cast<float>(colour >> 8 & 0xff),
                   static_cast<float>(colour >> 16 & 0xff)) *
         (1 / 255.0f);
}

// The texels and samples of one packet: a square of 16 samples.
struct PacketShape {
  int edge;    // samples along a texel's edge
  int texels;  // texels along the packet's edge, at least 1
};

struct Sums {
  glm::vec3 colour = glm::vec3(0);
  int covered = 0;
  float nearest = -std::numeric_limits<float>::infinity();
};

}  // namespace

PacketTracer::PacketTracer(const CellSoup& soup, bool robust)
    : soup_(soup), device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
  rtcSetSceneFlags(scene_, robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), 3 * soup.size()));
  auto* indices = static_cast<uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), soup.size()));
  for (size_t i = 0; i < 3 * soup.size(); ++i) {
    vertices[3 * i] = soup.x[i % 3][i / 3];
    vertices[3 * i + 1] = soup.y[i % 3][i / 3];
    vertices[3 * i + 2] = soup.z[i % 3][i / 3];
    indices[i] = static_cast<uint32_t>(i);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_);
}

PacketTracer::~PacketTracer() {
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

namespace {

void aim(RTCRayHit16& packet, const ViewFrame& frame, const BakeSettings& settings, const PacketShape& shape, int x,
         int y) {
  const double step = texelSize(settings.imageSize) / shape.edge;
  const int edge = 4;  // samples along the packet's edge
  const glm::vec3 direction(-frame.toward), right(frame.right), up(frame.up);
  const glm::vec3 start(frame.toward * double{kStartW});
  for (int i = 0; i < kPacket; ++i) {
    const auto u = static_cast<float>((x * shape.edge + i % edge + 0.5) * step - kViewHalfExtent);
    const auto v = static_cast<float>((y * shape.edge + i / edge + 0.5) * step - kViewHalfExtent);
    const glm::vec3 origin = start + right * u + up * v;
    packet.ray.org_x[i] = origin.x;
    packet.ray.org_y[i] = origin.y;
    packet.ray.org_z[i] = origin.z;
    packet.ray.dir_x[i] = direction.x;
    packet.ray.dir_y[i] = direction.y;
    packet.ray.dir_z[i] = direction.z;
    packet.ray.tnear[i] = 0;
    packet.ray.tfar[i] = std::numeric_limits<float>::infinity();
    packet.ray.time[i] = 0;
    packet.ray.mask[i] = 0xffffffffu;
    packet.ray.id[i] = 0;
    packet.ray.flags[i] = 0;
    packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
  }
}

void addHit(Sums& sums, const RTCRayHit16& packet, int i, const CellSoup& soup, glm::vec3 sun) {
  if (packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) return;
  const uint32_t triangle = packet.hit.primID[i];
  const float first = packet.hit.u[i], second = packet.hit.v[i];
  const glm::vec3 albedo = albedoOf(soup.colours[0][triangle]) * (1 - first - second) +
                           albedoOf(soup.colours[1][triangle]) * first + albedoOf(soup.colours[2][triangle]) * second;
  const glm::vec3 normal = glm::normalize(glm::vec3(packet.hit.Ng_x[i], packet.hit.Ng_y[i], packet.hit.Ng_z[i]));
  sums.colour += shared::shade(albedo, normal, sun);
  ++sums.covered;
  sums.nearest = std::max(sums.nearest, kStartW - packet.ray.tfar[i]);
}

void writeTexel(BakedView& view, int column, int row, const Sums& sums, int samples) {
  if (column >= view.width || row >= view.height) return;
  const auto texel = size_t(row * view.width + column);
  for (int channel = 0; channel < 3; ++channel)
    view.rgba[4 * texel + size_t(channel)] = sums.colour[channel] / static_cast<float>(samples);
  view.rgba[4 * texel + 3] = static_cast<float>(sums.covered) / static_cast<float>(samples);
  view.depth[texel] = sums.nearest;
}

}  // namespace

BakedView PacketTracer::bake(const ViewFrame& frame, const BakeSettings& settings, const BakedView& area) const {
  const int edge = static_cast<int>(std::lround(std::sqrt(settings.samples)));
  const PacketShape shape{edge, 4 / edge};
  BakedView view;
  view.x0 = area.x0;
  view.y0 = area.y0;
  view.width = area.width;
  view.height = area.height;
  view.rgba.resize(area.rgba.size());
  view.depth.resize(area.depth.size());
  alignas(64) int valid[kPacket];
  std::fill_n(valid, kPacket, -1);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  RTCRayHit16 packet;
  for (int row = 0; row < view.height; row += shape.texels) {
    for (int column = 0; column < view.width; column += shape.texels) {
      aim(packet, frame, settings, shape, view.x0 + column, view.y0 + row);
      rtcIntersect16(valid, scene_, &context, &packet);
      Sums sums[kPacket];
      for (int i = 0; i < kPacket; ++i)
        addHit(sums[i / 4 / edge * shape.texels + i % 4 / edge], packet, i, soup_, settings.sun);
      for (int i = 0; i < shape.texels * shape.texels; ++i)
        writeTexel(view, column + i % shape.texels, row + i / shape.texels, sums[i], settings.samples);
    }
  }
  return view;
}

}  // namespace farcell::bench
