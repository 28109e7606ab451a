// The viewer: a window, the pack in it, and a person who steers. All on the main thread.
//
//   1. events of the window go to the controls, or are commands of the program
//   2. time passes: the controls move the camera
//   3. if the picture will be another one, it is drawn and shown; else the program waits for events
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "cache/base/result.h"
#include "cache/pack/pack_file.h"
#include "runtime/gl/window/window.h"
#include "runtime/renderer.h"
#include "tools/view/controls/controls.h"
#include "tools/view/view_options.h"

namespace farcell {

class Viewer {
 public:
  static Result<Viewer> open(const ViewOptions& options, const DrawPlan& plan);

  // Until the window is closed or the person quits.
  Result<> run();
  // Once around the pivot in so many frames, as fast as they are drawn; their figures go where the options say.
  Result<> measure();
  // The first picture into a file.
  Result<> captureTo(const std::string& path);

 private:
  // What draws is gone before what it draws from.
  struct Scene {
    std::unique_ptr<PackFile> pack;
    std::unique_ptr<Renderer> renderer;
    std::unique_ptr<Controls> controls;
  };
  Viewer(const ViewOptions& options, const DrawPlan& plan, Window window, Scene scene);
  static Result<Scene> openScene(PackFile pack, const Camera& camera, GlContext& context, uint64_t residentBytes);

  void handle(const Event& event);
  void obey(Command command);
  void openDropped(const std::filesystem::path& path);
  void saveCapture();
  void setLight(const Light& light);
  bool visible() const;
  // Draws what the camera sees and shows it; the milliseconds that took.
  Result<double> drawFrame(const Camera& camera, FrameStats& stats);
  void drawNow();
  void report(const std::string& problem);
  void updateTitle(bool now);
  void fitSize();

  ViewOptions options_;
  RenderSettings settings_;
  Backdrop backdrop_;
  uint64_t residentBytes_;
  Window window_;
  Scene scene_;
  bool quit_ = false;
  bool stale_ = true;  // the picture shown is not the one that should be
  std::string problem_;
  FrameStats lastStats_;
  double sumMs_ = 0;  // of the frames since the title was set
  int frameCount_ = 0;
  double meanMs_ = 0;  // of the frames before the title was set
  std::chrono::steady_clock::time_point titleSet_{};
};

}  // namespace farcell
