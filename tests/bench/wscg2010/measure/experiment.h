// The whole experiment: tables, pictures and what has become of the paper's claims.
//
// For each model: loadScene -> measureErrors -> measureTimes -> measureSizes -> drawPictures; then writeReport over
// all.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/bench/wscg2010/measure/errors.h"
#include "tests/bench/wscg2010/measure/frame_times.h"
#include "tests/bench/wscg2010/measure/pictures.h"
#include "tests/bench/wscg2010/measure/sizes.h"

namespace farcell::wscg {

struct ExperimentSettings {
  std::vector<std::filesystem::path> models;
  UpAxis up = UpAxis::z;
  std::filesystem::path output;  // a directory; made where it is missing
  int depth = 4;                 // of times, sizes and pictures
  ErrorSettings errors;
  TimeSettings times;
  SizeSettings sizes;
};
// Smaller pictures, fewer cameras, frames and cells: minutes become seconds, and the figures rough.
ExperimentSettings quickSettings();

struct SceneFacts {
  std::string name;
  size_t triangles = 0;
};

struct ExperimentResults {
  std::string renderer;  // of OpenGL
  std::vector<SceneFacts> scenes;
  ErrorResults errors;
  std::vector<TimeRow> times;
  std::vector<SizeResult> sizes;
  std::vector<NearTriangles> near;
};

// Progress on stderr.
Result<ExperimentResults> runExperiment(const ExperimentSettings& settings);

}  // namespace farcell::wscg
