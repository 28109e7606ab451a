// Times the baker against Embree packets: milliseconds of CPU a view, as CSV on stdout.
//   bench_baker [runs]
#include <fmt/format.h>
#include <hwy/targets.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <ctime>
#include <fstream>
#include <functional>
#include <string>
#include <thread>

#include "cache/schema/viewpoints.h"
#include "tests/bench/baker/cells.h"
#include "tests/bench/baker/packet_tracer.h"

namespace farcell::bench {
namespace {

constexpr int kImageSize = 128;
constexpr size_t kStatueTriangles = 80'000;

double threadCpuMs() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

std::string processorName() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + ptrdiff_t(values.size() / 2), values.end());
  return values[values.size() / 2];
}

// One frame of each pair of the 42 views.
std::vector<ViewFrame> pairFrames() {
  const auto viewpoints = Viewpoints::create(42);
  std::vector<ViewFrame> frames;
  for (int view = 0; view < viewpoints->count(); ++view)
    if (view < viewpoints->antipode(view)) frames.push_back(viewFrame(viewpoints->directions()[size_t(view)]));
  return frames;
}

struct PairOfViews {
  BakedView view, antipode;
};

struct Contest {
  const CellSoup& soup;
  BakeSettings settings;
  std::vector<ViewFrame> frames = pairFrames();
  std::vector<PairOfViews> baked = std::vector<PairOfViews>(frames.size());

  size_t viewCount() const { return 2 * frames.size(); }
  double viewMs(const std::function<void()>& bakeAll) const {
    const double start = threadCpuMs();
    bakeAll();
    return (threadCpuMs() - start) / static_cast<double>(viewCount());
  }
};

void bakeAll(Contest& contest, ViewBaker& baker) {
  for (size_t i = 0; i < contest.frames.size(); ++i) {
    baker.begin(contest.frames[i]);
    baker.add(contest.soup);
    baker.finish(contest.baked[i].view, contest.baked[i].antipode);
  }
}

void traceAll(Contest& contest, const PacketTracer& tracer) {
  for (size_t i = 0; i < contest.frames.size(); ++i) {
    const ViewFrame opposite = viewFrame(-contest.frames[i].toward);
    contest.baked[i].view = tracer.bake(contest.frames[i], contest.settings, contest.baked[i].view);
    contest.baked[i].antipode = tracer.bake(opposite, contest.settings, contest.baked[i].antipode);
  }
}

double meanCoverage(const Contest& contest) {
  double sum = 0;
  for (const PairOfViews& pair : contest.baked)
    for (const BakedView* view : {&pair.view, &pair.antipode})
      for (size_t i = 3; i < view->rgba.size(); i += 4) sum += view->rgba[i];
  return sum / (static_cast<double>(contest.viewCount()) * kImageSize * kImageSize);
}

void compare(const BenchCell& cell, int samples, int runs) {
  BakeSettings settings;
  settings.imageSize = kImageSize;
  settings.samples = samples;
  Contest contest{cell.soup, settings};
  ViewBaker baker(settings);
  const PacketTracer fast(cell.soup, false), robust(cell.soup, true);
  std::vector<double> bakerMs, fastMs, robustMs;
  bakeAll(contest, baker);
  const double bakedCoverage = meanCoverage(contest);
  for (int run = 0; run < runs; ++run) {
    bakerMs.push_back(contest.viewMs([&] { bakeAll(contest, baker); }));
    fastMs.push_back(contest.viewMs([&] { traceAll(contest, fast); }));
    robustMs.push_back(contest.viewMs([&] { traceAll(contest, robust); }));
  }
  const double tracedCoverage = meanCoverage(contest);
  const double own = median(bakerMs), embree = std::min(median(fastMs), median(robustMs));
  fmt::print("{},{},{},{:.4f},{:.3f},{:.3f},{:.3f},{:.1f},{:.5f},{:.5f}\n", cell.name, cell.soup.size(), samples, own,
             median(fastMs), median(robustMs), embree, embree / own, bakedCoverage, tracedCoverage);
  std::fflush(stdout);
}

void printHeader(int runs) {
  const int64_t best = hwy::SupportedAndGeneratedTargets().front();
  fmt::print("# bench_baker {} > tests/bench/baker/results.csv\n", runs);
  fmt::print("# {}, {} hardware threads; Highway target {}; {} runs, median; one thread's CPU time\n", processorName(),
             std::thread::hardware_concurrency(), hwy::TargetName(best), runs);
  fmt::print(
      "# 42 views of {0} x {0} texels as 21 pairs; shading and resolving included. Embree: packets of 16, coherent,\n",
      kImageSize);
  fmt::print("# texels of the covered rectangle only; embreeMs is the faster of plain and robust.\n");
  fmt::print(
      "cell,triangles,samples,bakerMs,embreePlainMs,embreeRobustMs,embreeMs,ratio,bakerCoverage,embreeCoverage\n");
}

int run(int runs) {
  printHeader(runs);
  const auto statue = statueCell(FARCELL_SOURCE_DIR "/../shared/datasets/nefertiti.obj", kStatueTriangles);
  if (!statue) fmt::print(stderr, "the statue is left out: {}\n", statue.error().message);
  for (const int samples : {1, 4, 16})
    if (statue) compare(*statue, samples, runs);
  for (const int samples : {1, 4, 16}) compare(reliefCell(200), samples, runs);
  for (const int blocks : {8, 80, 400})
    for (const int samples : {1, 4, 16}) compare(blockCell(blocks), samples, runs);
  return 0;
}

}  // namespace
}  // namespace farcell::bench

int main(int argc, char** argv) {
  int runs = 7;
  if (argc > 1) std::from_chars(argv[1], argv[1] + std::strlen(argv[1]), runs);
  return farcell::bench::run(std::max(runs, 1));
}
