// --memory is a ceiling on the peak of the resident memory of farcell-build, as the kernel counts it, whatever the
// model. FARCELL_TRIANGLES: of each model; default 400,000. By hand with 1000000 and more.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

#include "cache/pack/pack_file.h"
#include "tests/preprocess/read/read_support.h"
#include "tests/support/sanitized.h"
#include "tests/support/streamed_meshes.h"

extern char** environ;

namespace farcell::test {
namespace {

constexpr uint64_t kMemoryMiB = 192;  // the least that farcell-build takes

uint64_t triangleCount() {
  const char* text = std::getenv("FARCELL_TRIANGLES");
  return text != nullptr ? std::strtoull(text, nullptr, 10) : 400'000;
}

// Binary STL: corners as floats, no vertices that could be shared.
void writeStl(const std::filesystem::path& path, StreamedMesh mesh) {
  std::ofstream out(path, std::ios::binary);
  out.write(std::string(80, ' ').data(), 80);
  const auto count = static_cast<uint32_t>(mesh.info().declaredTriangles);
  out.write(reinterpret_cast<const char*>(&count), 4);
  const auto write = [&](std::span<const InputTriangle> batch) -> Result<> {
    for (const InputTriangle& triangle : batch) {
      std::array<char, 50> record{};
      for (size_t k = 0; k < 3; ++k) {
        const glm::vec3 corner(triangle.positions[k]);
        std::memcpy(record.data() + 12 + 12 * k, &corner, 12);
      }
      out.write(record.data(), record.size());
    }
    return {};
  };
  ASSERT_TRUE(mesh.forEachTriangle(write));
}

struct Ended {
  int code = -1;
  uint64_t peakBytes = 0;
};

Ended runBuild(const std::filesystem::path& mesh, const std::filesystem::path& pack, const std::string& options) {
  std::vector<std::string> words = {
      FARCELL_PROGRAMS_DIR "/farcell-build", mesh.string(), "-o", pack.string(), "--progress", "none", "--json"};
  std::istringstream in(options);
  for (std::string word; in >> word;) words.push_back(word);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  Ended ended;
  if (::posix_spawn(&child, words[0].c_str(), &actions, nullptr, arguments.data(), environ) == 0) {
    int status = 0;
    rusage usage{};
    if (::wait4(child, &status, 0, &usage) == child && WIFEXITED(status))
      ended = {WEXITSTATUS(status), static_cast<uint64_t>(usage.ru_maxrss) << 10};
  }
  posix_spawn_file_actions_destroy(&actions);
  return ended;
}

struct Shape {
  const char* name;
  StreamedMesh (*make)(uint64_t);
};
void PrintTo(const Shape& shape, std::ostream* out) { *out << shape.name; }

class MemoryOf : public testing::TestWithParam<Shape> {};

TEST_P(MemoryOf, TheWholeBuildStaysBelowTheCeiling) {
  if (kSanitized) GTEST_SKIP() << "sanitizers take memory of their own";
  const TempDirectory directory;
  const auto mesh = directory.path() / "shape.stl", pack = directory.path() / "shape.far";
  ASSERT_NO_FATAL_FAILURE(writeStl(mesh, GetParam().make(triangleCount())));
  const Ended built =
      runBuild(mesh, pack, fmt::format("--memory {}M --threads 2 --views 12 --image-size 64 --samples 4", kMemoryMiB));
  ASSERT_EQ(built.code, 0);
  RecordProperty("peakMiB", static_cast<int>(built.peakBytes >> 20));
  EXPECT_LE(built.peakBytes, kMemoryMiB << 20);
  const auto opened = PackFile::open(pack);
  ASSERT_TRUE(opened) << opened.error().message;
  EXPECT_GT(opened->directory().report.inputTriangles, 0u);
}

INSTANTIATE_TEST_SUITE_P(Shapes, MemoryOf,
                         testing::Values(Shape{"Coherent", [](uint64_t n) { return sphereMesh(n, false); }},
                                         Shape{"Shuffled", [](uint64_t n) { return sphereMesh(n, true); }},
                                         Shape{"AllInOneLeafCube", speckMesh}, Shape{"AllThroughOnePoint", starMesh},
                                         Shape{"Duplicates", duplicateMesh},
                                         Shape{"EachOverTheWholeModel", coveringMesh}, Shape{"Slivers", stripMesh}),
                         [](const auto& shape) { return std::string(shape.param.name); });

}  // namespace
}  // namespace farcell::test
