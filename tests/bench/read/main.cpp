// How fast mesh files become triangles, and in how much memory; results.md has figures.
//
//   bench_read FILE                 opens it, two passes, and its hash: a line of seconds and Mtri/s each
//   bench_read --shuffle FROM TO    binary PLY: the same triangles in random order
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <cstring>
#include <string_view>

#include "cache/base/hash.h"
#include "preprocess/mesh/source_hash.h"
#include "preprocess/read/open_mesh.h"
#include "tests/bench/read/shuffle.h"

namespace farcell {
namespace {

double cpuSeconds() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) { return double(time.tv_sec) + double(time.tv_usec) * 1e-6; };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double peakMegabytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_maxrss) / 1024;
}

// Runs `work` and prints what it took; `triangles` it made, where that can be told.
template <class Work>
auto timed(const char* name, const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  const double cpuStart = cpuSeconds();
  auto result = work();
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  fmt::print("{:<8} wall {:7.3f} s  cpu {:7.3f} s  peak RSS {:6.0f} MB", name, wall, cpuSeconds() - cpuStart,
             peakMegabytes());
  return result;
}

Result<MeshCounts> pass(MeshReader& mesh, double& sum) {
  return mesh.forEachTriangle([&](std::span<const InputTriangle> triangles) -> Result<> {
    for (const InputTriangle& triangle : triangles) sum += triangle.positions[0].x + triangle.colours[2];
    return {};
  });
}

Result<> measure(const std::filesystem::path& path) {
  FARCELL_ASSIGN(const std::unique_ptr<MeshReader> mesh, timed("open", [&] { return openMesh(path); }));
  fmt::print("  {}, {} triangles\n", mesh->info().format, mesh->info().declaredTriangles);
  for (int i = 0; i < 2; ++i) {
    double sum = 0;
    const auto start = cpuSeconds();
    FARCELL_ASSIGN(const MeshCounts counts, timed("pass", [&] { return pass(*mesh, sum); }));
    fmt::print("  {:.1f} Mtri/s of CPU, sum {}\n", double(counts.accepted) / (cpuSeconds() - start) * 1e-6, sum);
  }
  FARCELL_ASSIGN(const uint64_t hash, timed("hash", [&] { return sourceHash(*mesh); }));
  fmt::print("  {:016x}\n", hash);
  return {};
}

}  // namespace
}  // namespace farcell

int main(int argc, char** argv) {
  const bool shuffles = argc == 4 && std::string_view(argv[1]) == "--shuffle";
  if (!shuffles && argc != 2) {
    std::fprintf(stderr, "usage: bench_read FILE | --shuffle FROM TO\n");
    return 2;
  }
  const farcell::Result<> done = shuffles ? farcell::shufflePly(argv[2], argv[3]) : farcell::measure(argv[1]);
  if (!done) std::fprintf(stderr, "%s\n", done.error().message.c_str());
  return done ? 0 : 1;
}
