// bench_losses <pack> <camera file, or how many automatic cameras> [every nth camera]: what each way of drawing a cell
// loses, CSV on stdout. 1280 x 720, against 64 samples. A pixel's error is counted for the cell whose surface the ray
// through its middle meets first; a line for each camera, way and cell of its cut that owns a pixel.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include "runtime/renderer.h"
#include "tests/bench/bench_cameras.h"
#include "tests/bench/traced_cell.h"
#include "tools/evaluate/metrics/images.h"
#include "tools/evaluate/reference/leaves.h"
#include "tools/evaluate/reference/reference.h"

namespace farcell {
namespace {

constexpr uint64_t kResidentBytes = 2'000'000'000;
constexpr Colour kBackground = {179, 204, 230};

struct Way {
  std::string name;
  RenderSettings settings;
};

Way way(const std::string& name, RenderMode mode, int samples, double lengthPixels, ImpostorKind kind) {
  Way result{name, {}};
  result.settings.samplesPerPixel = samples;
  result.settings.kind = kind;
  result.settings.selection.mode = mode;
  result.settings.selection.meshPixels = lengthPixels;
  result.settings.selection.texelPixels = lengthPixels;
  return result;
}

std::vector<Way> allWays() {
  const ImpostorKind a = ImpostorKind::depthCorrected;
  std::vector<Way> ways = {way("full-1spp", RenderMode::full, 1, 0, a), way("full-4spp", RenderMode::full, 4, 0, a)};
  for (const double pixels : {0.25, 0.5, 1.0, 2.0})
    ways.push_back(way(fmt::format("A-{}px", pixels), RenderMode::impostors, 4, pixels, a));
  for (const double pixels : {0.25, 0.5, 1.0, 2.0})
    ways.push_back(way(fmt::format("B-{}px", pixels), RenderMode::impostors, 4, pixels, ImpostorKind::blended));
  for (const double pixels : {1.0, 2.0, 4.0})
    ways.push_back(way(fmt::format("lod-{}px", pixels), RenderMode::meshes, 4, pixels, a));
  return ways;
}

bool meets(const TracedGeometry& geometry, glm::dvec3 eye, glm::dvec3 direction) {
  const glm::vec3 origin((eye - geometry.triangles.origin) / geometry.triangles.unit);
  RTCRay ray{};
  ray.org_x = origin.x, ray.org_y = origin.y, ray.org_z = origin.z;
  ray.dir_x = static_cast<float>(direction.x);
  ray.dir_y = static_cast<float>(direction.y);
  ray.dir_z = static_cast<float>(direction.z);
  ray.tfar = INFINITY;
  ray.mask = ~0u;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(geometry.scene.get(), &context, &ray);
  return ray.tfar < 0;
}

// Of every pixel, the leaf seen through its middle; kNone: none.
Result<std::vector<uint32_t>> owners(const PackFile& pack, const Camera& camera, int width, int height) {
  FARCELL_ASSIGN(const EmbreeDevice device, createEmbreeDevice(1));
  const ReferenceView view = referenceView(camera, width, height);
  std::vector<uint32_t> owner(static_cast<size_t>(width) * height, kNone);
  for (const VisibleLeaf& leaf : leavesFrontToBack(pack.directory(), view)) {
    FARCELL_ASSIGN(const TracedGeometry geometry, traceCell(pack, leaf.cell, device.get()));
    for (int y = leaf.bounds.y0; y < leaf.bounds.y1; ++y)
      for (int x = leaf.bounds.x0; x < leaf.bounds.x1; ++x) {
        uint32_t& pixel = owner[static_cast<size_t>(y) * width + x];
        if (pixel == kNone && meets(geometry, view.eye, rayDirection(view, {x + 0.5, y + 0.5}))) pixel = leaf.cell;
      }
  }
  return owner;
}

std::vector<float> errors(const std::vector<float>& truth, const FrameImage& image) {
  const std::vector<float> rgb =
      composite(TestImage{image.width, image.height, image.rgba, image.impostorCoverage}, kBackground);
  std::vector<float> result(truth.size() / 3, 0);
  for (size_t i = 0; i < truth.size(); ++i) result[i / 3] += std::abs(rgb[i] - truth[i]);
  return result;
}

struct Sum {
  size_t pixels = 0;
  double error = 0;
  double fullError = 0;  // of full geometry at one sample
};

void print(const PackFile& pack, const Camera& camera, const Way& way, const std::vector<uint32_t>& owner,
           const std::vector<float>& error, const std::vector<float>& fullError, const Cut& cut) {
  std::map<uint32_t, Sum> sums;
  const auto& cells = pack.directory().cells;
  std::map<uint32_t, const CutEntry*> entries;
  for (const CutEntry& entry : cut.entries) entries[entry.cell] = &entry;
  for (size_t i = 0; i < owner.size(); ++i) {
    uint32_t cell = owner[i];
    while (cell != kNone && !entries.contains(cell)) cell = cells[cell].parent;
    if (cell == kNone) continue;
    Sum& sum = sums[cell];
    ++sum.pixels;
    sum.error += error[i];
    sum.fullError += fullError[i];
  }
  constexpr const char* kNames[] = {"triangles", "mesh", "impostor"};
  for (const auto& [cell, entry] : entries) {
    const Sum& sum = sums[cell];
    const glm::dvec3 size(cells[cell].content.max - cells[cell].content.min);
    const double distance = [&] {
      const Grid& grid = pack.directory().model.grid;
      const glm::dvec3 eye = (camera.position - grid.origin) / grid.step();
      return glm::length(eye -
                         glm::clamp(eye, glm::dvec3(cells[cell].content.min), glm::dvec3(cells[cell].content.max)));
    }();
    const double pixel = distance * 2 * std::tan(camera.fovYRad / 2) / 720;
    const double area = (size.x * size.y + size.y * size.z + size.z * size.x) / 2 / (pixel * pixel);
    std::printf("%s,%s,%u,%u,%d,%s,%.4g,%llu,%llu,%.0f,%zu,%.1f,%.1f\n", camera.name.c_str(), way.name.c_str(), cell,
                cells[cell].key.level, cells[cell].childCount == 0, kNames[static_cast<size_t>(entry->representation)],
                entry->errorPixels, static_cast<unsigned long long>(cells[cell].meshTriangles),
                static_cast<unsigned long long>(cells[cell].triangles), area, sum.pixels, sum.error, sum.fullError);
  }
}

Result<> benchCamera(const PackFile& pack, Renderer& renderer, const Camera& camera) {
  FARCELL_ASSIGN(const ReferenceImage reference, traceReference(pack, camera, {}));
  const std::vector<float> truth = composite(reference, kBackground);
  FARCELL_ASSIGN(const std::vector<uint32_t> owner, owners(pack, camera, reference.width, reference.height));
  std::vector<float> fullError;
  for (const Way& way : allWays()) {
    FrameImage image;
    FARCELL_TRY(renderer.draw(camera, way.settings, &image));
    const std::vector<float> error = errors(truth, image);
    if (fullError.empty()) fullError = error;
    print(pack, camera, way, owner, error, fullError,
          selectCut(pack.directory(), camera, image.width, image.height, way.settings.selection));
  }
  std::fflush(stdout);
  return {};
}

Result<> bench(const std::string& path, const std::string& words, size_t every) {
  FARCELL_ASSIGN(const PackFile pack, PackFile::open(path));
  FARCELL_ASSIGN(const std::vector<Camera> cameras, loadCameras(words, pack.directory().model));
  FARCELL_ASSIGN(GlContext context, GlContext::createHeadless());
  FARCELL_ASSIGN(Renderer renderer, Renderer::create(context, pack, kResidentBytes));
  std::printf(
      "camera,way,cell,level,leaf,drawn,lengthPixels,meshTriangles,triangles,areaPixels,pixels,error,fullError\n");
  for (size_t i = 0; i < cameras.size(); i += every) FARCELL_TRY(benchCamera(pack, renderer, cameras[i]));
  return {};
}

}  // namespace
}  // namespace farcell

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: bench_losses <pack> <cameras.json or a number> [every nth camera]\n");
    return 2;
  }
  const auto every = static_cast<size_t>(argc > 3 ? std::max(1, std::atoi(argv[3])) : 1);
  const auto result = farcell::bench(argv[1], argv[2], every);
  if (!result) std::fprintf(stderr, "bench_losses: %s\n", result.error().message.c_str());
  return result ? 0 : 1;
}
