#include "preprocess/bake/view_baker.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include "cache/schema/viewpoints.h"
#include "preprocess/bake/settle.h"
#include "shaders/shared/shading.h"
#include "tests/preprocess/bake/sample_truth.h"

namespace farcell::test {
namespace {

const glm::dvec3 kAskew = glm::normalize(glm::dvec3(.48, -.6, .64));

BakeSettings settingsOf(int imageSize, int samples, bool relightable = false) {
  BakeSettings settings;
  settings.imageSize = imageSize;
  settings.samples = samples;
  settings.relightable = relightable;
  settings.sun = glm::normalize(glm::vec3(.3f, .4f, .8f));
  return settings;
}

// The soup with octahedral vertex normals that are not the faces' own.
CellSoup withVertexNormals(CellSoup soup) {
  for (size_t k = 0; k < 3; ++k)
    for (size_t i = 0; i < soup.size(); ++i)
      soup.normals[k].push_back(bake::packedOctahedral(glm::normalize(corner(soup, k, i) + glm::vec3(0, 0, .01f))));
  return soup;
}

void expectSame(const BakedPair& a, const BakedPair& b) {
  EXPECT_TRUE(sameView(a.view, b.view));
  EXPECT_TRUE(sameView(a.antipode, b.antipode));
}

// A rectangle in the image plane of the view along +z: u in [u0, u1], v in [v0, v1], at height w.
void addFacing(CellSoup& soup, const ViewFrame& frame, double u0, double v0, double u1, double v1, double w,
               uint32_t colour) {
  const glm::vec3 origin(frame.right * u0 + frame.up * v0 + frame.toward * w);
  addRectangle(soup, origin, glm::vec3(frame.right * (u1 - u0)), glm::vec3(frame.up * (v1 - v0)), colour);
}

TEST(ViewBakerColour, ASquareThatFacesTheSunHasItsAlbedo) {
  CellSoup soup;
  const ViewFrame frame = viewFrame(glm::dvec3(0, 0, 1));
  addFacing(soup, frame, -.5, -.5, .5, .5, .25, 0x336699);
  for (const int samples : {1, 4, 16, 64}) {
    BakeSettings settings = settingsOf(32, samples);
    settings.sun = glm::vec3(0, 0, 1);
    const BakedPair pair = bake(soup, frame, settings);
    for (const BakedView* view : {&pair.view, &pair.antipode}) {  // both faces are lit alike
      const auto rgba = rgbaAt(*view, 16, 16);
      EXPECT_FLOAT_EQ(rgba[0], 0x99 / 255.0f);
      EXPECT_FLOAT_EQ(rgba[1], 0x66 / 255.0f);
      EXPECT_FLOAT_EQ(rgba[2], 0x33 / 255.0f);
      EXPECT_EQ(rgba[3], 1);
    }
    EXPECT_FLOAT_EQ(depthAt(pair.view, 16, 16), .25f);
    EXPECT_FLOAT_EQ(depthAt(pair.antipode, 16, 16), -.25f);
  }
}

TEST(ViewBakerColour, LightFallsWithTheCosineOfTheSunsAngle) {
  CellSoup soup;
  const ViewFrame frame = viewFrame(glm::dvec3(0, 0, 1));
  addFacing(soup, frame, -.5, -.5, .5, .5, 0, 0xffffff);
  BakeSettings settings = settingsOf(32, 4);
  settings.sun = glm::vec3(std::sqrt(.75f), 0, .5f);
  EXPECT_NEAR(rgbaAt(bake(soup, frame, settings).view, 16, 16)[0], .25f + .75f * .5f, .51 / 1020);
  settings.sun = glm::vec3(1, 0, 0);
  EXPECT_NEAR(rgbaAt(bake(soup, frame, settings).view, 16, 16)[0], .25f, .51 / 1020);
}

// Small and large triangles, each alone in the image, against shading.h in every covered texel.
void expectShadedLikeShadingH(const CellSoup& soup, bool vertexNormals) {
  const BakeSettings settings = settingsOf(64, 1);
  const ViewFrame frame = viewFrame(kAskew);
  int compared = 0;
  for (size_t i = 0; i < soup.size(); ++i) {
    const BakedView view = bake(part(soup, i, i + 1), frame, settings).view;
    const ProjectedTriangle t(soup, i, frame);
    const glm::dvec3 e1 = t.p[1] - t.p[0], e2 = t.p[2] - t.p[0];
    const double area = e1.x * e2.y - e2.x * e1.y;
    const double longest = std::max(std::hypot(e1.x, e1.y), std::hypot(e2.x, e2.y));
    if (std::abs(area) < 1e-3 * longest * longest) continue;  // weights of slivers are not known to a colour level
    const glm::vec3 a = corner(soup, 0, i), b = corner(soup, 1, i), c = corner(soup, 2, i);
    for (int y = view.y0; y < view.y0 + view.height; ++y) {
      for (int x = view.x0; x < view.x0 + view.width; ++x) {
        const auto rgba = rgbaAt(view, x, y);
        if (rgba[3] == 0) continue;
        const double qx = texelCentre(x, 64) - t.p[0].x, qy = texelCentre(y, 64) - t.p[0].y;
        const double l1 = (qx * e2.y - e2.x * qy) / area, l2 = (e1.x * qy - qx * e1.y) / area, l0 = 1 - l1 - l2;
        const double weights[3] = {l0, l1, l2};
        glm::vec3 albedo(0), normal(0);
        for (size_t k = 0; k < 3; ++k) {
          const uint32_t colour = soup.colours[k][i];
          albedo += glm::vec3(glm::dvec3(colour & 0xff, colour >> 8 & 0xff, colour >> 16 & 0xff) * (weights[k] / 255));
          if (vertexNormals) normal += bake::unitFromPacked(soup.normals[k][i]) * float(weights[k]);
        }
        if (!vertexNormals) normal = glm::vec3(glm::cross(glm::dvec3(b - a), glm::dvec3(c - a)));
        const glm::vec3 expected = shared::shade(albedo, glm::normalize(normal), settings.sun);
        for (int channel = 0; channel < 3; ++channel) EXPECT_NEAR(rgba[size_t(channel)], expected[channel], .001);
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 1000);
}

TEST(ViewBakerColour, FlatTrianglesOfEverySizeAreShadedLikeShadingH) {
  SCOPED_TRACE("seed 5");
  expectShadedLikeShadingH(randomSoup(5, 300), false);
}

TEST(ViewBakerColour, VertexNormalsAreInterpolatedAndShadedLikeShadingH) {
  SCOPED_TRACE("seed 6");
  expectShadedLikeShadingH(withVertexNormals(randomSoup(6, 300)), true);
}

TEST(ViewBakerNormals, TheBakedNormalIsTheFacesOwnOnTheViewersSide) {
  CellSoup soup;
  const glm::vec3 normal = glm::normalize(glm::vec3(.2f, -.3f, .9f));
  const glm::vec3 a = glm::normalize(glm::cross(normal, glm::vec3(0, 1, 0))), b = glm::cross(normal, a);
  addRectangle(soup, -.4f * (a + b), .8f * a, .8f * b, 0xffffff);
  const BakedPair pair = bake(soup, viewFrame(glm::dvec3(0, 0, 1)), settingsOf(32, 16, true));
  for (const auto& [view, sign] : {std::pair{&pair.view, 1.0f}, std::pair{&pair.antipode, -1.0f}}) {
    ASSERT_EQ(view->normal.size(), 3 * view->depth.size());
    const size_t at = 3 * (view->depth.size() / 2 + size_t(view->width) / 2);
    const glm::vec3 baked(view->normal[at], view->normal[at + 1], view->normal[at + 2]);
    EXPECT_LT(glm::length(baked - sign * normal), 1e-4);
  }
}

TEST(ViewBakerNormals, ColourIsAlbedoWhateverTheSun) {
  const ViewFrame frame = viewFrame(kAskew);
  CellSoup soup;
  addFacing(soup, frame, -.5, -.5, .5, .5, .25, 0x336699);  // large: of a colour plane
  BakeSettings settings = settingsOf(32, 16, true);
  settings.sun = glm::vec3(kAskew);
  const BakedPair one = bake(soup, frame, settings);
  settings.sun = glm::vec3(1, 0, 0);
  expectSame(bake(soup, frame, settings), one);
  const auto rgba = rgbaAt(one.view, 16, 16);
  EXPECT_FLOAT_EQ(rgba[0], 0x99 / 255.0f);
  EXPECT_FLOAT_EQ(rgba[1], 0x66 / 255.0f);
  EXPECT_FLOAT_EQ(rgba[2], 0x33 / 255.0f);
}

// A roof's two sides, each in half of a texel's samples.
TEST(ViewBakerNormals, ATexelHasTheMeanVectorOfItsSamples) {
  const ViewFrame frame = viewFrame(kAskew);
  const glm::vec3 right(frame.right), up(frame.up), toward(frame.toward);
  const glm::vec3 ridge =
      right * static_cast<float>(texelSize(32) / 2) - up * .4f + toward * .3f;  // the middle of a texel
  CellSoup soup;
  addRectangle(soup, ridge, .2f * (right - toward), .8f * up, 0xffffff);
  addRectangle(soup, ridge, .2f * (-right - toward), .8f * up, 0xffffff);
  const BakedPair pair = bake(soup, frame, settingsOf(32, 16, true));
  const size_t at = 3 * (size_t(16 - pair.view.y0) * size_t(pair.view.width) + size_t(16 - pair.view.x0));
  const glm::vec3 mean(pair.view.normal[at], pair.view.normal[at + 1], pair.view.normal[at + 2]);
  EXPECT_LT(glm::length(mean - toward * std::sqrt(.5f)), 1e-3) << mean.x << ' ' << mean.y << ' ' << mean.z;
}

TEST(ViewBakerCoverage, ATexelCoveredByHalfHasHalfItsColourAndHalfCoverage) {
  const ViewFrame frame = viewFrame(glm::dvec3(0, 0, 1));
  const double texel = texelSize(32);
  CellSoup soup;
  addFacing(soup, frame, 0, 0, 2.5 * texel, 2 * texel, 0,
            0xffffff);  // from the image's centre: texels 16, 17, half of 18
  BakeSettings settings = settingsOf(32, 16);
  settings.sun = glm::vec3(0, 0, 1);
  const BakedView view = bake(soup, frame, settings).view;
  EXPECT_EQ(view.x0, 16);
  EXPECT_EQ(view.y0, 16);
  EXPECT_EQ(view.width, 3);
  EXPECT_EQ(view.height, 2);
  for (const float value : rgbaAt(view, 18, 16)) EXPECT_FLOAT_EQ(value, .5f);
  for (const float value : rgbaAt(view, 17, 17)) EXPECT_FLOAT_EQ(value, 1);
}

TEST(ViewBakerCoverage, SixteenSamplesAreTheTexelsOfAnImageFourTimesAsLarge) {
  SCOPED_TRACE("seed 8");
  const CellSoup soup = randomSoup(8, 500);
  const BakedView coarse = bake(soup, viewFrame(kAskew), settingsOf(40, 16)).view;
  const BakedView fine = bake(soup, viewFrame(kAskew), settingsOf(160, 1)).view;
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      std::array<float, 4> sum{};
      for (int i = 0; i < 16; ++i)
        for (size_t channel = 0; channel < 4; ++channel)
          sum[channel] += rgbaAt(fine, 4 * x + i % 4, 4 * y + i / 4)[channel] / 16;
      for (size_t channel = 0; channel < 4; ++channel)
        ASSERT_NEAR(rgbaAt(coarse, x, y)[channel], sum[channel], 1e-6) << x << ", " << y;
    }
  }
}

TEST(ViewBakerDepth, OnlySamplesNearTheFrontOneCount) {
  const ViewFrame frame = viewFrame(glm::dvec3(0, 0, 1));
  const double texel = texelSize(32);
  CellSoup soup;
  addFacing(soup, frame, 0, 0, texel / 4, texel, .5, 0xffffff);                    // a quarter of texel (16, 16)
  addFacing(soup, frame, 0, 0, texel, texel, .5 - 2.5 * texel, 0xffffff);          // near: counts
  addFacing(soup, frame, texel, 0, 1.25 * texel, texel, .5, 0xffffff);             // a quarter of texel (17, 16)
  addFacing(soup, frame, texel, 0, 2 * texel, texel, .5 - 3.5 * texel, 0xffffff);  // too far below
  const BakedView view = bake(soup, frame, settingsOf(32, 16)).view;
  EXPECT_NEAR(depthAt(view, 16, 16), .5 - .75 * 2.5 * texel, 1e-6);
  EXPECT_NEAR(depthAt(view, 17, 16), .5, 1e-6);
}

TEST(ViewBakerAntipode, IsTheViewBakedFromTheOtherSideBitForBit) {
  SCOPED_TRACE("seed 21");
  const CellSoup flat = randomSoup(21, 800), smooth = withVertexNormals(flat);
  const auto viewpoints = Viewpoints::create(42);
  for (const int samples : {1, 4, 16, 64}) {
    for (const bool relightable : {false, true}) {
      const BakeSettings settings = settingsOf(33, samples, relightable);
      for (size_t i = 0; i < 42; i += 9) {
        const glm::dvec3 direction = viewpoints->directions()[i];
        for (const CellSoup* soup : {&flat, &smooth}) {
          const BakedPair there = bake(*soup, viewFrame(direction), settings);
          const BakedPair back = bake(*soup, viewFrame(-direction), settings);
          ASSERT_GT(there.view.width, 10);
          expectSame(there, {back.antipode, back.view});
        }
      }
    }
  }
}

TEST(ViewBakerChunks, MakeNoDifferenceToAnyBit) {
  SCOPED_TRACE("seed 31");
  CellSoup soup = randomSoup(31, 1000);
  for (size_t i = 0; i < 100; ++i)  // the same surfaces again in other colours: depths are equal
    addTriangle(soup, corner(soup, 0, 5 * i), corner(soup, 1, 5 * i), corner(soup, 2, 5 * i), 0x123456);
  for (const bool vertexNormals : {false, true}) {
    const CellSoup whole = vertexNormals ? withVertexNormals(soup) : soup;
    const BakeSettings settings = settingsOf(48, 16, vertexNormals);
    const ViewFrame frame = viewFrame(kAskew);
    const BakedPair expected = bake(whole, frame, settings);
    for (const size_t size : {1u, 7u, 100u, 640u}) {
      SCOPED_TRACE(size);
      ViewBaker baker(settings);
      baker.begin(frame);
      for (size_t begin = 0; begin < whole.size(); begin += size)
        baker.add(part(whole, begin, std::min(begin + size, whole.size())));
      BakedPair pair;
      baker.finish(pair.view, pair.antipode);
      expectSame(pair, expected);
    }
  }
}

TEST(ViewBakerChunks, OfTwoEqualSurfacesTheOneAddedFirstIsSeenFromBothSides) {
  const ViewFrame frame = viewFrame(glm::dvec3(0, 0, 1));
  CellSoup soup;
  addFacing(soup, frame, -.5, -.5, .5, .5, 0, 0x0000ff);
  addFacing(soup, frame, -.5, -.5, .5, .5, 0, 0x00ff00);
  const BakedPair pair = bake(soup, frame, settingsOf(16, 4));
  for (const BakedView* view : {&pair.view, &pair.antipode}) {
    EXPECT_GT(rgbaAt(*view, 8, 8)[0], .2f);
    EXPECT_EQ(rgbaAt(*view, 8, 8)[1], 0);
  }
}

TEST(ViewBakerReuse, LeavesNothingBehindFinishedOrNot) {
  SCOPED_TRACE("seed 41");
  const CellSoup first = randomSoup(41, 300), second = sphereSoup(2, .3f);
  const BakeSettings settings = settingsOf(40, 16);
  const BakedPair expected = bake(second, viewFrame(kAskew), settings);
  ViewBaker baker(settings);
  BakedPair pair;
  baker.begin(viewFrame(glm::dvec3(1, 0, 0)));
  baker.add(first);
  baker.finish(pair.view, pair.antipode);
  baker.begin(viewFrame(glm::dvec3(0, 1, 0)));
  baker.add(first);  // given up
  baker.begin(viewFrame(kAskew));
  baker.add(second);
  baker.finish(pair.view, pair.antipode);
  expectSame(pair, expected);
}

TEST(ViewBakerEmpty, NothingAndSurfacesSeenEdgeOnGiveAnEmptyView) {
  CellSoup soup;
  const BakeSettings settings = settingsOf(64, 16);
  EXPECT_EQ(bake(soup, viewFrame(kAskew), settings).view.width, 0);
  addRectangle(soup, glm::vec3(-.5f, -.5f, .1f), glm::vec3(1, .3f, 0), glm::vec3(0, 0, .5f), 0xffffff);  // upright
  addTriangle(soup, glm::vec3(.1f), glm::vec3(.1f), glm::vec3(.2f));                                     // a line
  addTriangle(soup, glm::vec3(.1f), glm::vec3(.1f), glm::vec3(.1f));                                     // a point
  const BakedPair pair = bake(soup, viewFrame(glm::dvec3(0, 0, 1)), settings);
  EXPECT_EQ(pair.view.width, 0);
  EXPECT_EQ(pair.antipode.width, 0);
  EXPECT_TRUE(pair.view.rgba.empty());
}

TEST(ViewBakerExtent, TheWholeGrownCubeIsInEveryView) {
  CellSoup soup;
  const auto g = static_cast<float>(kCellGrowth);
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-g, g}) {
      glm::vec3 origin(-g), a(0), b(0);
      origin[axis] = side;
      a[(axis + 1) % 3] = 2 * g;
      b[(axis + 2) % 3] = 2 * g;
      addRectangle(soup, origin, a, b, 0xffffff);
    }
  }
  const auto viewpoints = Viewpoints::create(80);  // face centres: corners of the cube point at the image's edges
  for (size_t i = 0; i < 80; i += 6) {
    const glm::dvec3 direction = viewpoints->directions()[i];
    const BakedView view = bake(soup, viewFrame(direction), settingsOf(64, 64)).view;
    double area = 0, expected = 0;
    for (size_t alpha = 3; alpha < view.rgba.size(); alpha += 4)
      area += view.rgba[alpha] * texelSize(64) * texelSize(64);
    for (int axis = 0; axis < 3; ++axis) expected += 4 * kCellGrowth * kCellGrowth * std::abs(direction[axis]);
    EXPECT_NEAR(area, expected, .005 * expected);  // of 512 samples along an edge, half a one is missed at each end
  }
}

