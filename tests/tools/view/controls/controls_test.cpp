#include "tools/view/controls/controls.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <numbers>

#include "runtime/camera/overview.h"

namespace farcell {
namespace {

constexpr glm::ivec2 kSizePx{800, 600};

// One cell that a box fills: `side` long, its low corner at `origin`.
Directory oneBox(glm::dvec3 origin, double side) {
  Directory directory;
  directory.model.grid = {origin, side, 16};
  CellRecord root;
  root.content = {{0, 0, 0}, {1 << 16, 1 << 16, 1 << 16}};
  directory.cells = {root};
  directory.model.bounds = root.content;
  return directory;
}

// Controls of a box of side 10 around the origin, seen from the overview.
class Steered : public testing::Test {
 protected:
  Steered() : controls_(directory_, overviewCamera(glm::dvec3(-5), glm::dvec3(5), {0, 0, 1}, 4.0 / 3)) {
    controls_.setSize(kSizePx);
  }
  void key(Key key, bool down, bool shift = false) {
    controls_.handle({.kind = down ? EventKind::keyDown : EventKind::keyUp, .key = key, .shift = shift});
  }
  void drag(MouseButton button, glm::dvec2 from, glm::dvec2 to, bool shift = false) {
    controls_.handle({.kind = EventKind::buttonDown, .button = button, .shift = shift, .atPx = from});
    controls_.handle({.kind = EventKind::moved, .button = button, .shift = shift, .atPx = to});
    controls_.handle({.kind = EventKind::buttonUp, .button = button, .shift = shift, .atPx = to});
  }
  void scroll(double steps, glm::dvec2 atPx) {
    controls_.handle({.kind = EventKind::scrolled, .atPx = atPx, .steps = steps});
  }
  Camera settled() {
    for (int i = 0; i < 500 && controls_.moving(); ++i) controls_.advance(0.02);
    EXPECT_FALSE(controls_.moving());
    return controls_.camera();
  }
  // Where a point lies in the picture, in pixels from the top left.
  glm::dvec2 pixelOf(glm::dvec3 point) const {
    const Camera camera = controls_.camera();
    const CameraAxes axes = cameraAxes(camera);
    const glm::dvec3 v = point - camera.position;
    const double pixels = kSizePx.y / (2 * std::tan(camera.fovYRad / 2)) / -glm::dot(v, axes.back);
    return glm::dvec2(kSizePx) * 0.5 + glm::dvec2(glm::dot(v, axes.right), -glm::dot(v, axes.up)) * pixels;
  }

