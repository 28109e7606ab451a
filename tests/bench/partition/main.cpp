// Rate, phases and peak memory of the partition, for files and for shapes that are hard on it.
// usage: bench_partition [--threads N] [--memory MiB] [--leaf N] [--dir PATH] <what>...
// what: a mesh file, or shape:count with shape sphere, shuffled, speck, star, duplicates, covering or strips.
// A line of CSV each: seconds of wall time, MiB; each run is a process of its own, whose peak memory is counted from
// where the mesh is open.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <memory>
#include <string>

#include "preprocess/partition/partition.h"
#include "preprocess/read/open_mesh.h"
#include "tests/support/streamed_meshes.h"

namespace farcell {
namespace {

struct Options {
  int threads = 2;
  uint64_t memoryMiB = 1024;
  BuildSettings settings;
  std::filesystem::path directory = "bench-partition-work";
};

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

double cpuSeconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// VmRSS or VmHWM, MiB.
double statusMiB(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(name + ":")) return std::stod(line.substr(name.size() + 1)) / 1024;
  return 0;
}

void resetPeak() { std::ofstream("/proc/self/clear_refs") << "5"; }

// The passes of a mesh as the partition asks for them, timed: the first is its measure, the second its spool.
class TimedMesh : public MeshReader {
 public:
  explicit TimedMesh(MeshReader& mesh) : mesh_(mesh) {}
  const MeshInfo& info() const override { return mesh_.info(); }
  std::span<const TextureSource> textures() const override { return mesh_.textures(); }
  std::vector<std::filesystem::path> files() const override { return mesh_.files(); }
  Result<MeshCounts> forEachTriangle(const Sink& sink) override {
    const double start = now();
    auto counts = mesh_.forEachTriangle(sink);
    seconds.push_back(now() - start);
    return counts;
  }
  std::vector<double> seconds;

 private:
  MeshReader& mesh_;
};

Result<std::unique_ptr<MeshReader>> meshNamed(const std::string& what) {
  const auto made = [](StreamedMesh mesh) -> std::unique_ptr<MeshReader> {
    return std::make_unique<StreamedMesh>(std::move(mesh));
  };
  const size_t colon = what.find(':');
  if (colon == std::string::npos) {
    const std::filesystem::path path = what;
    return openMeshes(std::span(&path, 1));
  }
  const std::string shape = what.substr(0, colon);
  const uint64_t count = std::stoull(what.substr(colon + 1));
  if (shape == "sphere") return made(sphereMesh(count, false));
  if (shape == "shuffled") return made(sphereMesh(count, true));
  if (shape == "speck") return made(speckMesh(count));
  if (shape == "star") return made(starMesh(count));
  if (shape == "duplicates") return made(duplicateMesh(count));
  if (shape == "covering") return made(coveringMesh(count));
  if (shape == "strips") return made(stripMesh(count));
  return fail(ErrorKind::invalidArgument, "{}: no such shape", shape);
}

Result<> measure(const std::string& what, const Options& options) {
  FARCELL_ASSIGN(const auto mesh, meshNamed(what));
  double emptyPass = now();
  FARCELL_TRY(mesh->forEachTriangle([](std::span<const InputTriangle>) -> Result<> { return {}; }));
  emptyPass = now() - emptyPass;
  TimedMesh timed(*mesh);
  resetPeak();
  const double before = statusMiB("VmRSS"), start = now(), cpu = cpuSeconds();
  Progress silent(false);
  FARCELL_ASSIGN(
      const Partition partition,
      partitionMesh(timed, options.settings, {options.directory, options.threads, options.memoryMiB << 20}, silent));
  const double seconds = now() - start;
  uint64_t pieces = 0, largest = 0;
  for (const Leaf& leaf : partition.leaves) {
    pieces += partition.triangles.size(leaf.list);
    largest = std::max(largest, partition.triangles.size(leaf.list));
  }
  const double triangles = static_cast<double>(partition.counts.accepted);
  std::printf("%s,%.0f,%d,%llu,%.2f,%.2f,%.2f,%.2f,%.2f,%.2f,%.2f,%zu,%llu,%llu,%.0f\n", what.c_str(), triangles,
              options.threads, static_cast<unsigned long long>(options.memoryMiB), emptyPass, timed.seconds[0],
              timed.seconds[1], partition.splitSeconds, seconds, cpuSeconds() - cpu, triangles / seconds / 1e6,
              partition.leaves.size(), static_cast<unsigned long long>(pieces),
              static_cast<unsigned long long>(largest), statusMiB("VmHWM") - before);
  return {};
}

int run(const std::string& what, const Options& options) {
  std::error_code ignored;
  std::filesystem::remove_all(options.directory, ignored);
  std::filesystem::create_directories(options.directory, ignored);
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    const Result<> done = measure(what, options);
    if (!done) std::fprintf(stderr, "%s: %s\n", what.c_str(), done.error().message.c_str());
    std::fflush(stdout);
    _exit(done ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  std::filesystem::remove_all(options.directory, ignored);
  return status == 0 ? 0 : 1;
}

int benchMain(std::span<char*> arguments) {
  Options options;
  int failures = 0;
  std::printf(
      "what,triangles,threads,memoryMiB,emptyPass,measure,spool,split,total,cpu,Mtri/"
      "s,leaves,pieces,largestLeaf,peakMiB\n");
  for (size_t i = 1; i < arguments.size(); ++i) {
    const std::string argument = arguments[i];
    if (!argument.starts_with("--")) {
      failures += run(argument, options);
      continue;
    }
    const std::string value = ++i < arguments.size() ? arguments[i] : "";
    if (argument == "--threads") options.threads = std::stoi(value);
    if (argument == "--memory") options.memoryMiB = std::stoull(value);
    if (argument == "--leaf") options.settings.leafTriangles = std::stoi(value);
    if (argument == "--dir") options.directory = value;
  }
  return failures > 0 ? 1 : 0;
}

}  // namespace
}  // namespace farcell

int main(int argc, char** argv) { return farcell::benchMain({argv, static_cast<size_t>(argc)}); }
