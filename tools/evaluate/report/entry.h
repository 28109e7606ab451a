// One line of a report: one renderer's picture from one camera.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/evaluate/metrics/metrics.h"
#include "tools/evaluate/plan/renderers.h"

namespace farcell {

struct FrameTimes {
  double medianMs = 0;
  double p95Ms = 0;  // nearest rank
  double maxMs = 0;
};
// Of warm frames. REQUIRES: at least one.
FrameTimes frameTimes(std::vector<double> wallMs);
double medianOf(std::vector<double> values);

struct Entry {
  std::string camera;
  std::string stem;  // of the names of its camera's files (names.h)
  RendererPlan renderer;
  Metrics metrics;
  FrameTimes frame;        // wall
  double cpuMs = 0;        // median, whole process
  uint64_t triangles = 0;  // drawn
  uint64_t meshes = 0;     // inner cells drawn as their simplified meshes
  uint64_t impostors = 0;  // cells drawn as impostors
  uint64_t texels = 0;
  uint64_t bytesRead = 0;                 // of the cold frame: nothing was resident
  double diameters = 0;                   // the eye from the bounding sphere's surface; negative inside
  std::optional<double> ratioToFull1spp;  // of paperError; nothing where the baseline has no error to compare with
};

}  // namespace farcell