  const Directory directory_ = oneBox(glm::dvec3(-5), 10);
  Controls controls_;
};

TEST_F(Steered, nothingMovesUntilSomeoneSteers) {
  EXPECT_FALSE(controls_.moving());
  const Camera before = controls_.camera();
  EXPECT_FALSE(controls_.advance(10));
  EXPECT_EQ(controls_.camera().position, before.position);
  key(Key::h, true);  // a key of the program
  EXPECT_FALSE(controls_.moving());
}

TEST_F(Steered, draggingTurnsAroundTheModelAndTheGrabbedSideGoesWithThePointer) {
  const Camera before = controls_.camera();
  const glm::dvec3 front = glm::normalize(before.position) * 5.0;
  drag(MouseButton::left, {400, 300}, {430, 310});
  const Camera after = settled();
  EXPECT_NEAR(glm::length(after.position), glm::length(before.position), 1e-6);
  EXPECT_GT(pixelOf(front).x, 405);
  EXPECT_GT(pixelOf(front).y, 302);
}

TEST_F(Steered, panningTakesWhatIsAtThePivotAlongExactly) {
  for (const auto& [button, shift] : {std::pair{MouseButton::middle, false}, std::pair{MouseButton::right, false},
                                      std::pair{MouseButton::left, true}}) {
    const glm::dvec3 pivot = controls_.camera().target;
    drag(button, {100, 100}, {160, 70}, shift);
    settled();
    EXPECT_NEAR(pixelOf(pivot).x, 400 + 60, 0.01);
    EXPECT_NEAR(pixelOf(pivot).y, 300 - 30, 0.01);
  }
}

TEST_F(Steered, theWheelGoesToWhatIsUnderThePointerAndNeverThroughItInOneStep) {
  const glm::dvec3 place(0, 0, 5);  // on the top of the box, which the overview sees
  const glm::dvec2 atPx = pixelOf(place);
  double away = glm::length(controls_.camera().position - place);
  for (int i = 0; i < 10; ++i) {
    scroll(1, atPx);
    settled();
    EXPECT_LT(glm::length(pixelOf(place) - atPx), 0.5);
    EXPECT_NEAR(glm::length(controls_.camera().position - place) / away, 0.85, 0.01);
    away = glm::length(controls_.camera().position - place);
  }
  for (int i = 0; i < 1000; ++i) scroll(i % 2 ? 1e300 : 20, atPx);
  for (int i = 0; i < 1000; ++i) scroll(-20, atPx);
  settled();
  EXPECT_LT(glm::length(controls_.camera().position), 1e6);
}

TEST_F(Steered, flyingGoesWhereItLooksFasterWithShiftAndWheel) {
  controls_.obey(Command::changeNavigation);
  EXPECT_EQ(controls_.navigation(), Navigation::fly);
  const Camera before = controls_.camera();
  const CameraAxes axes = cameraAxes(before);
  const auto flown = [&](Key which, bool shift) {
    Controls flying = controls_;
    flying.handle({.kind = EventKind::keyDown, .key = which, .shift = shift});
    flying.advance(0.1);
    flying.handle({.kind = EventKind::keyUp, .key = which});
    for (int i = 0; i < 500 && flying.moving(); ++i) flying.advance(0.02);
    return flying.camera().position - before.position;
  };
  const glm::dvec3 ahead = flown(Key::w, false);
  EXPECT_LT(glm::length(glm::normalize(ahead) + axes.back), 1e-6);
  EXPECT_LT(glm::length(glm::normalize(flown(Key::a, false)) + axes.right), 1e-6);
  EXPECT_LT(glm::length(glm::normalize(flown(Key::e, false)) - axes.up), 1e-6);
  EXPECT_LT(glm::length(flown(Key::s, false) + ahead), 1e-6);
  EXPECT_NEAR(glm::length(flown(Key::w, true)) / glm::length(ahead), 4, 1e-3);
  scroll(2, {0, 0});
  EXPECT_GT(glm::length(flown(Key::w, false)), 1.5 * glm::length(ahead));
}

TEST_F(Steered, flyingIsSlowerNearTheModelAndNeverStopsThere) {
  const auto speedAt = [&](glm::dvec3 eye) {
    Controls flying(directory_, {"a", eye, glm::dvec3(100, 0, 0), {0, 0, 1}, 0.7});
    flying.obey(Command::changeNavigation);
    flying.handle({.kind = EventKind::keyDown, .key = Key::w});
    flying.advance(0.001);
    const glm::dvec3 start = flying.camera().position;
    flying.advance(1);
    return glm::length(flying.camera().position - start);
  };
  EXPECT_GT(speedAt({-20, 0, 0}), 2 * speedAt({-8, 0, 0}));
  EXPECT_GT(speedAt({0, 0, 0}), 0.01);
  EXPECT_LT(speedAt({-1e200, 0, 0}), 1e3);
}

TEST_F(Steered, lookingAroundLeavesTheEyeWhereItIs) {
  controls_.obey(Command::changeNavigation);
  const Camera before = controls_.camera();
  const CameraAxes axes = cameraAxes(before);
  controls_.handle({.kind = EventKind::buttonDown, .button = MouseButton::right, .atPx = {400, 300}});
  EXPECT_TRUE(controls_.wantsPointer());
  controls_.handle({.kind = EventKind::moved, .atPx = {420, 300}});
  controls_.handle({.kind = EventKind::buttonUp, .button = MouseButton::right, .atPx = {420, 300}});
  EXPECT_FALSE(controls_.wantsPointer());
  const Camera after = settled();
  EXPECT_EQ(after.position, before.position);
  EXPECT_GT(glm::dot(-cameraAxes(after).back, axes.right), 0.01);  // looks to the right
  EXPECT_NEAR(cameraAxes(after).right.z, 0, 1e-12);
}

TEST_F(Steered, keysAreLetGoWhenTheWindowLosesTheirEnd) {
  key(Key::w, true);
  EXPECT_TRUE(controls_.moving());
  controls_.handle({.kind = EventKind::unfocused});
  settled();
  key(Key::w, true);
  key(Key::s, true);
  EXPECT_FALSE(controls_.moving());  // opposite keys
}

TEST_F(Steered, fitAndHomeBringTheModelBackFromAnywhere) {
  for (const Command command : {Command::fit, Command::home, Command::topView, Command::leftView}) {
    drag(MouseButton::left, {400, 300}, {1900, 120});
    drag(MouseButton::middle, {400, 300}, {4000, 3000});
    settled();
    EXPECT_GT(glm::length(pixelOf({0, 0, 0}) - glm::dvec2(400, 300)), 1000);
    controls_.obey(command);
    const Camera camera = settled();
    EXPECT_LT(glm::length(pixelOf({0, 0, 0}) - glm::dvec2(400, 300)), 1e-3);
    for (int i = 0; i < 8; ++i) {
      const glm::dvec2 at = pixelOf({i & 1 ? 5 : -5, i & 2 ? 5 : -5, i & 4 ? 5 : -5});
      EXPECT_TRUE(at.x > 0 && at.x < 800 && at.y > 0 && at.y < 600) << at.x << " " << at.y;
    }
    const CameraAxes axes = cameraAxes(camera);
    EXPECT_TRUE(command != Command::topView || glm::length(axes.up - glm::dvec3(0, 1, 0)) < 1e-6);
    EXPECT_TRUE(command != Command::leftView || glm::length(axes.back - glm::dvec3(-1, 0, 0)) < 1e-6);
  }
}

TEST_F(Steered, anOrbitAfterFlyingTurnsAroundWhatIsAhead) {
  controls_.obey(Command::changeNavigation);
  key(Key::w, true);
  for (int i = 0; i < 20; ++i) controls_.advance(0.02);
  key(Key::w, false);
  const glm::dvec3 eye = settled().position;
  controls_.obey(Command::changeNavigation);
  EXPECT_EQ(settled().position, eye);
  const glm::dvec3 pivot = controls_.camera().target;
  const double onBox = std::max({std::abs(pivot.x), std::abs(pivot.y), std::abs(pivot.z)});
  EXPECT_NEAR(onBox, 5, 1e-6);
}

// The same gestures on the same model at another scale and place give the same pictures.
TEST(Steering, isTheSameAtAnyScaleAndOffset) {
  const auto pixelsAfter = [](glm::dvec3 origin, double side) {
    const Directory directory = oneBox(origin, side);
    Controls controls(directory, overviewCamera(origin, origin + side, {0, 0, 1}, 4.0 / 3));
    controls.setSize(kSizePx);
    controls.handle({.kind = EventKind::scrolled, .atPx = {300, 320}, .steps = 4});
    controls.handle({.kind = EventKind::keyDown, .key = Key::d});
    for (int i = 0; i < 30; ++i) controls.advance(0.01);
    controls.handle({.kind = EventKind::keyUp, .key = Key::d});
    for (int i = 0; i < 500 && controls.moving(); ++i) controls.advance(0.02);
    EXPECT_FALSE(controls.moving());
    return (controls.camera().position - origin) / side;
  };
  const glm::dvec3 expected = pixelsAfter(glm::dvec3(0), 1);
  EXPECT_LT(glm::length(pixelsAfter(glm::dvec3(3e-3), 1e-6) - expected), 1e-5);
  EXPECT_LT(glm::length(pixelsAfter(glm::dvec3(4e6, -5e6, 1e5), 2e3) - expected), 1e-5);
}

TEST(Keys, everyCommandHasAKeyAndTheHelpNamesIt) {
  EXPECT_EQ(commandOf(Key::escape), Command::quit);
  EXPECT_EQ(commandOf(Key::f12), Command::capture);
  EXPECT_EQ(commandOf(Key::home), Command::home);
  EXPECT_EQ(commandOf(Key::l), Command::nextLight);
  EXPECT_EQ(commandOf(Key::up), Command::sunHigher);
  EXPECT_FALSE(commandOf(Key::w));
  EXPECT_FALSE(commandOf(Key::other));
  for (const char* word : {"WASD", "Tab", "Esc", "F12", "wheel", "headlight", "Arrows"})
    EXPECT_NE(keyHelp().find(word), std::string::npos);
}

}  // namespace
}  // namespace farcell
