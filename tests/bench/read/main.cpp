// How fast mesh files become triangles, and in how much memory; results.md has figures.
//
//   bench_read FILE [MIB]           opens it in that much memory (default 512): two passes, and its hash, a line each
//   bench_read --shuffle FROM TO    binary PLY: the same triangles in random order
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string_view>

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

Result<> measure(const std::filesystem::path& path, const ReadOptions& options) {
  FARCELL_ASSIGN(const std::shared_ptr<ReadMemory> memory, ReadMemory::create(options));
  FARCELL_ASSIGN(const std::unique_ptr<MeshReader> mesh, timed("open", [&] { return openMeshes({&path, 1}, memory); }));
  fmt::print("  {}, {} triangles\n", mesh->info().format, mesh->info().declaredTriangles);
  for (int i = 0; i < 2; ++i) {
    double sum = 0;
    const auto start = cpuSeconds();
    FARCELL_ASSIGN(const MeshCounts counts, timed("pass", [&] { return pass(*mesh, sum); }));
    fmt::print("  {:.1f} Mtri/s of CPU, sum {}\n", double(counts.accepted) / (cpuSeconds() - start) * 1e-6, sum);
  }
  FARCELL_ASSIGN(const uint64_t hash, timed("hash", [&] { return sourceHash(*mesh); }));
  fmt::print("  {:016x}\n", hash);
  fmt::print("memory   at most {:.1f} MB of {:.1f}, scratch {:.1f} MB\n", double(memory->peakBytes()) * 1e-6,
             double(options.memoryBytes) * 1e-6, double(memory->spilledBytes()) * 1e-6);
  return {};
}

}  // namespace
}  // namespace farcell

int main(int argc, char** argv) {
  const bool shuffles = argc == 4 && std::string_view(argv[1]) == "--shuffle";
  if (!shuffles && argc != 2 && argc != 3) {
    std::fprintf(stderr, "usage: bench_read FILE [MIB] | --shuffle FROM TO\n");
    return 2;
  }
  farcell::ReadOptions options;
  if (argc == 3) options.memoryBytes = std::strtoull(argv[2], nullptr, 10) << 20;
  const farcell::Result<> done = shuffles ? farcell::shufflePly(argv[2], argv[3]) : farcell::measure(argv[1], options);
  if (!done) std::fprintf(stderr, "%s\n", done.error().message.c_str());
  return done ? 0 : 1;
}
