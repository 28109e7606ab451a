#include "tools/evaluate/plan/suns.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace farcell {
namespace {

TEST(SkySuns, standApartAboveTheHorizonAndAroundTheWholeSky) {
  for (const int count : {1, 2, 8, 40}) {
    const std::vector<Sun> suns = skySuns(count);
    ASSERT_EQ(static_cast<int>(suns.size()), count);
    glm::vec3 sum(0);
    for (size_t i = 0; i < suns.size(); ++i) {
      EXPECT_TRUE(isSun(suns[i]));
      const glm::vec3 direction = sunDirection(UpAxis::z, suns[i]);
      EXPECT_GT(direction.z, 0);
      EXPECT_LT(direction.z, 1);
      sum += direction;
      // Of points spread evenly over a half sphere none are nearer than about the edge of a square of their share.
      for (size_t k = 0; k < i; ++k)
        EXPECT_GT(glm::distance(direction, sunDirection(UpAxis::z, suns[k])), 1.2 / std::sqrt(count));
    }
    const glm::vec3 mean = sum / static_cast<float>(count);
    EXPECT_NEAR(mean.z, 0.5, 1e-5);  // of a half sphere
    if (count >= 8) {
      EXPECT_LT(std::hypot(mean.x, mean.y), 0.15) << count;
    }
  }
  EXPECT_TRUE(skySuns(0).empty());
}

}  // namespace
}  // namespace farcell
