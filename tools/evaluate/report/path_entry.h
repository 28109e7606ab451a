// What a report says of a camera path: each renderer's frames, and what they come to.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/evaluate/metrics/change.h"
#include "tools/evaluate/plan/renderers.h"

namespace farcell {

struct PathFrame {
  double paperError = 0;
  Change change;                                 // since the frame before; zeros in the first
  uint32_t viewSwitches = 0, levelSwitches = 0;  // of cells since the frame before (path/switches.h)
  double wallMs = 0, cpuMs = 0;                  // with the pages read for this frame
  uint64_t bytesRead = 0;
  uint64_t triangles = 0;
  uint64_t impostors = 0;
};

struct PathRun {
  RendererPlan renderer;
  std::vector<PathFrame> frames;
};

struct PathEntry {
  std::string name;
  std::string stem;           // of the names of its files (names.h)
  std::vector<PathRun> runs;  // of as many frames each
};

// Over the frames that have one before them; percentiles by nearest rank.
struct PathSummary {
  size_t frames = 0;
  double meanError = 0;  // paperError, over all frames
  double meanFlicker = 0, p99Flicker = 0, worstFlicker = 0;
  size_t worstFrame = 0;                      // the first of the worst flicker
  double ownChange = 0, referenceChange = 0;  // means
  size_t switchFrames = 0;                    // in which cells switched
  uint64_t viewSwitches = 0, levelSwitches = 0;
  std::optional<double> flickerAtSwitches, flickerElsewhere;  // means; nothing without such frames
  double worstPopToReference = 0;  // of frames with switches: the largest flicker / the reference's own mean change
  double medianMs = 0, p99Ms = 0, worstMs = 0;  // wall, without the first frame, which reads what is in view
  std::optional<double> flickerToFull4spp;      // meanFlicker / that of full-4spp; nothing where that is 0 or not there
};

PathSummary summarise(const PathRun& run);
// In the order of entry.runs.
std::vector<PathSummary> summarise(const PathEntry& entry);

}  // namespace farcell
