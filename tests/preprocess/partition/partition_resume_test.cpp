// The same leaves from any number of threads, in any memory, and after a crash at any write.
#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <random>

#include "cache/base/hash.h"
#include "preprocess/partition/partition.h"
#include "tests/support/sanitized.h"
#include "tests/support/streamed_meshes.h"
#include "tests/support/temporary_directory.h"

namespace {
// Calls that change the disk until the process dies in the middle of one, or until they fail; 0: never.
std::atomic<int> gCallsUntilDeath{0};
std::atomic<int> gCallsUntilFull{0};
std::atomic<int> gCalls{0};

bool diesNow() {
  ++gCalls;
  return gCallsUntilDeath > 0 && --gCallsUntilDeath == 0;
}
}  // namespace

// In place of those of the C library.
extern "C" ssize_t pwrite(int descriptor, const void* bytes, size_t size, off_t offset) {
  if (diesNow()) {
    ::syscall(SYS_pwrite64, descriptor, bytes, size / 2, offset);
    ::_exit(0);
  }
  if (gCallsUntilFull > 0 && --gCallsUntilFull == 0) {
    errno = ENOSPC;
    return -1;
  }
  return ::syscall(SYS_pwrite64, descriptor, bytes, size, offset);
}
extern "C" int rename(const char* from, const char* to) noexcept {
  if (diesNow()) ::_exit(0);
  return static_cast<int>(::syscall(SYS_rename, from, to));
}

namespace farcell {
namespace {

constexpr uint64_t kGiB = uint64_t{1} << 30;

BuildSettings smallLeaves() {
  BuildSettings settings;
  settings.leafTriangles = 2000;
  return settings;
}

Result<Partition> partitioned(MeshReader& mesh, const std::filesystem::path& directory, int threads,
                              uint64_t memoryBytes, const BuildSettings& settings = smallLeaves()) {
  Progress silent(false);
  return partitionMesh(mesh, settings, {directory, threads, memoryBytes}, silent);
}

template <class T>
void append(std::vector<std::byte>& bytes, const T& value) {
  const auto added = std::as_bytes(std::span(&value, 1));
  bytes.insert(bytes.end(), added.begin(), added.end());
}

// All that a partition gives, as one number.
uint64_t contentOf(const Partition& partition) {
  std::vector<std::byte> bytes;
  append(bytes, partition.grid.origin);
  append(bytes, partition.grid.side);
  append(bytes, partition.bounds);
  append(bytes, partition.counts.accepted);
  for (const Leaf& leaf : partition.leaves) {
    append(bytes, leaf.key);
    append(bytes, leaf.content);
    const GridTriangles list = partition.triangles.read(leaf.list).value();
    EXPECT_EQ(list.size(), partition.triangles.size(leaf.list));
    append(bytes, hashBytes(std::as_bytes(std::span(list.triangles))));
  }
  return hashBytes(bytes);
}

class NoMesh : public MeshReader {
 public:
  const MeshInfo& info() const override { return info_; }
  std::vector<std::filesystem::path> files() const override { return {}; }
  Result<MeshCounts> forEachTriangle(const Sink&) override { return fail(ErrorKind::io, "the mesh was read"); }