TEST(ViewBakerTargets, EveryInstructionSetGivesTheSameBits) {
  SCOPED_TRACE("seed 51");
  CellSoup flat = randomSoup(51, 800);
  const CellSoup sphere = sphereSoup(4, .9f);
  for (size_t i = 0; i < sphere.size(); ++i)
    addTriangle(flat, corner(sphere, 0, i), corner(sphere, 1, i), corner(sphere, 2, i), uint32_t(i * 977) & 0xffffff);
  const CellSoup smooth = withVertexNormals(flat);
  std::vector<BakedPair> expected;
  const std::vector<int64_t> targets = hwy::SupportedAndGeneratedTargets();
  ASSERT_GE(targets.size(), 2u);
  for (const int64_t target : targets) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    ASSERT_EQ(hwy::SupportedTargets(), target);
    std::vector<BakedPair> pairs;
    for (const int samples : {1, 4, 16, 64})
      for (const CellSoup* soup : std::initializer_list<const CellSoup*>{&flat, &smooth})
        for (const glm::dvec3& direction : {kAskew, glm::dvec3(0, 1, 0)})
          pairs.push_back(
              bake(*soup, viewFrame(direction), settingsOf(samples == 64 ? 17 : 45, samples, samples == 4)));
    hwy::SetSupportedTargetsForTest(0);
    if (expected.empty()) expected = pairs;
    for (size_t i = 0; i < pairs.size(); ++i) expectSame(pairs[i], expected[i]);
    std::printf("%s: %zu pairs\n", hwy::TargetName(target), pairs.size());
  }
}

}  // namespace
}  // namespace farcell::test
