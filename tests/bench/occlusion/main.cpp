// bench_occlusion <pack> <street|camera file> [count] [frames]: frames with and without what nearer triangles hide, by
// turns, CSV on stdout. street: so many cameras 1.7 units over the ground (or over the lowest surface near by) of
// places under the open sky, looking about; the same for the same pack. 1280 x 720.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

#include "runtime/renderer.h"
#include "tests/bench/traced_cell.h"

namespace farcell {
namespace {

constexpr uint64_t kResidentBytes = 2'000'000'000;
constexpr double kEyeHeight = 1.7, kGroundDepth = 4;

// Height of the highest surface over a place, z up; -infinity: none.
Result<double> surfaceOver(const PackFile& pack, RTCDevice device, double x, double y) {
  const Directory& directory = pack.directory();
  double highest = -INFINITY;
  for (uint32_t i = 0; i < directory.cells.size(); ++i) {
    const CellRecord& cell = directory.cells[i];
    if (cell.childCount > 0 || cell.content.empty()) continue;
    const glm::dvec3 min = directory.model.grid.worldFromGrid(cell.content.min);
    const glm::dvec3 max = directory.model.grid.worldFromGrid(cell.content.max);
    if (x < min.x || x > max.x || y < min.y || y > max.y) continue;
    FARCELL_ASSIGN(const TracedGeometry geometry, traceCell(pack, i, device));
    const glm::dvec3 from = (glm::dvec3(x, y, max.z + 1) - geometry.triangles.origin) / geometry.triangles.unit;
    RTCRayHit ray{};
    ray.ray.org_x = static_cast<float>(from.x), ray.ray.org_y = static_cast<float>(from.y);
    ray.ray.org_z = static_cast<float>(from.z), ray.ray.dir_z = -1, ray.ray.tfar = INFINITY, ray.ray.mask = ~0u;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(geometry.scene.get(), &context, &ray);
    if (ray.hit.geomID != RTC_INVALID_GEOMETRY_ID)
      highest = std::max(highest, max.z + 1 - static_cast<double>(ray.ray.tfar) * geometry.triangles.unit);
  }
  return highest;
}

double lowestNear(const Directory& directory, double x, double y) {
  double lowest = INFINITY;
  for (const CellRecord& cell : directory.cells) {
    if (cell.childCount > 0 || cell.content.empty()) continue;
    const glm::dvec3 min = directory.model.grid.worldFromGrid(cell.content.min);
    const glm::dvec3 max = directory.model.grid.worldFromGrid(cell.content.max);
    if (x >= min.x && x <= max.x && y >= min.y && y <= max.y) lowest = std::min(lowest, min.z);
  }
  return lowest;
}

Result<std::vector<Camera>> streetCameras(const PackFile& pack, size_t count) {
  FARCELL_ASSIGN(const EmbreeDevice device, createEmbreeDevice(1));
  const Model& model = pack.directory().model;
  const glm::dvec3 min = model.grid.worldFromGrid(model.bounds.min), max = model.grid.worldFromGrid(model.bounds.max);
  std::mt19937 random(1);
  const auto part = [&] { return static_cast<double>(random()) / 4294967296.0; };
  std::vector<Camera> cameras;
  while (cameras.size() < count) {
    const double x = min.x + (max.x - min.x) * (0.25 + 0.5 * part()),
                 y = min.y + (max.y - min.y) * (0.25 + 0.5 * part());
    const double lowest = lowestNear(pack.directory(), x, y);
    FARCELL_ASSIGN(const double surface, surfaceOver(pack, device.get(), x, y));
    if (lowest == INFINITY || surface > lowest + kGroundDepth) continue;
    const glm::dvec3 eye(x, y, std::max(lowest, surface) + kEyeHeight);
    const double azimuth = 6.2832 * part();
    cameras.push_back({fmt::format("street-{:02}", cameras.size() + 1), eye,
                       eye + glm::dvec3(std::cos(azimuth), std::sin(azimuth), 0.05), upVector(model.settings.up), 0.9});
  }
  return cameras;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

Result<> benchCamera(Renderer& renderer, const Camera& camera, RenderMode mode, const char* name, bool mustPay,
                     int samples, int frames) {
  std::vector<double> wallMs[2], cpuMs[2], searchMs;
  FrameStats stats[2];
  for (int frame = -1; frame < frames; ++frame)
    for (size_t on = 0; on < 2; ++on) {
      RenderSettings settings;
      settings.samplesPerPixel = samples;
      settings.selection.mode = mode;
      settings.occlusion = on == 1;
      settings.occlusionMustPay = mustPay;
      FARCELL_ASSIGN(stats[on], renderer.draw(camera, settings, nullptr));
      if (frame < 0) continue;
      wallMs[on].push_back(stats[on].wallMs);
      cpuMs[on].push_back(stats[on].cpuMs);
      if (on == 1) searchMs.push_back(stats[on].occlusionMs);
    }
  std::printf("%s,%s,%d,%.2f,%.2f,%.2f,%.2f,%llu,%llu,%llu,%llu,%llu,%llu,%llu,%.2f,%.2f\n", camera.name.c_str(), name,
              samples, median(wallMs[0]), median(wallMs[1]), median(cpuMs[0]), median(cpuMs[1]),
              static_cast<unsigned long long>(stats[0].triangles), static_cast<unsigned long long>(stats[1].triangles),
              static_cast<unsigned long long>(stats[0].impostors), static_cast<unsigned long long>(stats[1].impostors),
              static_cast<unsigned long long>(stats[1].hiddenCells),
              static_cast<unsigned long long>(stats[1].hiddenTriangles),
              static_cast<unsigned long long>(stats[1].hiddenBytes), stats[1].hiddenMs, median(searchMs));
  std::fflush(stdout);
  return {};
}

Result<> bench(const std::string& path, const std::string& words, size_t count, int frames) {
  FARCELL_ASSIGN(const PackFile pack, PackFile::open(path));
  FARCELL_ASSIGN(const std::vector<Camera> cameras,
                 words == "street" ? streetCameras(pack, count) : readCameras(words));
  FARCELL_ASSIGN(GlContext context, GlContext::createHeadless());
  FARCELL_ASSIGN(Renderer renderer, Renderer::create(context, pack, kResidentBytes));
  std::printf(
      "camera,mode,samples,wallMsOff,wallMsOn,cpuMsOff,cpuMsOn,trianglesOff,trianglesOn,impostorsOff,impostorsOn,"
      "hiddenCells,hiddenTriangles,hiddenBytes,hiddenMs,searchMs\n");
  for (size_t i = 0; i < std::min(cameras.size(), count); ++i)
    for (const int samples : {1, 4}) {
      FARCELL_TRY(benchCamera(renderer, cameras[i], RenderMode::automatic, "auto", true, samples, frames));
      FARCELL_TRY(benchCamera(renderer, cameras[i], RenderMode::triangles, "triangles", false, samples, frames));
    }
  return {};
}

}  // namespace
}  // namespace farcell

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: bench_occlusion <pack> <street|cameras.json> [count] [frames]\n");
    return 2;
  }
  const auto count = static_cast<size_t>(argc > 3 ? std::max(1, std::atoi(argv[3])) : 8);
  const auto result = farcell::bench(argv[1], argv[2], count, argc > 4 ? std::max(1, std::atoi(argv[4])) : 5);
  if (!result) std::fprintf(stderr, "bench_occlusion: %s\n", result.error().message.c_str());
  return result ? 0 : 1;
}