 private:
  MeshInfo info_;
};

// More than one segment of the spool, and more than one cell of the split.
StreamedMesh model() { return sphereMesh(150'000, false); }

void copyOver(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::filesystem::remove_all(to);
  std::filesystem::copy(from, to, std::filesystem::copy_options::recursive);
}

TEST(PartitionDeterminism, ThreadsAndMemoryDoNotChangeTheResult) {
  constexpr uint64_t kPart = kSanitized ? 4 : 1;
  const std::vector<std::pair<std::string, StreamedMesh>> meshes = {{"coherent", sphereMesh(400'000 / kPart, false)},
                                                                    {"shuffled", sphereMesh(300'000 / kPart, true)},
                                                                    {"dense", speckMesh(300'000 / kPart)},
                                                                    {"strips", stripMesh(5'000 / kPart)}};
  for (auto [name, mesh] : meshes) {
    SCOPED_TRACE(name);
    std::optional<uint64_t> expected;
    for (const auto& [threads, memory] :
         {std::pair{1, kGiB}, std::pair{2, kGiB}, std::pair{8, kGiB}, std::pair{1, kMinPartitionMemoryBytes},
          std::pair{8, kMinPartitionMemoryBytes}}) {
      const TemporaryDirectory directory;
      const auto partition = partitioned(mesh, directory.path(), threads, memory);
      ASSERT_TRUE(partition) << partition.error().message;
      const uint64_t content = contentOf(*partition);
      EXPECT_EQ(content, expected.value_or(content));
      expected = content;
    }
  }
}

TEST(PartitionMemory, LessThanTheMinimumIsAnError) {
  const TemporaryDirectory directory;
  StreamedMesh mesh = model();
  const auto partition = partitioned(mesh, directory.path(), 1, kMinPartitionMemoryBytes - 1);
  ASSERT_FALSE(partition);
  EXPECT_EQ(partition.error().kind, ErrorKind::exhausted);
}

TEST(PartitionResume, AFinishedPartitionIsLoadedWithoutTheMesh) {
  const TemporaryDirectory directory;
  StreamedMesh mesh = model();
  const uint64_t expected = contentOf(partitioned(mesh, directory.path(), 2, kGiB).value());
  NoMesh none;
  EXPECT_EQ(contentOf(partitioned(none, directory.path(), 2, kGiB).value()), expected);
  EXPECT_EQ(contentOf(loadPartition(directory.path()).value().value()), expected);
  for (const auto& entry : std::filesystem::directory_iterator(directory.path()))
    EXPECT_TRUE(entry.path().filename() == "index" || entry.path().filename() == "leaves") << entry.path();
}

// The child is stopped in the middle of its n-th write or rename, for every n there is.
TEST(PartitionResume, AfterDeathAtAnyWriteTheSameCallGivesTheSame) {
  const TemporaryDirectory whole, work;
  StreamedMesh mesh = model();
  gCalls = 0;
  const uint64_t expected = contentOf(partitioned(mesh, whole.path(), 1, kGiB).value());
  const int calls = gCalls;
  ASSERT_GT(calls, 10);
  for (int call = 1; call <= calls; call += kSanitized ? 5 : 1) {
    SCOPED_TRACE(call);
    std::filesystem::remove_all(work.path());
    std::filesystem::create_directory(work.path());
    const pid_t child = ::fork();
    if (child == 0) {
      gCallsUntilDeath = call;
      partitioned(mesh, work.path(), 1, kGiB).has_value();
      ::_exit(1);  // it should not have come so far
    }
    int status = -1;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_EQ(status, 0);
    const auto resumed = partitioned(mesh, work.path(), 2, kMinPartitionMemoryBytes);
    ASSERT_TRUE(resumed) << resumed.error().message;
    ASSERT_EQ(contentOf(*resumed), expected);
  }
}

TEST(PartitionResume, AFullDiskIsAnErrorThatNamesThePathAndLosesNothing) {
  const TemporaryDirectory directory;
  StreamedMesh mesh = model();
  for (const int calls : {1, 3, 5, 8}) {
    gCallsUntilFull = calls;
    const auto full = partitioned(mesh, directory.path(), 1, kGiB);
    gCallsUntilFull = 0;
    ASSERT_FALSE(full);
    EXPECT_EQ(full.error().kind, ErrorKind::io);
    EXPECT_NE(full.error().message.find(directory.path().string()), std::string::npos) << full.error().message;
  }
  const TemporaryDirectory other;
  EXPECT_EQ(contentOf(partitioned(mesh, directory.path(), 1, kGiB).value()),
            contentOf(partitioned(mesh, other.path(), 1, kGiB).value()));
}

// Whatever byte of what a crash left is wrong, it is noticed.
TEST(PartitionResume, DamageIsNoticed) {
  const uint32_t seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937_64 random(seed);
  const TemporaryDirectory left, work, whole;
  StreamedMesh mesh = model();
  gCalls = 0;
  const uint64_t expected = contentOf(partitioned(mesh, whole.path(), 1, kGiB).value());
  const int calls = gCalls;
  gCallsUntilFull = calls - 7;  // two are renames; in the split, after some of its cells
  ASSERT_FALSE(partitioned(mesh, left.path(), 1, kGiB));
  gCallsUntilFull = 0;
  for (const char* name : {"measure", "spool", "leaves", "journal"}) {
    for (int round = 0; round < (kSanitized ? 1 : 3); ++round) {
      SCOPED_TRACE(name);
      copyOver(left.path(), work.path());
      const std::filesystem::path path = work.path() / name;
      ASSERT_GT(std::filesystem::file_size(path), 0u);
      std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
      const auto at = static_cast<std::streamoff>(random() % std::filesystem::file_size(path));
      file.seekg(at);
      const char wrong = static_cast<char>(file.get() ^ 0x10);
      file.seekp(at);
      file.put(wrong);
      file.close();
      const auto resumed = partitioned(mesh, work.path(), 1, kGiB);
      ASSERT_TRUE(resumed) << resumed.error().message;
      EXPECT_EQ(contentOf(*resumed), expected);
    }
  }
}

TEST(PartitionScratch, TheEstimateIsNearTheTruth) {
  const TemporaryDirectory directory;
  StreamedMesh mesh = model();
  const auto size = [&] {
    uint64_t bytes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(directory.path())) bytes += entry.file_size();
    return bytes;
  };
  gCallsUntilFull = 0;
  StreamedMesh counted = mesh;
  const uint64_t leaves = (partitioned(counted, directory.path(), 1, kGiB).value(), size());
  const uint64_t truth = leaves + 150'000 * 36;
  const uint64_t estimate = scratchBytesEstimate(mesh.info());
  EXPECT_GT(estimate, truth * 9 / 10);
  EXPECT_LT(estimate, truth * 3 / 2);
}

double statusMiB(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(name + ":")) return std::stod(line.substr(name.size() + 1)) / 1024;
  return -1;
}

TEST(PartitionMemory, ShapesThatAreHardOnItStayBelowTheCeiling) {
  if (kSanitized) GTEST_SKIP() << "sanitizers keep freed memory";
  const std::vector<std::pair<std::string, StreamedMesh>> meshes = {
      {"shuffled", sphereMesh(600'000, true)}, {"speck", speckMesh(400'000)},       {"star", starMesh(300'000)},
      {"duplicates", duplicateMesh(400'000)},  {"covering", coveringMesh(100'000)}, {"strips", stripMesh(30'000)}};
  for (auto [name, mesh] : meshes) {
    SCOPED_TRACE(name);
    const pid_t child = ::fork();
    if (child == 0) {
      const TemporaryDirectory directory;
      std::ofstream("/proc/self/clear_refs") << "5";
      const double before = statusMiB("VmRSS");
      const auto partition = partitioned(mesh, directory.path(), 8, kMinPartitionMemoryBytes);
      const double grown = statusMiB("VmHWM") - before;
      if (!partition) std::fprintf(stderr, "%s\n", partition.error().message.c_str());
      std::fprintf(stderr, "%s: %.1f MiB\n", name.c_str(), grown);
      std::filesystem::remove_all(directory.path());
      ::_exit(!partition ? 2 : grown > static_cast<double>(kMinPartitionMemoryBytes >> 20) ? 1 : 0);
    }
    int status = -1;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
  }
}

}  // namespace
}  // namespace farcell
