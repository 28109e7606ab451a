// The run behind `farcell evaluate`:
// 1. open packs, cameras and (asked for) the original mesh, whose hash must be the pack's (reference/);
// 2. per camera: trace the reference, then draw with every renderer of the plan (plan/), measure each picture
//    (metrics/) and time it;
// 3. per camera and other sun: the same, figures only (plan/suns.h);
// 4. per camera path: the same frame by frame, with what changes between frames (path/);
// 5. write report.json, report.csv, summary.csv, equal.csv, suns.csv, paths.csv, index.html, cameras.json and
//    pictures (report/).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "cache/base/progress.h"
#include "cache/base/result.h"
#include "runtime/camera/light.h"
#include "runtime/renderer.h"
#include "tools/evaluate/metrics/images.h"

namespace farcell {

struct EvaluateOptions {
  std::filesystem::path pack;
  std::vector<std::string> against;  // other packs of the same model, see parseOtherPacks()
  std::filesystem::path cameras;     // a camera file; empty: autoCameras
  int autoCameras = 0;
  std::vector<std::string> paths;             // path files, or names of generated paths
  int pathFrames = 60;                        // of each path
  uint32_t pathSeed = 1;                      // of generated paths
  std::vector<std::filesystem::path> meshes;  // empty: the pack's own leaves are the truth
  std::filesystem::path output;               // directory, made when absent
  std::string renderers;
  std::vector<std::string> sweeps;  // see sweepRenderers()
  int width = 1280;
  int height = 720;
  int referenceSamples = 64;
  int samples = 8;  // of every renderer but full geometry, whose names say theirs
  SelectionSettings selection;     // level rule and triangle budget of every renderer
  bool recalibrate = false;        // machine costs, for the time budget
  Light light;                     // of the reference and every renderer
  int suns = 0;                    // cameras are measured under this many others too
  bool occlusion = false;          // RenderSettings::occlusion of every renderer
  double lodPixels = 1;            // geometric error of the renderer lod
  int timedFrames = 5;
  uint64_t residentBytes = uint64_t{1} << 30;
  Colour background = {179, 204, 230};
  ProgressForm progress = ProgressForm::automatic;
  bool json = false;  // stdout: the report instead of a table
};

// An interrupt or a failure after the first camera or frame of a path leaves a report of what was finished, marked
// incomplete, and is returned as the error it is.
Result<> evaluate(EvaluateOptions options);

}  // namespace farcell
