// farcell build --mpi: several processes, the same bytes.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>

#include "cache/base/file.h"
#include "tests/preprocess/read/read_support.h"
#include "tests/tools/build/wavy_model.h"

namespace farcell::test {
namespace {

constexpr const char* kOptions = "--leaf-triangles 200 --samples 4 --views 12 --image-size 32 --progress none";

class MpiBuild : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(FARCELL_PROGRAMS_DIR "/farcell-build-mpi")) GTEST_SKIP() << "built without MPI";
    if (std::system("mpirun --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "there is no mpirun";
    directory_.write("wavy.obj", wavyObj(30));
  }

  int run(const std::string& command) const {
    const std::string whole = fmt::format("cd '{}' && {} >out.txt 2>err.txt", directory_.path().string(), command);
    const int status = std::system(whole.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  // Processes as root and more than there are cores: a test's business only.
  int runMpi(int processes, const std::string& arguments) const {
    return run(
        fmt::format("OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --oversubscribe -n {} "
                    "'{}/farcell-build' --mpi {} {}",
                    processes, FARCELL_PROGRAMS_DIR, arguments, kOptions));
  }
  std::string bytes(const std::string& name) const {
    return readTextFile(directory_.path() / name, uint64_t{1} << 30).value_or("");
  }

  TempDirectory directory_;
};

TEST_F(MpiBuild, FourProcessesGiveTheBytesOfOne) {
  ASSERT_EQ(run(fmt::format("'{}/farcell-build' wavy.obj -o one.far {}", FARCELL_PROGRAMS_DIR, kOptions)), 0)
      << bytes("err.txt");
  ASSERT_EQ(runMpi(4, "wavy.obj -o four.far --threads 1"), 0) << bytes("err.txt");
  EXPECT_TRUE(bytes("one.far") == bytes("four.far"));
  EXPECT_FALSE(std::filesystem::exists(directory_.path() / "four.far.work"));
}

TEST_F(MpiBuild, AnErrorOfTheLeaderEndsAllWithItsMessage) {
  directory_.write("bad.obj", "v 0 0 0\nf 1 1 1\n");
  EXPECT_NE(runMpi(3, "bad.obj -o bad.far --threads 1"), 0);
  EXPECT_NE(bytes("err.txt").find("expected at least one triangle"), std::string::npos) << bytes("err.txt");
  EXPECT_FALSE(std::filesystem::exists(directory_.path() / "bad.far"));
}

// A rank is killed as soon as it has stored something; the run ends, and other processes go on with what is there.
TEST_F(MpiBuild, ALostProcessEndsTheRunAndTheNextGoesOn) {
  directory_.write("large.obj", wavyObj(80));
  ASSERT_EQ(run(fmt::format("'{}/farcell-build' large.obj -o one.far {}", FARCELL_PROGRAMS_DIR, kOptions)), 0)
      << bytes("err.txt");
  const std::string killer = fmt::format(
      "{{ (for i in $(seq 1000); do [ -s two.far.work/cells.1.log ] && break; sleep 0.01; done; "
      "for p in $(pgrep -f 'farcell-build.*large.obj -o two.far'); do "
      "grep -qz OMPI_COMM_WORLD_RANK=1 /proc/$p/environ && kill -9 $p; done) >killer.txt 2>&1 & ");
  const int code =
      run(killer + fmt::format("OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --oversubscribe -n 2 "
                               "'{}/farcell-build' --mpi large.obj -o two.far --threads 1 {}; }}",
                               FARCELL_PROGRAMS_DIR, kOptions));
  if (code == 0) GTEST_SKIP() << "the run was over before its process could be killed";
  EXPECT_FALSE(bytes("err.txt").empty());
  EXPECT_FALSE(std::filesystem::exists(directory_.path() / "two.far"));
  ASSERT_TRUE(std::filesystem::exists(directory_.path() / "two.far.work"));
  ASSERT_EQ(runMpi(3, "large.obj -o two.far --threads 1"), 0) << bytes("err.txt");
  EXPECT_TRUE(bytes("one.far") == bytes("two.far"));
}

}  // namespace
}  // namespace farcell::test
