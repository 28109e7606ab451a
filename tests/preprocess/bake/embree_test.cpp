// The baker against Embree in robust mode and against exact arithmetic.
#include <embree3/rtcore.h>
#include <gtest/gtest.h>

#include "cache/schema/viewpoints.h"
#include "tests/preprocess/bake/sample_truth.h"

namespace farcell::test {
namespace {

class RayTracer {
 public:
  explicit RayTracer(const CellSoup& soup) : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                 3 * sizeof(float), 3 * soup.size()));
    auto* indices = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                   3 * sizeof(uint32_t), soup.size()));
    for (size_t i = 0; i < 3 * soup.size(); ++i) {
      const glm::vec3 p = corner(soup, i % 3, i / 3);
      vertices[3 * i] = p.x;
      vertices[3 * i + 1] = p.y;
      vertices[3 * i + 2] = p.z;
      indices[i] = static_cast<uint32_t>(i);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~RayTracer() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  RayTracer(const RayTracer&) = delete;
  RayTracer& operator=(const RayTracer&) = delete;

  // w of the nearest hit, kNothing if there is none
  float nearest(const ViewFrame& frame, double u, double v) const {
    constexpr double kStartW = 2;  // outside of every grown cube
    const glm::vec3 origin(frame.right * u + frame.up * v + frame.toward * kStartW);
    const glm::vec3 direction(-frame.toward);
    RTCRayHit hit{};
    hit.ray.org_x = origin.x;
    hit.ray.org_y = origin.y;
    hit.ray.org_z = origin.z;
    hit.ray.dir_x = direction.x;
    hit.ray.dir_y = direction.y;
    hit.ray.dir_z = direction.z;
    hit.ray.tfar = std::numeric_limits<float>::infinity();
    hit.ray.mask = 0xffffffffu;
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene_, &context, &hit);
    if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return kNothing;
    return static_cast<float>(kStartW - double{hit.ray.tfar});
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

struct Agreement {
  int64_t samples = 0, hits = 0;
  int64_t coverageDiffers = 0, depthDiffers = 0;
  int64_t unexplained = 0;  // of those, samples whose baked value exact arithmetic does not allow
};

constexpr int64_t kEnoughFailures = 20;  // each costs a look at every triangle

// Every sample of the view at one sample a texel.
void compareView(const CellSoup& soup, const RayTracer& tracer, const ViewFrame& frame, const BakedView& view,
                 int imageSize, Agreement& agreement) {
  for (int y = 0; y < imageSize; ++y) {
    for (int x = 0; x < imageSize; ++x) {
      const double u = texelCentre(x, imageSize), v = texelCentre(y, imageSize);
      const float baked = depthAt(view, x, y), traced = tracer.nearest(frame, u, v);
      ++agreement.samples;
      agreement.hits += baked != kNothing;
      const bool coverage = (baked == kNothing) == (traced == kNothing);
      if (agreement.unexplained > kEnoughFailures) return;
      if (coverage && (baked == traced || std::abs(baked - traced) <= kDepthTolerance)) continue;
      ++(coverage ? agreement.depthDiffers : agreement.coverageDiffers);
      if (truthAllows(soup, frame, u, v, baked)) continue;
      if (++agreement.unexplained <= 5)
        ADD_FAILURE() << "texel " << x << ", " << y << ": baked " << baked << ", traced " << traced;
    }
  }
}

std::vector<glm::dvec3> directions() {
  const auto viewpoints = Viewpoints::create(42);
  std::vector<glm::dvec3> result;
  for (int view = 0; view < viewpoints->count(); ++view)
    if (view < viewpoints->antipode(view)) result.push_back(viewpoints->directions()[size_t(view)]);
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 direction(0);
    direction[axis] = 1;
    result.push_back(direction);
  }
  return result;
}

Agreement compareAll(const CellSoup& soup, int imageSize, size_t everyDirection = 1) {
  const RayTracer tracer(soup);
  Agreement agreement;
  BakeSettings settings;
  settings.imageSize = imageSize;
  settings.samples = 1;
  const auto all = directions();
  for (size_t i = 0; i < all.size(); i += everyDirection) {
    const ViewFrame frame = viewFrame(all[i]), opposite = viewFrame(-all[i]);
    const BakedPair pair = bake(soup, frame, settings);
    compareView(soup, tracer, frame, pair.view, imageSize, agreement);
    compareView(soup, tracer, opposite, pair.antipode, imageSize, agreement);
  }
  return agreement;
}

void report(const char* name, const Agreement& a) {
  std::printf("%s: %lld samples, %lld hit; differ in coverage %lld, in depth %lld; unexplained %lld\n", name,
              static_cast<long long>(a.samples), static_cast<long long>(a.hits),
              static_cast<long long>(a.coverageDiffers), static_cast<long long>(a.depthDiffers),
              static_cast<long long>(a.unexplained));
}

TEST(BakerAgainstEmbree, AStatueIsTheSameFromEveryDirectionBothWays) {
  const auto soup = meshSoup(FARCELL_SOURCE_DIR "/../shared/datasets/nefertiti.obj");
  if (!soup) GTEST_SKIP() << "datasets/nefertiti.obj is not here";
  const Agreement agreement = compareAll(*soup, 128);
  report("statue", agreement);
  EXPECT_GT(agreement.hits, agreement.samples / 20);
  EXPECT_EQ(agreement.unexplained, 0);
  EXPECT_LE(agreement.coverageDiffers, agreement.hits / 10000);
}

TEST(BakerAgainstEmbree, SoupsOfAllSizesWithSliversAreTheSame) {
  for (const uint32_t seed : {1u, 2u, 3u}) {
    SCOPED_TRACE(seed);
    const Agreement agreement = compareAll(randomSoup(seed, 300), 64);
    report("soup", agreement);
    EXPECT_GT(agreement.hits, agreement.samples / 20);
    EXPECT_EQ(agreement.unexplained, 0);
    EXPECT_LE(agreement.coverageDiffers, agreement.hits / 1000);
  }
}

TEST(BakerAgainstExactArithmetic, EverySampleOfASoupIsAllowed) {
  for (const uint32_t seed : {11u, 12u}) {
    SCOPED_TRACE(seed);
    const CellSoup soup = randomSoup(seed, 200);
    BakeSettings settings;
    settings.imageSize = 128;
    settings.samples = 1;
    int wrong = 0;
    for (const glm::dvec3& direction : directions()) {
      const ViewFrame frame = viewFrame(direction);
      const BakedView view = bake(soup, frame, settings).view;
      for (int y = 0; y < 128; y += 5) {
        for (int x = 0; x < 128; x += 3) {
          const double u = texelCentre(x, 128), v = texelCentre(y, 128);
          wrong += !truthAllows(soup, frame, u, v, depthAt(view, x, y));
        }
      }
    }
    EXPECT_EQ(wrong, 0);
  }
}

}  // namespace
}  // namespace farcell::test
