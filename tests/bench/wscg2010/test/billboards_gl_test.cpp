#include <gtest/gtest.h>

#include <numbers>

#include "runtime/gl/context.h"
#include "tests/bench/wscg2010/measure/references.h"
#include "tests/bench/wscg2010/scene/cameras.h"
#include "tests/bench/wscg2010/test/samples.h"

namespace farcell::wscg {
namespace {

constexpr int kSize = 128;

class Billboards : public testing::Test {
 protected:
  void SetUp() override {
    auto context = GlContext::createHeadless();
    ASSERT_TRUE(context) << context.error().message;
    context_.emplace(std::move(*context));
    auto painter = Painter::create(kSize, kSize);
    ASSERT_TRUE(painter) << painter.error().message;
    painter_.emplace(std::move(*painter));
  }
  void TearDown() override {
    painter_.reset();
    context_.reset();
  }

  FrameImage drawImpostors(const CellIndex& index, const ImpostorSettings& settings, const Camera& camera) {
    const auto set = ImpostorSet::bake(index, settings, {&camera.position, 1});
    EXPECT_TRUE(set) << set.error().message;
    painter_->begin(camera);
    painter_->drawBillboards(set->seenFrom(camera.position), {Filter::nearest, Rim::alphaTest});
    return painter_->read();
  }
  Metrics compare(const Scene& scene, const CellIndex& index, const ImpostorSettings& settings, const Camera& camera) {
    const VertexBuffer triangles = uploadTriangles(scene.triangles, scene.sun);
    painter_->begin(camera);
    painter_->drawTriangles(triangles);
    const ReferenceImage reference = referenceOf(painter_->read());
    return measureFrame(reference, drawImpostors(index, settings, camera));
  }

  std::optional<GlContext> context_;
  std::optional<Painter> painter_;
};

// A camera in a baked direction of the single cell, whose picture has the image's axes.
Camera bakedCamera(int views, int view, double distance, double fovRad) {
  const auto viewpoints = Viewpoints::create(views);
  const ViewFrame frame = viewFrame(viewpoints->directions()[static_cast<size_t>(view)]);
  return {"", frame.toward * distance, glm::dvec3(0), frame.up, fovRad};
}

TEST_F(Billboards, APerspectiveImageSeenFromWhereItWasTakenIsTheTriangles) {
  const Scene scene = sceneOf("sphere", test::bumpySphere(4, 0.3f), UpAxis::z);
  const CellIndex index(scene, 0);
  for (const int fovDeg : {40, 60, 90}) {
    ImpostorSettings settings;
    settings.image.fovRad = fovDeg * std::numbers::pi / 180;
    settings.image.size = kSize;
    const double distance = std::sqrt(3.0) / std::sin(settings.image.fovRad / 2);
    const Camera camera = bakedCamera(settings.views, 17, distance, settings.image.fovRad);
    const Metrics metrics = compare(scene, index, settings, camera);
    EXPECT_GT(metrics.foregroundPixels, 1000u);
    EXPECT_LT(metrics.paperError, 3) << fovDeg;  // rims fall to the other side here and there; elsewhere 8 bits
    EXPECT_LT(metrics.holeRate, 0.002) << fovDeg;
  }
}

TEST_F(Billboards, AnOrthographicImageSeenFromItsDirectionFarAwayIsTheTriangles) {
  const Scene scene = sceneOf("sphere", test::bumpySphere(4, 0.3f), UpAxis::z);
  const CellIndex index(scene, 0);
  ImpostorSettings settings;
  settings.image.size = kSize;
  const double distance = 2000;
  const Camera camera = bakedCamera(settings.views, 17, distance, 2 * std::atan(std::sqrt(3.0) / distance));
  const Metrics metrics = compare(scene, index, settings, camera);
  EXPECT_GT(metrics.foregroundPixels, 1000u);
  EXPECT_LT(metrics.paperError, 3);
  EXPECT_LT(metrics.holeRate, 0.002);
  // From near, the same image is far off.
  EXPECT_GT(compare(scene, index, settings, bakedCamera(settings.views, 17, 2.5, 1.4)).paperError,
            4 * metrics.paperError);
}

TEST_F(Billboards, MoreImagesAndMoreCellsMeanLessError) {
  const Scene scene = sceneOf("sphere", test::bumpySphere(5, 0.3f), UpAxis::z);
  const Camera camera = orbitCamera(scene, levelDirections(scene, 1).front(), 0.5);
  const CellIndex index(scene, 2);
  double last = INFINITY;
  for (const int views : {20, 80, 320, 1280}) {
    ImpostorSettings settings;
    settings.views = views;
    const double error = compare(scene, index, settings, camera).paperError;
    EXPECT_LT(error, last) << views;
    last = error;
  }
  last = INFINITY;
  for (const int depth : {0, 1, 2, 3}) {
    const double error = compare(scene, CellIndex(scene, depth), ImpostorSettings{}, camera).paperError;
    EXPECT_LT(error, last) << depth;
    last = error;
  }
}

TEST_F(Billboards, GapsBetweenCutCellsCloseOnceCellsAreGrown) {
  const Scene scene = sceneOf("sphere", test::bumpySphere(5, 0.1f), UpAxis::z);
  const Camera camera = orbitCamera(scene, levelDirections(scene, 1).front(), 0.2);
  const CellIndex index(scene, 3);
  ImpostorSettings settings;
  settings.content = Content::cube;
  const double cut = compare(scene, index, settings, camera).holeRate;
  settings.content = Content::sphere;
  const double grown = compare(scene, index, settings, camera).holeRate;
  EXPECT_GT(cut, 0.001);
  EXPECT_LT(grown, cut / 5);
}

}  // namespace
}  // namespace farcell::wscg
