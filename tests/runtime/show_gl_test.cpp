#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <set>

#include "cache/schema/view_frame.h"
#include "tests/runtime/renderer_fixture.h"

namespace farcell {
namespace {

using Pixel = std::array<int, 4>;

constexpr int kWidth = 200;
constexpr int kHeight = 150;
constexpr std::array kShows = {Show::picture, Show::cells, Show::billboards, Show::levels,
                               Show::kinds,   Show::error, Show::depth,      Show::normals};
constexpr std::array kKinds = {ImpostorKind::flat, ImpostorKind::depthCorrected, ImpostorKind::blended};

RenderSettings showing(Show show, RenderMode mode, ImpostorKind kind = ImpostorKind::depthCorrected, int samples = 1) {
  RenderSettings settings = sized(kWidth, kHeight, mode, samples, kind);
  settings.show = show;
  settings.handOver = false;  // what is shown instead of the picture has none
  return settings;
}

Pixel pixelAt(const FrameImage& image, int x, int y) {
  Pixel pixel{};
  for (size_t i = 0; i < 4; ++i) pixel[i] = image.rgba[static_cast<size_t>((y * image.width + x) * 4) + i];
  return pixel;
}

// Where a point of the world lies in the picture, pixels from its upper left corner; z: depth along the view axis.
glm::dvec3 projected(const Camera& camera, glm::dvec3 point) {
  const CameraAxes axes = cameraAxes(camera);
  const glm::dvec3 v = point - camera.position;
  const double depth = -glm::dot(v, axes.back);
  const double pixels = kHeight / (2 * std::tan(camera.fovYRad / 2)) / depth;
  return {kWidth / 2.0 + glm::dot(v, axes.right) * pixels, kHeight / 2.0 - glm::dot(v, axes.up) * pixels, depth};
}

// Largest channel 1: what is left of a colour whatever its brightness.
glm::dvec3 hueOf(const std::array<uint8_t, 3>& c) {
  return glm::dvec3(c[0], c[1], c[2]) / static_cast<double>(std::max({c[0], c[1], c[2]}));
}

bool isOfLegend(const Pixel& pixel, const std::vector<LegendEntry>& legend) {
  const double brightest = std::max({pixel[0], pixel[1], pixel[2], 1});
  for (const LegendEntry& entry : legend)
    if (glm::length(glm::dvec3(pixel[0], pixel[1], pixel[2]) / brightest - hueOf(entry.colour)) < 0.03) return true;
  return false;
}

std::vector<SyntheticTriangle> ballOnATable() {
  auto scene = sphereTriangles({0, 0, 0}, 1, 3, 0x0040c0ff);
  for (const auto& triangle : boxTriangles({-2, -2, -1.5}, {2, 2, -1}, 0x0030a040)) scene.push_back(triangle);
  return scene;
}

DrawnPack openScene(Lighting lighting = Lighting::baked) {
  return openDrawn(ballOnATable(), {.level = 2, .imageSize = 32, .samplesPerEdge = 2, .lighting = lighting});
}

const Camera kCamera = lookAt({9, 5, 4}, {0, 0, -0.3}, 0.5);

// Some cells triangles, some impostors.
RenderSettings mixed(Show show, ImpostorKind kind, const DrawnPack& drawn) {
  RenderSettings settings = showing(show, RenderMode::automatic, kind);
  settings.selection.texelPixels = 0.01;
  settings.selection.triangleBudget = drawn.pack->directory().cells[0].triangles / 2;
  return settings;
}

TEST(Show, whateverIsShownTheSameSurfacesAreThere) {
  DrawnPack drawn = openScene();
  for (const ImpostorKind kind : kKinds)
    for (const RenderMode mode :
         {RenderMode::automatic, RenderMode::impostors, RenderMode::triangles, RenderMode::full}) {
      FrameImage picture, shown;
      EXPECT_TRUE(drawn.draw(kCamera, showing(Show::picture, mode, kind, 4), picture).legend.empty());
      for (const Show show : kShows) {
        SCOPED_TRACE(fmt::format("show {} mode {}", static_cast<int>(show), static_cast<int>(mode)));
        const FrameStats stats = drawn.draw(kCamera, showing(show, mode, kind, 4), shown);
        EXPECT_EQ(stats.legend.empty(), show == Show::picture);
        if (show == Show::cells || show == Show::billboards) continue;  // lines lie beside surfaces too
        for (size_t i = 3; i < shown.rgba.size(); i += 4) ASSERT_NEAR(shown.rgba[i], picture.rgba[i], 1);
      }
      // And the picture is what it was.
      drawn.draw(kCamera, showing(Show::picture, mode, kind, 4), shown);
      EXPECT_EQ(shown.rgba, picture.rgba);
    }
}

TEST(Show, kindsAndLevelsHaveNoColoursButThoseOfTheLegend) {
  DrawnPack drawn = openScene();
  for (const ImpostorKind kind : kKinds)
    for (const Show show : {Show::kinds, Show::levels, Show::error}) {
      const RenderSettings settings =
          show == Show::levels ? showing(show, RenderMode::impostors, kind) : mixed(show, kind, drawn);
      FrameImage image;
      const FrameStats stats = drawn.draw(kCamera, settings, image);
      if (show != Show::levels) {
        EXPECT_GT(stats.triangles, 0u);
        EXPECT_GT(stats.impostors, 0u);
      }
      if (show == Show::error) continue;  // a scale: colours between its marks too
      int whole = 0, mixed = 0;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          const Pixel pixel = pixelAt(image, x, y);
          // Where one impostor's edge lies over another surface, two colours mix.
          const bool beside = x == 0 || y == 0 || x + 1 == kWidth || y + 1 == kHeight;
          if (pixel[3] < 255 || beside) continue;
          bool inside = true;
          for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
            const Pixel next = pixelAt(image, x + dx, y + dy);
            inside = inside && next[3] == 255 && isOfLegend(next, stats.legend);
          }
          if (!inside) continue;
          ++whole;
          mixed += isOfLegend(pixel, stats.legend) ? 0 : 1;
        }
      EXPECT_GT(whole, 1'000);
      EXPECT_LE(mixed, whole / 400);  // a corner of an impostor may mix in one pixel alone
    }
}

TEST(Show, trianglesAndImpostorsHaveTheirOwnColour) {
  DrawnPack drawn = openScene();
  for (const ImpostorKind kind : kKinds)
    for (const RenderMode mode : {RenderMode::triangles, RenderMode::impostors}) {
      FrameImage image;
      const FrameStats stats = drawn.draw(kCamera, showing(Show::kinds, mode, kind), image);
      ASSERT_EQ(stats.legend.size(), 3u);
      const LegendEntry& expected = stats.legend[mode == RenderMode::triangles ? 0 : 2];
      const glm::dvec3 p = projected(kCamera, {0.4, 0.4, 0.7});
      EXPECT_TRUE(isOfLegend(pixelAt(image, static_cast<int>(p.x), static_cast<int>(p.y)), {expected}))
          << expected.meaning;
    }
}

TEST(Show, depthIsTheDistanceAlongTheViewAxis) {
  // Two boxes, the second beside the first and farther away; both faces are seen head on.
  auto scene = boxTriangles({-1, -2, -1}, {1, 0, 1}, 0x00ffffff);
  for (const auto& triangle : boxTriangles({-7, 0.5, -1}, {-5, 2.5, 1}, 0x00ffffff)) scene.push_back(triangle);
  DrawnPack drawn = openDrawn(scene, {.level = 2, .imageSize = 64, .samplesPerEdge = 2});
  const Camera camera = lookAt({14, 0, 0}, {0, 0, 0}, 0.5);
  for (const RenderMode mode : {RenderMode::triangles, RenderMode::impostors}) {
    FrameImage image;
    const FrameStats stats = drawn.draw(camera, showing(Show::depth, mode), image);
    ASSERT_EQ(stats.legend.size(), 5u);
    // From the near face of the first box to the far one of the second: 13 to 21.
    EXPECT_EQ(stats.legend.front().meaning.substr(0, 2), "13");
    EXPECT_EQ(stats.legend.back().meaning.substr(0, 2), "21");
    for (const glm::dvec3 point : {glm::dvec3(1, -1, 0.2), glm::dvec3(-5, 1.5, -0.3), glm::dvec3(-5, 2, 0.5)}) {
      const glm::dvec3 p = projected(camera, point);
      const double expected = 255 * (1 - std::log2(p.z / 13) / std::log2(21.0 / 13));
      const Pixel pixel = pixelAt(image, static_cast<int>(p.x), static_cast<int>(p.y));
      for (size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(pixel[i], expected, mode == RenderMode::triangles ? 1.5 : 4) << "depth " << p.z;
    }
  }
}

TEST(Show, aBillboardHasTheDepthOfItsPlane) {
  DrawnPack drawn = openDrawn(boxTriangles({-1, -1, -1}, {1, 1, 1}, 0x00ffffff), {.level = 0, .imageSize = 64});
  const Camera camera = lookAt({14, 0, 0}, {0, 0, 0}, 0.3);
  FrameImage image;
  drawn.draw(camera, showing(Show::depth, RenderMode::impostors, ImpostorKind::flat), image);
  const double expected = 255 * (1 - std::log2(14.0 / 13) / std::log2(15.0 / 13));
  EXPECT_NEAR(pixelAt(image, kWidth / 2, kHeight / 2)[0], expected, 3);
}

// Mean difference of the ball's normals from those of a sphere, in steps of a byte.
double normalError(DrawnPack& drawn, RenderMode mode, ImpostorKind kind) {
  FrameImage image;
  drawn.draw(kCamera, showing(Show::normals, mode, kind), image);
  double sum = 0;
  int count = 0;
  for (double azimuth = -1; azimuth < 1.5; azimuth += 0.1)
    for (double height = -0.1; height < 0.8; height += 0.1) {
      const double r = std::sqrt(1 - height * height);
      const glm::dvec3 normal(r * std::cos(azimuth), r * std::sin(azimuth), height);
      if (glm::dot(normal, glm::normalize(kCamera.position - normal)) < 0.5) continue;
      const glm::dvec3 p = projected(kCamera, normal);
      const Pixel pixel = pixelAt(image, static_cast<int>(p.x), static_cast<int>(p.y));
      sum += glm::length(glm::dvec3(pixel[0], pixel[1], pixel[2]) - (normal * 0.5 + 0.5) * 255.0);
      ++count;
    }
  EXPECT_GT(count, 50);
  return sum / count;
}

TEST(Show, normalsAreThoseOfTheSurface) {
  DrawnPack drawn = openScene();
  DrawnPack baked = openScene(Lighting::relightable);
  // Facets of a sphere of 512 faces differ from it by some degrees.
  EXPECT_LT(normalError(drawn, RenderMode::triangles, ImpostorKind::depthCorrected), 15);
  const double derived = normalError(drawn, RenderMode::impostors, ImpostorKind::depthCorrected);
  const double stored = normalError(baked, RenderMode::impostors, ImpostorKind::depthCorrected);
  EXPECT_LT(derived, 40);
  EXPECT_LT(stored, 18);
  EXPECT_LT(stored, derived);
  EXPECT_LT(normalError(baked, RenderMode::impostors, ImpostorKind::flat), 30);
}

TEST(Show, aFaceTowardsTheEyeHasTheColourOfItsAxis) {
  DrawnPack drawn = openDrawn(boxTriangles({-1, -1, -1}, {1, 1, 1}, 0x00ffffff),
                              {.level = 1, .imageSize = 32, .lighting = Lighting::relightable});
  for (const glm::dvec3 axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1)})
    for (const RenderMode mode : {RenderMode::triangles, RenderMode::impostors}) {
      FrameImage image;
      drawn.draw(lookAt(axis * 30.0, {0, 0, 0}, 0.12), showing(Show::normals, mode), image);
      const Pixel pixel = pixelAt(image, kWidth / 2 + 9, kHeight / 2 + 7);
      for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(pixel[static_cast<size_t>(i)], (axis[i] * 0.5 + 0.5) * 255, 3) << static_cast<int>(mode);
    }
}

