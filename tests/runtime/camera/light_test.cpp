#include "runtime/camera/light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace farcell {
namespace {

TEST(Light, aSunStandsWhereItsAnglesSayAndAHeadlightOnTheViewAxis) {
  BuildSettings settings;
  settings.up = UpAxis::y;
  settings.sun = {std::numbers::pi / 2, 0};
  const Camera camera{"", {3, 4, 0}, {0, 0, 0}, {0, 0, 1}, 0.7};
  EXPECT_LT(glm::distance(lightDirection({}, settings, camera), glm::vec3(1, 0, 0)), 1e-6f);  // up y: from z towards x
  EXPECT_LT(glm::distance(lightDirection({LightKind::sun, Sun{1, std::numbers::pi / 2}}, settings, camera),
                          glm::vec3(0, 1, 0)),
            1e-6f);
  EXPECT_LT(glm::distance(lightDirection({LightKind::headlight, {}}, settings, camera), glm::vec3(.6f, .8f, 0)), 1e-6f);
}

TEST(Light, ofABakedPackIsItsOwnSunAlone) {
  BuildSettings settings;
  EXPECT_TRUE(checkLight({}, settings, "a.far"));
  EXPECT_TRUE(checkLight({LightKind::sun, settings.sun}, settings, "a.far"));
  const Light other{LightKind::sun, Sun{1, 1}}, headlight{LightKind::headlight, {}};
  for (const Light& light : {other, headlight}) {
    EXPECT_EQ(checkLight(light, settings, "a.far").error().kind, ErrorKind::invalidArgument);
    EXPECT_NE(checkLight(light, settings, "a.far").error().message.find(lightText(light, settings)), std::string::npos);
  }
  settings.lighting = Lighting::relightable;
  for (const Light& light : {Light{}, other, headlight}) EXPECT_TRUE(checkLight(light, settings, "a.far"));
}

TEST(Light, aMovedSunGoesAroundAndNotBeyondStraightAbove) {
  const BuildSettings settings;
  Light light{LightKind::headlight, Sun{3, 1.5}};
  light = movedSun(light, settings, 0.5, 0.5);
  EXPECT_EQ(light.kind, LightKind::sun);
  EXPECT_NEAR(light.sun->azimuthRad, 3.5 - 2 * std::numbers::pi, 1e-12);
  EXPECT_EQ(light.sun->elevationRad, std::numbers::pi / 2);
  EXPECT_TRUE(isSun(*movedSun(light, settings, 0, -10).sun));
  EXPECT_EQ(movedSun({}, settings, 0, 0).sun->elevationRad, settings.sun.elevationRad);
}

}  // namespace
}  // namespace farcell
