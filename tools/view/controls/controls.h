// Steering: what a person does with keys and mouse, and the camera that comes of it. Knows no window and no clock.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <set>

#include "cache/pack/directory.h"
#include "runtime/camera/motion.h"
#include "runtime/gl/window/event.h"
#include "tools/view/controls/keys.h"

namespace farcell {

enum class Navigation { orbit, fly };

class Controls {
 public:
  // `directory` must outlive the controls.
  Controls(const Directory& directory, const Camera& start);

  // Of the picture; at least 1 x 1. Angles and distances are steered by shares of it.
  void setSize(glm::ivec2 sizePx) { sizePx_ = sizePx; }
  // Keys that are held, drags and the wheel.
  void handle(const Event& event);
  // What a command does to the camera; nothing for commands of the program.
  void obey(Command command);

  // Lets time pass; returns whether the camera is another one now.
  bool advance(double seconds);
  // Whether the camera will be another one after some time, though nothing happens.
  bool moving() const;

  Camera camera() const { return cameraOf(motion_.seen()); }
  Navigation navigation() const { return navigation_; }
  // Whether a drag turns the view without end: the pointer is in the way.
  bool wantsPointer() const { return drag_ && drag_->action == Drag::look; }

 private:
  struct Drag {
    enum Action { turn, pan, look } action;
    MouseButton button;
    glm::dvec2 atPx;  // where the pointer was last
  };
  double aspect() const { return static_cast<double>(sizePx_.x) / sizePx_.y; }
  Drag::Action actionOf(const Event& event) const;
  void dragTo(glm::dvec2 atPx);
  void wheel(const Event& event);
  void dollyTo(glm::dvec2 atPx, double scale);
  void changeNavigation();
  void lookAlong(double yawRad, double pitchRad);
  void setGoal(const CameraPose& goal);
  glm::dvec3 velocity() const;

  const Directory& directory_;
  const Sphere ball_;  // around the model
  CameraMotion motion_;
  Navigation navigation_ = Navigation::orbit;
  glm::ivec2 sizePx_{1, 1};
  std::set<Key> held_;
  bool shift_ = false;
  double speed_ = 1;  // of flying, as set by the wheel
  std::optional<Drag> drag_;
};

}  // namespace farcell
