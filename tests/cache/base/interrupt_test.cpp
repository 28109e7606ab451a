#include "cache/base/interrupt.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>

namespace farcell {
namespace {

// Each in a child process: the flag cannot be taken back.
TEST(InterruptDeathTest, WithoutASignalWorkGoesOn) {
  installInterruptHandler();
  EXPECT_FALSE(interrupted());
  EXPECT_TRUE(checkInterrupt());
}

TEST(InterruptDeathTest, TheFirstSignalIsAnErrorOfKindCancelled) {
  for (const int signal : {SIGINT, SIGTERM}) {
    EXPECT_EXIT(
        {
          installInterruptHandler();
          ::raise(signal);
          const auto result = checkInterrupt();
          ::_exit(interrupted() && !result && result.error().kind == ErrorKind::cancelled ? 0 : 1);
        },
        testing::ExitedWithCode(0), "");
  }
}

TEST(InterruptDeathTest, TheSecondSignalOfEitherKindKills) {
  for (const int second : {SIGINT, SIGTERM}) {
    EXPECT_EXIT(
        {
          installInterruptHandler();
          ::raise(SIGINT);
          ::raise(second);
          ::_exit(0);
        },
        testing::KilledBySignal(second), "");
  }
}

}  // namespace
}  // namespace farcell
