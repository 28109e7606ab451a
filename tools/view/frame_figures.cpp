#include "tools/view/frame_figures.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "cache/base/file.h"

namespace farcell {

double FrameFigures::quantileMs(double share) const {
  std::vector<double> sorted = frameMs;
  std::sort(sorted.begin(), sorted.end());
  const auto rank = static_cast<size_t>(std::ceil(share * static_cast<double>(sorted.size())));
  return sorted[std::max<size_t>(rank, 1) - 1];
}

Result<> writeFigures(const std::string& path, const FrameFigures& figures) {
  nlohmann::json frames = nlohmann::json::array();
  for (size_t i = 0; i < figures.frameMs.size(); ++i) {
    const FrameStats& stats = figures.stats[i];
    frames.push_back({{"frameMs", figures.frameMs[i]},
                      {"cpuMs", stats.cpuMs},
                      {"triangles", stats.triangles},
                      {"meshes", stats.meshes},
                      {"impostors", stats.impostors},
                      {"texels", stats.texels},
                      {"bytesRead", stats.bytesRead},
                      {"expectedMs", stats.expectedMs}});
  }
  const nlohmann::json json = {{"openGl", figures.openGl},      {"width", figures.sizePx.x},
                               {"height", figures.sizePx.y},    {"medianMs", figures.medianMs()},
                               {"p95Ms", figures.p95Ms()},      {"maxMs", figures.maxMs()},
                               {"firstMs", figures.frameMs[0]}, {"frames", frames}};
  const std::string text = json.dump(2) + "\n";
  if (path != "-") return writeTextFile(path, text);
  std::fputs(text.c_str(), stdout);
  return {};
}

}  // namespace farcell
