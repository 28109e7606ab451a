#include "runtime/frame_image.h"

#include <gtest/gtest.h>

#include <cmath>

namespace farcell {
namespace {

TEST(FrameImage, coverageBlendsWithTheBackground) {
  const std::vector<uint8_t> rgba = {0, 0, 0, 0, 10, 20, 30, 255, 50, 60, 70, 128};
  const auto result = overBackground(rgba, {200, 100, 0});
  EXPECT_EQ((std::vector<uint8_t>(result.begin(), result.begin() + 6)),
            (std::vector<uint8_t>{200, 100, 0, 10, 20, 30}));
  EXPECT_NEAR(result[6], 50 + 200 * 127 / 255.0, 0.51);
  EXPECT_NEAR(result[7], 60 + 100 * 127 / 255.0, 0.51);
  EXPECT_EQ(result[8], 70);
}

}  // namespace
}  // namespace farcell