double distanceToSegment(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
  const double length2 = glm::dot(b - a, b - a);
  const double t = length2 > 0 ? std::clamp(glm::dot(p - a, b - a) / length2, 0.0, 1.0) : 0;
  return glm::length(p - (a + t * (b - a)));
}

TEST(Show, linesLieOnTheProjectedEdgesOfTheCells) {
  DrawnPack drawn = openScene();
  const Directory& directory = drawn.pack->directory();
  const RenderSettings settings = showing(Show::cells, RenderMode::triangles);
  std::vector<std::array<glm::dvec2, 2>> edges;
  for (const CellRecord& cell : directory.cells) {
    if (cell.childCount > 0 || cell.content.empty()) continue;
    const glm::dvec3 centre = cellCentre(directory.model.grid, cell.key);
    const double half = cellHalfSide(directory.model.grid, cell.key);
    const auto corner = [&](int i) {
      const glm::dvec3 p(i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half);
      return glm::dvec2(projected(kCamera, centre + p));
    };
    for (int i = 0; i < 8; ++i)
      for (const int axis : {1, 2, 4})
        if ((i & axis) == 0) edges.push_back({corner(i), corner(i | axis)});
  }
  FrameImage picture, shown;
  drawn.draw(kCamera, showing(Show::picture, RenderMode::triangles), picture);
  drawn.draw(kCamera, settings, shown);
  int changed = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      if (pixelAt(picture, x, y) == pixelAt(shown, x, y)) continue;
      ++changed;
      double nearest = 1e9;
      for (const auto& [a, b] : edges)
        nearest = std::min(nearest, distanceToSegment(glm::dvec2(x + 0.5, y + 0.5), a, b));
      ASSERT_LT(nearest, 1.5) << x << ',' << y;
    }
  EXPECT_GT(changed, 500);
  for (const auto& [a, b] : edges) {
    const glm::dvec2 middle = (a + b) * 0.5;
    bool found = false;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const int x = static_cast<int>(middle.x) + dx, y = static_cast<int>(middle.y) + dy;
        found = found || x < 1 || y < 1 || x > kWidth - 2 || y > kHeight - 2 ||
                pixelAt(picture, x, y) != pixelAt(shown, x, y);
      }
    EXPECT_TRUE(found) << middle.x << ',' << middle.y;
  }
}

