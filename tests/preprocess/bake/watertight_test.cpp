// A closed surface has no gaps, whatever its triangles' sizes and wherever their edges lie.
#include <gtest/gtest.h>

#include "cache/schema/viewpoints.h"
#include "tests/preprocess/bake/sample_truth.h"

namespace farcell::test {
namespace {

BakeSettings settingsOf(int imageSize, int samples) {
  BakeSettings settings;
  settings.imageSize = imageSize;
  settings.samples = samples;
  return settings;
}

double cross(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

// The outline of a convex body: Andrew's monotone chain (1979) over its projected corners, counter-clockwise.
std::vector<glm::dvec3> outline(const CellSoup& soup, const ViewFrame& frame) {
  std::vector<glm::dvec3> points;
  for (size_t i = 0; i < soup.size(); ++i) {
    const ProjectedTriangle triangle(soup, i, frame);
    points.insert(points.end(), triangle.p, triangle.p + 3);
  }
  std::sort(points.begin(), points.end(),
            [](glm::dvec3 a, glm::dvec3 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::vector<glm::dvec3> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const size_t start = hull.size();
    for (const glm::dvec3& p : points) {
      while (hull.size() >= start + 2 && cross(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

// Distance from the outline, positive inside.
double insideOutline(const std::vector<glm::dvec3>& hull, double u, double v) {
  double least = 1e30;
  for (size_t i = 0; i < hull.size(); ++i) {
    const glm::dvec3 a = hull[i], b = hull[(i + 1) % hull.size()];
    least = std::min(least, cross(a, b, glm::dvec3(u, v, 0)) / std::hypot(b.x - a.x, b.y - a.y));
  }
  return least;
}

TEST(Watertight, ASphereHasNoHolesAndNoFringeFromAnyDirection) {
  const auto viewpoints = Viewpoints::create(42);
  for (const int splits : {0, 3, 6}) {  // 8 to 32,768 triangles
    SCOPED_TRACE(splits);
    const CellSoup soup = sphereSoup(splits, 1);
    int64_t inside = 0, holes = 0, fringe = 0;
    for (const glm::dvec3& direction : viewpoints->directions()) {
      const ViewFrame frame = viewFrame(direction);
      const std::vector<glm::dvec3> hull = outline(soup, frame);
      const BakedView view = bake(soup, frame, settingsOf(72, 1)).view;
      for (int y = 0; y < 72; ++y) {
        for (int x = 0; x < 72; ++x) {
          const double distance = insideOutline(hull, texelCentre(x, 72), texelCentre(y, 72));
          const bool hit = depthAt(view, x, y) != kNothing;
          inside += distance > kEdgeTolerance;
          holes += distance > kEdgeTolerance && !hit;
          fringe += distance < -kEdgeTolerance && hit;
        }
      }
    }
    EXPECT_GT(inside, 42 * 300);
    EXPECT_EQ(holes, 0);
    EXPECT_EQ(fringe, 0);
  }
}

// A square patch cut into triangles, whose inner corners lie on, or a few float steps beside, the centres of samples.
CellSoup patchOnSamples(const ViewFrame& frame, int imageSize, int cells, uint32_t seed) {
  std::mt19937 random(seed);
  const int first = imageSize / 2 - cells / 2;
  const auto point = [&](int x, int y, uint32_t bits) {
    glm::vec3 p(frame.right * texelCentre(first + x, imageSize) + frame.up * texelCentre(first + y, imageSize) +
                frame.toward * (.01 * (bits >> 8 & 15)));
    if (x == 0 || y == 0 || x == cells || y == cells) return p;
    for (int axis = 0; axis < 3; ++axis)
      for (uint32_t i = 0; i < (bits >> axis & 1); ++i) p[axis] = std::nextafter(p[axis], 9.0f);
    return p;
  };
  std::vector<glm::vec3> points;
  for (int y = 0; y <= cells; ++y)
    for (int x = 0; x <= cells; ++x) points.push_back(point(x, y, static_cast<uint32_t>(random())));
  CellSoup soup;
  const auto at = [&](int x, int y) { return points[size_t(y * (cells + 1) + x)]; };
  for (int y = 0; y < cells; ++y) {
    for (int x = 0; x < cells; ++x) {
      const bool other = random() & 1;
      addTriangle(soup, at(x, y), at(x + 1, y), other ? at(x, y + 1) : at(x + 1, y + 1));
      addTriangle(soup, at(x, y + 1), at(x + 1, y + 1), other ? at(x + 1, y) : at(x, y));
    }
  }
  return soup;
}

TEST(Watertight, SamplesOnCornersAndEdgesAreCovered) {
  const auto viewpoints = Viewpoints::create(42);
  std::vector<glm::dvec3> directions(viewpoints->directions().begin(), viewpoints->directions().end());
  directions.insert(directions.end(), {glm::dvec3(0, 0, 1), glm::dvec3(0, 1, 0), glm::dvec3(-1, 0, 0)});
  for (const glm::dvec3& direction : directions) {
    const ViewFrame frame = viewFrame(direction);
    for (const int cells : {2, 20, 40}) {
      const CellSoup soup = patchOnSamples(frame, 128, cells, 7);
      const BakedView view = bake(soup, frame, settingsOf(128, 1)).view;
      const int first = 64 - cells / 2;
      int holes = 0;
      for (int y = 1; y < cells; ++y)
        for (int x = 1; x < cells; ++x) holes += depthAt(view, first + x, first + y) == kNothing;
      EXPECT_EQ(holes, 0) << cells << " cells, seed 7";
    }
  }
}

// A fan around one corner: hundreds of slivers, small at the hub and image-wide at the rim.
TEST(Watertight, AFanOfLongSliversHasNoGaps) {
  const ViewFrame frame = viewFrame(glm::dvec3(0, 0, 1));
  const glm::vec3 hub(.0123f, -.0345f, .1f);
  CellSoup soup;
  constexpr int kSlivers = 5000;
  const auto rim = [&](int i) {
    const double angle = 2 * M_PI * (i % kSlivers) / kSlivers;
    return glm::vec3(glm::dvec3(std::cos(angle), std::sin(angle), .2 * std::sin(9 * angle)));
  };
  for (int i = 0; i < kSlivers; ++i) addTriangle(soup, hub, rim(i), rim(i + 1));
  for (const int samples : {1, 16}) {
    const BakedView view = bake(soup, frame, settingsOf(128, samples)).view;
    int inside = 0, holes = 0;
    for (int y = 0; y < 128; ++y) {
      for (int x = 0; x < 128; ++x) {
        if (std::hypot(texelCentre(x, 128), texelCentre(y, 128)) > 1 - texelSize(128)) continue;
        ++inside;
        holes += rgbaAt(view, x, y)[3] != 1;
      }
    }
    EXPECT_GT(inside, 3000);
    EXPECT_EQ(holes, 0) << samples;
  }
}

}  // namespace
}  // namespace farcell::test
