#include "preprocess/measure/picture.h"

#include <gtest/gtest.h>

namespace farcell {
namespace {

Picture filled(int edge, glm::vec4 colour) {
  Picture picture(edge);
  for (glm::vec4& pixel : picture.rgba) pixel = colour;
  return picture;
}

TEST(Pictures, aBakedRectangleLiesInItsPlace) {
  BakedView baked;
  baked.x0 = 1, baked.y0 = 2, baked.width = 2, baked.height = 1;
  baked.rgba = {0.1f, 0.2f, 0.3f, 1, 0.4f, 0.5f, 0.6f, 0.5f};
  const Picture picture = pictureOf(baked, 4);
  for (size_t i = 0; i < 16; ++i)
    EXPECT_EQ(picture.rgba[i], i == 9    ? glm::vec4(0.1f, 0.2f, 0.3f, 1)
                               : i == 10 ? glm::vec4(0.4f, 0.5f, 0.6f, 0.5f)
                                         : glm::vec4(0));
}

TEST(Pictures, halvedIsTheMeanOfFour) {
  Picture picture(4);
  for (size_t i = 0; i < 16; ++i) picture.rgba[i] = glm::vec4(static_cast<float>(i));
  const Picture half = halved(picture);
  ASSERT_EQ(half.edge, 2);
  EXPECT_EQ(half.rgba[0].x, 2.5f);   // 0 1 4 5
  EXPECT_EQ(half.rgba[3].w, 12.5f);  // 10 11 14 15
}

TEST(Pictures, errorsAreOfWhatIsSeenOverTheBackground) {
  const OwnPixels all(Picture(2), Picture(2));
  const Picture white = filled(2, glm::vec4(1)), nothing(2);
  ErrorSum same, holes;
  same.add(white, white, all);
  holes.add(white, nothing, all);
  EXPECT_EQ(same.error, 0);
  EXPECT_EQ(same.covered, 4);
  EXPECT_NEAR(holes.error, 4 * ((255 - 179) + (255 - 204) + (255 - 230)), 1e-3) << "the background shows through";
  ErrorSum sparse;
  sparse.add(white, nothing, all, 2);
  EXPECT_NEAR(sparse.error * 4, holes.error, 1e-3);
  EXPECT_EQ(sparse.covered, 1);
}

TEST(Pictures, onlyOwnPixelsCount) {
  Picture alone(4), amongOthers(4);
  alone.rgba[5] = glm::vec4(1);
  amongOthers.rgba[5] = glm::vec4(1);
  amongOthers.rgba[10] = glm::vec4(0.5f);  // a neighbour's
  const OwnPixels own(alone, amongOthers);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) EXPECT_EQ(own.at(4, x, y), !(x == 2 && y == 2));
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 2; ++x) EXPECT_EQ(own.at(2, x, y), !(x == 1 && y == 1));
  EXPECT_FALSE(own.at(1, 0, 0));
  ErrorSum sum;
  sum.add(amongOthers, Picture(4), own);
  EXPECT_EQ(sum.covered, 1);
}

}  // namespace
}  // namespace farcell
