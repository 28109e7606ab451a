// What the frames of --frames took.
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "cache/base/result.h"
#include "runtime/renderer.h"

namespace farcell {

struct FrameFigures {
  std::string openGl;
  glm::ivec2 sizePx{0};
  std::vector<double> frameMs;  // from the start of a frame until it was handed to the screen; not empty
  std::vector<FrameStats> stats;

  double medianMs() const { return quantileMs(0.5); }
  double p95Ms() const { return quantileMs(0.95); }
  double maxMs() const { return quantileMs(1); }
  // The least time that this share of the frames kept within.
  double quantileMs(double share) const;
};

// JSON to the file, or to stdout where the path is "-".
Result<> writeFigures(const std::string& path, const FrameFigures& figures);

}  // namespace farcell
