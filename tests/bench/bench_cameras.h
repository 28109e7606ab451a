// Cameras as benchmarks are given them on their command line.
#pragma once

#include <cstdlib>
#include <string>
#include <vector>

#include "cache/schema/viewpoints.h"
#include "tools/evaluate/plan/auto_cameras.h"

namespace farcell {

// words: a camera file, or how many automatic cameras of the model.
inline Result<std::vector<Camera>> loadCameras(const std::string& words, const Model& model) {
  if (words.find_first_not_of("0123456789") != std::string::npos) return readCameras(words);
  return autoCameras(model, Viewpoints::of(model.settings.form.views), std::atoi(words.c_str()));
}

}  // namespace farcell