TEST(Show, theOutlineOfABillboardHoldsWhatItShows) {
  DrawnPack drawn = openDrawn(sphereTriangles({0, 0, 0}, 1, 3, 0x00ffffff), {.level = 0, .imageSize = 64});
  const Camera camera = lookAt({30, 12, 7}, {0, 0, 0}, 0.1);
  FrameImage picture, shown;
  for (const ImpostorKind kind : kKinds) {
    drawn.draw(camera, showing(Show::picture, RenderMode::impostors, kind), picture);
    drawn.draw(camera, showing(Show::billboards, RenderMode::impostors, kind), shown);
    int x0 = kWidth, x1 = 0, y0 = kHeight, y1 = 0, changed = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        if (pixelAt(picture, x, y) != pixelAt(shown, x, y)) {
          x0 = std::min(x0, x), x1 = std::max(x1, x), y0 = std::min(y0, y), y1 = std::max(y1, y);
          ++changed;
        }
    EXPECT_GT(changed, 200);
    EXPECT_LT(changed, 1'500);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        if (alphaAt(picture, x, y) > 20) {
          ASSERT_TRUE(x >= x0 && x <= x1 && y >= y0 && y <= y1) << x << ',' << y;
        }
  }
  drawn.draw(camera, showing(Show::picture, RenderMode::triangles), picture);
  drawn.draw(camera, showing(Show::billboards, RenderMode::triangles), shown);
  EXPECT_EQ(picture.rgba, shown.rgba);
}

