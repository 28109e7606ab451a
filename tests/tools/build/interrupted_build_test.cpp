// A build that is killed, or whose disk fails, at every change it makes to its files; and what the same command does
// then.
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <random>
#include <thread>

#include "cache/base/file.h"
#include "tests/preprocess/read/read_support.h"
#include "tests/support/images/encode_image.h"
#include "tests/support/sanitized.h"
#include "tests/tools/build/wavy_model.h"

namespace farcell::test {
namespace {

constexpr const char* kOldPack = "an older pack";

class InterruptedBuild : public testing::Test {
 protected:
  struct Outcome {
    bool killed = false;
    int code = -1;
    std::string err;
  };

  // One thread: calls come in the same order every time.
  Outcome build(const std::string& mesh, const std::string& pack, const std::string& faults = "",
                const std::string& options = "--threads 1 --leaf-triangles 100 --samples 1 --image-size 16") const {
    const std::string command = fmt::format(
        "cd '{}' && exec env {} '{}/farcell-build' {} -o {} --quiet --views 12 {} 2>err.txt >out.txt",
        directory_.path().string(), faults.empty() ? "" : fmt::format("LD_PRELOAD='{}' {}", FARCELL_IO_FAULTS, faults),
        FARCELL_PROGRAMS_DIR, mesh, pack, options);
    const int status = std::system(command.c_str());
    // The shell says of a program that a signal ended what the program would: 128 + signal.
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return {code == 128 + SIGKILL, code, bytes("err.txt")};
  }
  std::string bytes(const std::string& name) const {
    return readTextFile(directory_.path() / name, uint64_t{1} << 30).value_or("");
  }
  void writeOldPack() const { std::ofstream(directory_.path() / "x.far") << kOldPack; }
  bool exists(const std::string& name) const { return std::filesystem::exists(directory_.path() / name); }
  int callsOfWholeBuild() const {
    const Outcome whole = build("wavy.obj", "counted.far", "FARCELL_FAULT_COUNT=count.txt");
    EXPECT_EQ(whole.code, 0) << whole.err;
    return std::atoi(bytes("count.txt").c_str());
  }

