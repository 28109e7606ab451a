#include "preprocess/build/work_directory.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "preprocess/build/memory_gate.h"
#include "tests/preprocess/read/read_support.h"

namespace farcell::test {
namespace {

TEST(WorkDirectory, BelongsToOneIdentityAndIsEmptiedForAnother) {
  const TempDirectory directory;
  const auto pack = directory.path() / "a.far";
  {
    const WorkDirectory work = WorkDirectory::open("", pack).value();
    EXPECT_EQ(work.path(), directory.path() / "a.far.work");
    EXPECT_FALSE(work.belongsTo("first").value());
    EXPECT_FALSE(work.holdsWork());
    directory.write("a.far.work/cells.0.log", "work");
    EXPECT_TRUE(work.holdsWork());
  }
  {
    const WorkDirectory work = WorkDirectory::open("", pack).value();
    EXPECT_TRUE(work.belongsTo("first").value());
    EXPECT_TRUE(std::filesystem::exists(work.path() / "cells.0.log"));
    EXPECT_FALSE(work.belongsTo("second").value());
    EXPECT_FALSE(std::filesystem::exists(work.path() / "cells.0.log"));
  }
  WorkDirectory work = WorkDirectory::open("", pack).value();
  EXPECT_TRUE(work.remove());
  EXPECT_FALSE(std::filesystem::exists(work.path()));
}

TEST(WorkDirectory, LetsOneBuildIn) {
  const TempDirectory directory;
  const WorkDirectory first = WorkDirectory::open("", directory.path() / "a.far").value();
  const Result<WorkDirectory> second = WorkDirectory::open("", directory.path() / "a.far");
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().kind, ErrorKind::io);
  EXPECT_TRUE(WorkDirectory::open("", directory.path() / "b.far"));
}

TEST(WorkDirectory, ElsewherePacksOfOneNameHaveDirectoriesOfTheirOwn) {
  const TempDirectory directory;
  const auto one = WorkDirectory::placeOf(directory.path(), "/x/a.far");
  const auto two = WorkDirectory::placeOf(directory.path(), "/y/a.far");
  EXPECT_NE(one, two);
  EXPECT_EQ(one, WorkDirectory::placeOf(directory.path(), "/x/../x/a.far"));
  EXPECT_EQ(one.parent_path(), directory.path());
}

TEST(MemoryGate, NeverGivesOutMoreThanThereIs) {
  MemoryGate gate(100);
  std::atomic<int> taken{0}, most{0};
  const auto work = [&] {
    for (int i = 0; i < 200; ++i) {
      const auto share = gate.take(40, "work");
      ASSERT_TRUE(share);
      const int now = taken += 40;
      for (int seen = most; seen < now && !most.compare_exchange_weak(seen, now);) {
      }
      std::this_thread::yield();
      taken -= 40;
    }
  };
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
  EXPECT_LE(most, 100);
  EXPECT_EQ(most, 80) << "two at once fit";
}

TEST(MemoryGate, RefusesWhatWillNeverFit) {
  MemoryGate gate(100);
  const auto share = gate.take(101, "baking a view");
  ASSERT_FALSE(share);
  EXPECT_EQ(share.error().kind, ErrorKind::exhausted);
  EXPECT_NE(share.error().message.find("baking a view"), std::string::npos);
}

}  // namespace
}  // namespace farcell::test
