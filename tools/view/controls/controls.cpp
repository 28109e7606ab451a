#include "tools/view/controls/controls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "runtime/camera/overview.h"
#include "runtime/selection/content.h"

namespace farcell {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kTurnRad = kPi;      // of a drag over the window's height
constexpr double kLookFields = 2.5;   // the same when looking around, in fields of view
constexpr double kWheelScale = 0.85;  // a step towards what is under the pointer leaves this share of the way
constexpr double kWheelSpeed = 1.25;  // a step makes flying faster by this
constexpr double kShiftSpeed = 4;
constexpr double kSpeed = 0.7;  // distances to the nearest content a second
// Of the model's radius: how near a pivot comes, from which distances to content speeds are taken, how far one gets.
constexpr double kNearestPivot = 1e-4;
constexpr double kLeastSpeedDistance = 0.005;
constexpr double kMostSpeedDistance = 2;
constexpr double kFarthest = 1e4;

struct Movement {
  Key key;
  glm::dvec3 direction;  // right, up, forward
};
constexpr std::array<Movement, 6> kMovements = {{{Key::w, {0, 0, 1}},
                                                 {Key::s, {0, 0, -1}},
                                                 {Key::d, {1, 0, 0}},
                                                 {Key::a, {-1, 0, 0}},
                                                 {Key::e, {0, 1, 0}},
                                                 {Key::q, {0, -1, 0}}}};

glm::dvec3 corner(const Model& model, GridPoint point) { return model.grid.worldFromGrid(point); }

// A model of one point has a ball too: of a grid step.
Sphere ballAround(const Model& model) {
  const glm::dvec3 min = corner(model, model.bounds.min), max = corner(model, model.bounds.max);
  return {min * 0.5 + max * 0.5, std::max(glm::length(max * 0.5 - min * 0.5), model.grid.step())};
}

// The same direction, the shorter way round.
double nearestYaw(const CameraPose& from, double yawRad) {
  return from.yawRad + std::remainder(yawRad - from.yawRad, 2 * kPi);
}

double boundedPivot(double distance, const Sphere& ball) {
  return std::clamp(distance, kNearestPivot * ball.radius, kFarthest * ball.radius);
}

// No one gets lost: the eye stays within some thousand radii of the model.
CameraPose bounded(CameraPose pose, const Sphere& ball) {
  const glm::dvec3 limit(kFarthest * ball.radius);
  pose.eye = glm::clamp(pose.eye, ball.centre - limit, ball.centre + limit);
  pose.distance = boundedPivot(pose.distance, ball);
  return pose;
}

}  // namespace

Controls::Controls(const Directory& directory, const Camera& start)
    : directory_(directory), ball_(ballAround(directory.model)), motion_(bounded(poseOf(start), ball_)) {}

void Controls::handle(const Event& event) {
  shift_ = event.shift;
  switch (event.kind) {
    case EventKind::keyDown:
      held_.insert(event.key);
      break;
    case EventKind::keyUp:
      held_.erase(event.key);
      break;
    case EventKind::buttonDown:
      if (!drag_) drag_ = {actionOf(event), event.button, event.atPx};
      break;
    case EventKind::buttonUp:
      if (drag_ && drag_->button == event.button) drag_.reset();
      break;
    case EventKind::moved:
      if (drag_) dragTo(event.atPx);
      break;
    case EventKind::scrolled:
      wheel(event);
      break;
    case EventKind::unfocused:
      held_.clear();
      drag_.reset();
      break;
    case EventKind::exposed:
    case EventKind::dropped:
      break;
  }
}

Controls::Drag::Action Controls::actionOf(const Event& event) const {
  if (navigation_ == Navigation::fly) return event.button == MouseButton::middle ? Drag::pan : Drag::look;
  return event.button == MouseButton::left && !event.shift ? Drag::turn : Drag::pan;
}

// What is grabbed goes with the pointer; looking around, the view does.
void Controls::dragTo(glm::dvec2 atPx) {
  const glm::dvec2 heights = (atPx - drag_->atPx) / static_cast<double>(sizePx_.y);
  drag_->atPx = atPx;
  const CameraPose& goal = motion_.goal();
  if (drag_->action == Drag::pan) {
    setGoal(panned(goal, {-2 * heights.x, 2 * heights.y}));
  } else if (drag_->action == Drag::turn) {
    setGoal(orbited(goal, -heights.x * kTurnRad, -heights.y * kTurnRad));
  } else {
    const double angle = kLookFields * goal.fovYRad;
    setGoal(looked(goal, -heights.x * angle, -heights.y * angle));
  }
}

