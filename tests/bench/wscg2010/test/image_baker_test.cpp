// Images against rays: Embree knows nothing of cells, projections or clipping. A ray is cut to the cell's cube, so it
// sees the first surface inside, which is what an image of the cut cell shows.
#include "tests/bench/wscg2010/scene/image_baker.h"

#include <embree3/rtcore.h>
#include <gtest/gtest.h>

#include <numbers>

#include "shaders/shared/shading.h"
#include "tests/bench/wscg2010/test/samples.h"

namespace farcell::wscg {
namespace {

class RayTracer {
 public:
  explicit RayTracer(const Scene& scene)
      : scene_(scene), device_(rtcNewDevice("threads=1")), rays_(rtcNewScene(device_)) {
    rtcSetSceneFlags(rays_, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    const size_t corners = 3 * scene.triangles.size();
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), corners));
    auto* indices = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                   3 * sizeof(uint32_t), scene.triangles.size()));
    for (size_t i = 0; i < corners; ++i) {
      const glm::vec3 p = scene.triangles[i / 3].corners[i % 3];
      for (int axis = 0; axis < 3; ++axis) vertices[3 * i + size_t(axis)] = p[axis];
      indices[i] = static_cast<uint32_t>(i);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(rays_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(rays_);
  }
  ~RayTracer() {
    rtcReleaseScene(rays_);
    rtcReleaseDevice(device_);
  }
  RayTracer(const RayTracer&) = delete;
  RayTracer& operator=(const RayTracer&) = delete;

  // Lit colour of 0-255 of what the ray meets first within the cube; nothing: false.
  bool see(glm::dvec3 origin, glm::dvec3 direction, glm::dvec3 centre, double half, glm::vec3& colour) const {
    double enter = 0, leave = INFINITY;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = (centre[axis] - half - origin[axis]) / direction[axis];
      const double b = (centre[axis] + half - origin[axis]) / direction[axis];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    if (enter >= leave) return false;
    RTCRayHit hit{};
    const glm::dvec3 start = origin + direction * enter;
    for (int axis = 0; axis < 3; ++axis) {
      (&hit.ray.org_x)[axis] = static_cast<float>(start[axis]);
      (&hit.ray.dir_x)[axis] = static_cast<float>(direction[axis]);
    }
    hit.ray.tfar = static_cast<float>(leave - enter);
    hit.ray.mask = 0xffffffffu;
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(rays_, &context, &hit);
    if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    const glm::vec3 normal = glm::normalize(glm::vec3(hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z));
    const uint32_t albedo = scene_.triangles[hit.hit.primID].colours[0];
    colour = shared::shade(glm::vec3(albedo & 255, albedo >> 8 & 255, albedo >> 16 & 255), normal, scene_.sun);
    return true;
  }

 private:
  const Scene& scene_;
  RTCDevice device_;
  RTCScene rays_;
};

struct Agreement {
  int texels = 0, covered = 0, coverageDiffers = 0, colourDiffers = 0;
};

struct Shot {
  CellKey key;
  glm::dvec3 direction;
  ImageSettings settings;
};

bool texelAt(const CellImage& image, int x, int y, glm::vec3& colour) {
  const int column = x - image.x0, row = y - image.y0;
  if (column < 0 || row < 0 || column >= image.width || row >= image.height) return false;
  const uint8_t* texel = &image.rgba[4 * static_cast<size_t>(row * image.width + column)];
  colour = glm::vec3(texel[0], texel[1], texel[2]);
  return texel[3] == 255;
}

void compare(const CellIndex& index, const RayTracer& tracer, const Shot& shot, Agreement& agreement) {
  const CellImage image =
      ImageBaker(shot.settings, index.scene().sun).bake(index.content(shot.key, Content::cube), shot.direction);
  const ViewFrame frame = viewFrame(shot.direction);
  const glm::dvec3 centre = cellCentre(shot.key);
  const double radius = imageRadius(index.depth(), Content::cube);
  const double fov = shot.settings.fovRad;
  const double half = fov == 0 ? radius : radius / std::sin(fov / 2) * std::tan(fov / 2);
  for (int y = 0; y < shot.settings.size; ++y) {
    for (int x = 0; x < shot.settings.size; ++x) {
      const double u = (2 * (x + .5) / shot.settings.size - 1) * half,
                   v = (2 * (y + .5) / shot.settings.size - 1) * half;
      const glm::dvec3 onPlane = centre + frame.right * u + frame.up * v;
      const glm::dvec3 eye =
          fov == 0 ? onPlane + frame.toward * (2 * radius) : centre + frame.toward * (radius / std::sin(fov / 2));
      glm::vec3 traced(0), baked(0);
      const bool hit = tracer.see(eye, glm::normalize(onPlane - eye), centre, cellHalfSide(index.depth()), traced);
      const bool covered = texelAt(image, x, y, baked);
      ++agreement.texels;
      agreement.covered += covered;
      agreement.coverageDiffers += hit != covered;
      const glm::vec3 d = glm::abs(traced - baked);
      agreement.colourDiffers += hit && covered && std::max({d.x, d.y, d.z}) > 1.5f;
    }
  }
}

TEST(ImageBaker, OrthographicAndPerspectiveImagesShowWhatRaysSee) {
  const uint32_t seed = 3;
  SCOPED_TRACE(seed);
  const Scene scene = sceneOf("soup", test::randomTriangles(seed, 500), UpAxis::z);
  const RayTracer tracer(scene);
  for (const int fovDeg : {0, 40, 60, 90}) {
    Agreement agreement;
    for (const int depth : {0, 1, 2}) {
      const CellIndex index(scene, depth);
      for (const glm::dvec3 direction : {glm::dvec3(.3, -.5, .81), glm::dvec3(-.9, .2, -.4), glm::dvec3(.1, .95, .3)})
        compare(index, tracer,
                {index.occupied()[index.occupied().size() / 2],
                 glm::normalize(direction),
                 {fovDeg * std::numbers::pi / 180, 64, 1}},
                agreement);
    }
    EXPECT_GT(agreement.covered, agreement.texels / 25) << fovDeg;
    // Edges of cut triangles lie elsewhere by a rounding; a random soup has many.
    EXPECT_LT(agreement.coverageDiffers, agreement.covered / 500) << fovDeg;
    EXPECT_LT(agreement.colourDiffers, agreement.covered / 200) << fovDeg;
  }
}

TEST(ImageBaker, WholeTrianglesAreCutToTheImageAndCoverWhatCutOnesDo) {
  const uint32_t seed = 4;
  SCOPED_TRACE(seed);
  const Scene scene = sceneOf("soup", test::randomTriangles(seed, 300), UpAxis::z);
  const CellIndex index(scene, 2);
  const glm::dvec3 direction = glm::normalize(glm::dvec3(.5, .4, .6));
  for (const double fovRad : {0.0, 1.0}) {
    ImageBaker baker({fovRad, 64, 1}, scene.sun);
    int covered = 0, lost = 0;
    for (const CellKey& key : index.occupied()) {
      const CellImage cut = baker.bake(index.content(key, Content::cube), direction);
      const CellImage whole = baker.bake(index.content(key, Content::sphere), direction);
      glm::vec3 colour;
      for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
          if (!texelAt(cut, x, y, colour)) continue;
          ++covered;
          lost += !texelAt(whole, x, y, colour);
        }
    }
    EXPECT_GT(covered, 1000);
    EXPECT_LE(lost, covered / 1000);
  }
}

}  // namespace
}  // namespace farcell::wscg