  TempDirectory directory_;
};

class FaultyBuild : public InterruptedBuild {
 protected:
  void SetUp() override {
    if (kSanitized) GTEST_SKIP() << "sanitizers want to be the first library of a program";
  }
};

TEST_F(FaultyBuild, KilledAtAnyChangeOfAFileTheSameCommandGivesTheSameBytes) {
  directory_.write("wavy.obj", wavyObj(9));
  ASSERT_EQ(build("wavy.obj", "whole.far").code, 0);
  const std::string whole = bytes("whole.far");
  const int calls = callsOfWholeBuild();
  ASSERT_GT(calls, 20) << "the faults are not loaded";
  for (int at = 1; at <= calls; ++at) {
    writeOldPack();
    const Outcome killed = build("wavy.obj", "x.far", fmt::format("FARCELL_FAULT_KIND=kill FARCELL_FAULT_AT={}", at));
    ASSERT_TRUE(killed.killed) << "call " << at << ": exit code " << killed.code << killed.err;
    const std::string left = bytes("x.far");
    EXPECT_TRUE(left == kOldPack || left == whole) << "call " << at << ": neither the old pack nor the new one";
    const Outcome again = build("wavy.obj", "x.far");
    ASSERT_EQ(again.code, 0) << "call " << at << ": " << again.err;
    EXPECT_TRUE(bytes("x.far") == whole) << "call " << at;
    EXPECT_FALSE(exists("x.far.work") || exists("x.far.partial")) << "call " << at;
  }
}

TEST_F(FaultyBuild, AFullOrBrokenDiskIsAnErrorThatNamesTheFileAndLosesNothing) {
  directory_.write("wavy.obj", wavyObj(9));
  ASSERT_EQ(build("wavy.obj", "whole.far").code, 0);
  const std::string whole = bytes("whole.far");
  const int calls = callsOfWholeBuild();
  for (int at = 1; at <= calls; at += 3) {
    writeOldPack();
    const bool full = at % 2 == 0;
    const Outcome failed = build("wavy.obj", "x.far",
                                 fmt::format("FARCELL_FAULT_KIND={} FARCELL_FAULT_AT={}", full ? "enospc" : "eio", at));
    // The last calls remove what is not needed any more, after the pack is there.
    if (failed.code == 0 && bytes("x.far") == whole) continue;
    ASSERT_EQ(failed.code, 1) << "call " << at << failed.err;
    EXPECT_NE(failed.err.find("x.far"), std::string::npos) << "call " << at << ": " << failed.err;
    EXPECT_NE(failed.err.find(full ? "No space left on device" : "Input/output error"), std::string::npos)
        << "call " << at << ": " << failed.err;
    const std::string left = bytes("x.far");
    EXPECT_TRUE(left == kOldPack || left == whole) << "call " << at;
    const Outcome again = build("wavy.obj", "x.far");
    ASSERT_EQ(again.code, 0) << "call " << at << ": " << again.err;
    EXPECT_TRUE(bytes("x.far") == whole) << "call " << at;
  }
}

TEST_F(FaultyBuild, WritesThatDoLessThanAskedGoOn) {
  directory_.write("wavy.obj", wavyObj(9));
  ASSERT_EQ(build("wavy.obj", "whole.far").code, 0);
  const int calls = callsOfWholeBuild();
  for (int at = 1; at <= calls; at += 3) {
    const Outcome built = build("wavy.obj", "x.far", fmt::format("FARCELL_FAULT_KIND=short FARCELL_FAULT_AT={}", at));
    ASSERT_EQ(built.code, 0) << "call " << at << built.err;
    EXPECT_TRUE(bytes("x.far") == bytes("whole.far")) << "call " << at;
  }
}

// Killed again and again at random times, with other numbers of threads and other memory each time.
// FARCELL_KILLS: how many kills in all. (In the foreground timeout waits until the killed program has let go of its lock.)
TEST_F(InterruptedBuild, KilledAtRandomTimesItStillComesToTheSameBytes) {
  directory_.write("wavy.obj", wavyObj(kSanitized ? 20 : 60));
  const std::string options = "--leaf-triangles 300 --samples 4 --image-size 32";
  ASSERT_EQ(build("wavy.obj", "whole.far", "", options + " --threads 2").code, 0);
  const char* wanted = std::getenv("FARCELL_KILLS");
  const int kills = wanted != nullptr ? std::atoi(wanted) : kSanitized ? 3 : 12;
  const unsigned seed = std::random_device()();
  RecordProperty("seed", static_cast<int>(seed));
  std::mt19937 random(seed);
  int killed = 0;
  for (int attempt = 0; killed < kills && attempt < 20 * kills; ++attempt) {
    const int threads = 1 + static_cast<int>(random() % 3);
    const double seconds = 0.01 + static_cast<double>(random() % 1000) * 0.0003;
    const std::string command = fmt::format(
        "cd '{}' && timeout --foreground -s KILL {:.3f} '{}/farcell-build' wavy.obj -o x.far --quiet --views 12 {} "
        "--threads {} --memory {}M 2>err.txt >out.txt",
        directory_.path().string(), seconds, FARCELL_PROGRAMS_DIR, options, threads, 256 + 128 * (random() % 4));
    const int status = std::system(command.c_str());
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    if (code == 128 + SIGKILL) {
      ++killed;
      continue;
    }
    if (code == 124) continue;  // it ended by itself just then
    ASSERT_EQ(code, 0) << "seed " << seed << bytes("err.txt");
    ASSERT_TRUE(bytes("x.far") == bytes("whole.far")) << "seed " << seed;
    std::filesystem::remove(directory_.path() / "x.far");
  }
  EXPECT_EQ(killed, kills) << "seed " << seed;
  ASSERT_EQ(build("wavy.obj", "x.far", "", options).code, 0);
  EXPECT_TRUE(bytes("x.far") == bytes("whole.far")) << "seed " << seed;
}

TEST_F(FaultyBuild, AnotherInputOrSettingStartsAnew) {
  directory_.write("wavy.obj", wavyObj(9));
  ASSERT_TRUE(build("wavy.obj", "x.far", "FARCELL_FAULT_KIND=kill FARCELL_FAULT_AT=20").killed);
  ASSERT_TRUE(exists("x.far.work"));
  directory_.write("wavy.obj", wavyObj(8));
  ASSERT_EQ(build("wavy.obj", "x.far").code, 0);
  ASSERT_EQ(build("wavy.obj", "fresh.far").code, 0);
  EXPECT_TRUE(bytes("x.far") == bytes("fresh.far"));
}

TEST_F(FaultyBuild, AnInputThatIsAwayForAWhileLosesNothing) {
  const auto mesh = directory_.write("wavy.obj", wavyObj(9)), away = directory_.path() / "away.obj";
  ASSERT_EQ(build("wavy.obj", "whole.far").code, 0);
  ASSERT_TRUE(build("wavy.obj", "x.far", "FARCELL_FAULT_KIND=kill FARCELL_FAULT_AT=20").killed);
  std::filesystem::rename(mesh, away);
  const Outcome gone = build("wavy.obj", "x.far");
  EXPECT_EQ(gone.code, 1);
  EXPECT_NE(gone.err.find("wavy.obj"), std::string::npos) << gone.err;
  ASSERT_TRUE(exists("x.far.work/identity"));
  std::filesystem::rename(away, mesh);
  ASSERT_EQ(build("wavy.obj", "x.far").code, 0);
  EXPECT_TRUE(bytes("x.far") == bytes("whole.far"));
}

// After the partition neither meshes nor images are read again: what they hold could as well be something else.
TEST_F(FaultyBuild, GoingOnAfterThePartitionDoesNotReadTheInputAgain) {
  const auto mesh = directory_.write(
      "wavy.obj", "mtllib wavy.mtl\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl skin\n" + wavyObj(9) + "f 1/1 2/2 11/3\n");
  directory_.write("wavy.mtl", "newmtl skin\nmap_Kd skin.png\n");
  const auto image = directory_.write(
      "skin.png", encodeImage("png", {70, 50, 3, 8}, [](int x, int y, int c) { return (x * y + 90 * c) % 256; }));
  ASSERT_EQ(build("wavy.obj", "whole.far").code, 0);
  const int calls = callsOfWholeBuild();
  ASSERT_TRUE(build("wavy.obj", "x.far", fmt::format("FARCELL_FAULT_KIND=kill FARCELL_FAULT_AT={}", calls - 8)).killed);
  for (const auto& file : {mesh, image}) {
    const auto written = std::filesystem::last_write_time(file);
    std::fstream(file, std::ios::in | std::ios::out) << "nothing of use";
    std::filesystem::last_write_time(file, written);
  }
  const Outcome again = build("wavy.obj", "x.far");
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_TRUE(bytes("x.far") == bytes("whole.far"));
}

TEST_F(InterruptedBuild, TwoBuildsDoNotWorkInOneDirectory) {
  directory_.write("wavy.obj", wavyObj(kSanitized ? 12 : 40));
  const std::string options = "--leaf-triangles 300 --samples 16 --threads 1 --image-size 128";
  const std::string first =
      fmt::format("cd '{}' && '{}/farcell-build' wavy.obj -o x.far --quiet --views 12 {} 2>first.txt >out.txt &",
                  directory_.path().string(), FARCELL_PROGRAMS_DIR, options);
  ASSERT_EQ(std::system(first.c_str()), 0);
  for (int wait = 0; wait < 500 && !exists("x.far.work/identity"); ++wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const Outcome second = build("wavy.obj", "x.far", "", options);
  EXPECT_EQ(second.code, 1);
  EXPECT_NE(second.err.find("no other"), std::string::npos) << second.err;
  for (int wait = 0; wait < 12000 && exists("x.far.work"); ++wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_TRUE(exists("x.far")) << bytes("first.txt");
}

TEST_F(InterruptedBuild, AReadOnlyDirectoryAndAVanishedInputAreClearErrors) {
  directory_.write("wavy.obj", wavyObj(4));
  const Outcome gone = build("gone.obj", "x.far");
  EXPECT_EQ(gone.code, 1);
  EXPECT_NE(gone.err.find("gone.obj"), std::string::npos) << gone.err;
  EXPECT_FALSE(exists("x.far.work"));
  EXPECT_EQ(build("wavy.obj", "nowhere/x.far").code, 1);
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  std::filesystem::create_directory(directory_.path() / "closed");
  std::filesystem::permissions(directory_.path() / "closed", std::filesystem::perms::owner_read);
  const Outcome closed = build("wavy.obj", "closed/x.far");
  EXPECT_EQ(closed.code, 1);
  EXPECT_NE(closed.err.find("closed"), std::string::npos) << closed.err;
}

}  // namespace
}  // namespace farcell::test