TEST(Show, errorGrowsWithNearnessAndIsNoneForTriangles) {
  DrawnPack drawn = openDrawn(boxTriangles({-1, -1, -1}, {1, 1, 1}, 0x00ffffff), {.level = 0, .imageSize = 32});
  const auto hueAt = [&](double distance, RenderMode mode) {
    FrameImage image;
    const FrameStats stats =
        drawn.draw(lookAt({distance, 0, 0}, {0, 0, 0}, 2.2 / distance), showing(Show::error, mode), image);
    EXPECT_EQ(stats.legend.size(), 5u);
    EXPECT_EQ(stats.legend.back().meaning, "2 px or more");
    const Pixel p = pixelAt(image, kWidth / 2, kHeight / 2);
    const std::array<uint8_t, 3> colour = {static_cast<uint8_t>(p[0]), static_cast<uint8_t>(p[1]),
                                           static_cast<uint8_t>(p[2])};
    return std::pair(hueOf(colour), stats.legend);
  };
  const auto [near, legend] = hueAt(20, RenderMode::impostors);  // a texel is some 4 pixels
  EXPECT_LT(glm::length(near - hueOf(legend.back().colour)), 0.05);
  const auto [none, sameLegend] = hueAt(20, RenderMode::triangles);
  EXPECT_LT(glm::length(none - hueOf(legend.front().colour)), 0.05);
  // Half of the scale: a texel of one pixel. Its edge is texelSize half sides, half a side the box's and a little more.
  FrameImage image;
  const double half = cellHalfSide(drawn.pack->directory().model.grid, {0, 0, 0, 0});
  const double distance = 40;
  const double fovYRad = 2 * std::atan(texelSize(32) * half * kHeight / (2 * distance));
  const FrameStats stats =
      drawn.draw(lookAt({1 + distance, 0, 0}, {0, 0, 0}, fovYRad), showing(Show::error, RenderMode::impostors), image);
  EXPECT_TRUE(isOfLegend(pixelAt(image, kWidth / 2, kHeight / 2), {stats.legend[2]}));
}

TEST(Show, anEyeAnywhereDrawsWithoutFailing) {
  DrawnPack drawn = openDrawn(sphereTriangles({0, 0, 0}, 1, 2, 0x00ffffff),
                              {.level = 2, .imageSize = 16, .samplesPerEdge = 1, .lighting = Lighting::relightable});
  FrameImage image;
  for (const glm::dvec3 eye : {glm::dvec3(0), glm::dvec3(1, 0, 0), glm::dvec3(1e9, 0, 0), glm::dvec3(-1e308, 0, 0)})
    for (const Show show : kShows)
      for (const ImpostorKind kind : kKinds)
        for (const int samples : {1, 16})
          drawn.draw(lookAt(eye, {0, 0, 0.001}), showing(show, RenderMode::automatic, kind, samples), image);
  EXPECT_EQ(image.width, kWidth);
}

}  // namespace
}  // namespace farcell
