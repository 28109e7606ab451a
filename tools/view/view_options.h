// The command line of farcell-view.
#pragma once

#include "tools/options/draw_options.h"

namespace farcell {

struct ViewOptions : DrawOptions {
  ViewOptions() { samples = "4"; }  // while the camera moves
  int frames = 0;                   // 0: until someone closes the window
  std::string statsFile;            // of these frames; empty: none; "-": stdout
  std::string screenshot;           // empty: none
};

void addViewOptions(CLI::App& app, ViewOptions& options);

// The same picture again, as a command for a shell.
std::string renderCommand(const DrawOptions& options, const RenderSettings& settings, const std::string& pack,
                          const std::string& cameraFile);

}  // namespace farcell