void Controls::wheel(const Event& event) {
  const double steps = std::clamp(event.steps, -20.0, 20.0);
  if (navigation_ == Navigation::fly) {
    speed_ = std::clamp(speed_ * std::pow(kWheelSpeed, steps), 1e-3, 1e3);
  } else {
    dollyTo(event.atPx, std::pow(kWheelScale, steps));
  }
}

// Towards the content under the pointer, or the plane through the pivot where there is none.
void Controls::dollyTo(glm::dvec2 atPx, double scale) {
  CameraPose goal = motion_.goal();
  const glm::dvec2 size(sizePx_);
  const glm::dvec3 ray = rayThrough(goal, {2 * atPx.x / size.x - 1, 1 - 2 * atPx.y / size.y}, aspect());
  const double toPlane = goal.distance / -glm::dot(ray, axesOf(goal).back);
  goal = dollied(goal, goal.eye + ray * distanceAlong(directory_, goal.eye, ray).value_or(toPlane), scale);
  setGoal(goal);
}

void Controls::obey(Command command) {
  switch (command) {
    case Command::fit:
      return setGoal(fitted(motion_.goal(), ball_, aspect()));
    case Command::home: {
      const Model& model = directory_.model;
      const Camera overview = overviewCamera(corner(model, model.bounds.min), corner(model, model.bounds.max),
                                             upVector(model.settings.up), aspect());
      CameraPose goal = poseOf(overview);
      goal.yawRad = nearestYaw(motion_.goal(), goal.yawRad);
      return motion_.setGoal(goal);
    }
    case Command::frontView:
      return lookAlong(kPi / 2, 0);
    case Command::backView:
      return lookAlong(-kPi / 2, 0);
    case Command::leftView:
      return lookAlong(0, 0);
    case Command::rightView:
      return lookAlong(kPi, 0);
    case Command::topView:
      return lookAlong(kPi / 2, -kPi / 2);
    case Command::bottomView:
      return lookAlong(kPi / 2, kPi / 2);
    case Command::changeNavigation:
      return changeNavigation();
    default:
      return;
  }
}

// At the whole model.
void Controls::lookAlong(double yawRad, double pitchRad) {
  CameraPose goal = motion_.goal();
  goal.yawRad = nearestYaw(goal, yawRad);
  goal.pitchRad = pitchRad;
  setGoal(fitted(goal, ball_, aspect()));
}

// An orbit turns around what is ahead, or the place beside the model's centre.
void Controls::changeNavigation() {
  drag_.reset();
  navigation_ = navigation_ == Navigation::orbit ? Navigation::fly : Navigation::orbit;
  if (navigation_ == Navigation::fly) return;
  const CameraPose& goal = motion_.goal();
  const glm::dvec3 ahead = -axesOf(goal).back;
  const double toCentre = glm::dot(ball_.centre - goal.eye, ahead);
  const double distance = distanceAlong(directory_, goal.eye, ahead).value_or(toCentre);
  motion_.setDistance(boundedPivot(distance, ball_));
}

void Controls::setGoal(const CameraPose& goal) { motion_.setGoal(bounded(goal, ball_)); }

// The farther from everything, the faster.
glm::dvec3 Controls::velocity() const {
  glm::dvec3 direction(0);
  for (const Movement& movement : kMovements)
    if (held_.count(movement.key) != 0) direction += movement.direction;
  if (direction == glm::dvec3(0)) return direction;
  const CameraAxes axes = axesOf(motion_.goal());
  const double distance = std::clamp(distanceToContent(directory_, motion_.goal().eye),
                                     kLeastSpeedDistance * ball_.radius, kMostSpeedDistance * ball_.radius);
  const double speed = kSpeed * distance * speed_ * (shift_ ? kShiftSpeed : 1.0);
  return (axes.right * direction.x + axes.up * direction.y - axes.back * direction.z) *
         (speed / glm::length(direction));
}

bool Controls::advance(double seconds) {
  if (!moving()) return false;
  motion_.advance(seconds, velocity(), navigation_ == Navigation::fly ? Anchor::eye : Anchor::pivot);
  setGoal(motion_.goal());
  return true;
}

bool Controls::moving() const { return velocity() != glm::dvec3(0) || !motion_.resting(); }

}  // namespace farcell
