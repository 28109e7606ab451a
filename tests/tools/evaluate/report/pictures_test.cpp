#include "tools/evaluate/report/pictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "tests/support/evaluate_directory.h"
#include "tools/evaluate/report/names.h"
#include "tools/image/png.h"

namespace farcell {
namespace {

TEST(FileStems, KeepPlainNames) {
  EXPECT_EQ(fileStems({"auto-01", "Street_3"}), (std::vector<std::string>{"auto-01", "Street_3"}));
}

TEST(FileStems, HostileNamesCannotLeaveTheDirectory) {
  const std::vector<std::string> names = {"../x",
                                          "/etc/passwd",
                                          "..",
                                          ".",
                                          "",
                                          "a\\b",
                                          "con:",
                                          std::string("a\0b", 3),
                                          "\x1b[0m",
                                          "\xc3\xa9t\xc3\xa9",
                                          std::string(5000, 'y'),
                                          "-rf",
                                          "a b",
                                          "~"};
  std::set<std::string> seen;
  for (const std::string& stem : fileStems(names)) {
    EXPECT_FALSE(stem.empty());
    EXPECT_LE(stem.size(), 70u);
    for (const char c : stem)
      EXPECT_TRUE(std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_') << stem;
    EXPECT_TRUE(seen.insert(stem).second) << stem << " twice";
  }
}

TEST(FileStems, RepetitionsAreKeptApartEvenWhereCaseDoesNotCount) {
  const std::vector<std::string> stems = fileStems({"a", "A", "a", "a-2", "a!", "a?"});
  std::set<std::string> seen;
  for (std::string stem : stems) {
    std::transform(stem.begin(), stem.end(), stem.begin(), [](unsigned char c) { return std::tolower(c); });
    EXPECT_TRUE(seen.insert(stem).second) << stem;
  }
  EXPECT_EQ(stems[0], "a");
}

TEST(Pictures, HoldWhatIsComparedAndTheAmplifiedDifference) {
  const testing::TemporaryDirectory directory;
  ReferenceImage reference{2, 1, {100, 50, 0, 10, 10, 10}, {1, 0.5f}};
  const std::vector<uint8_t> rgba = {90, 50, 80, 255, 0, 0, 0, 0};
  const TestImage test{2, 1, rgba, {}};
  const Colour background = {200, 200, 200};
  const std::vector<float> flip = {0, 1};
  ASSERT_TRUE(writeReferencePicture(directory.path(), "cam", reference, background));
  ASSERT_TRUE(writeRendererPictures(directory.path(), {"cam", "A", test, flip}, reference, background));
  const auto truth = readPng(directory.path() / "cam.reference.png", 100);
  const auto own = readPng(directory.path() / "cam.A.png", 100);
  const auto difference = readPng(directory.path() / "cam.A.difference.png", 100);
  const auto map = readPng(directory.path() / "cam.A.flip.png", 100);
  ASSERT_TRUE(truth && own && difference && map);
  EXPECT_EQ(truth->pixels, (std::vector<uint8_t>{100, 50, 0, 110, 110, 110}));
  EXPECT_EQ(own->pixels, (std::vector<uint8_t>{90, 50, 80, 200, 200, 200}));
  EXPECT_EQ(difference->pixels, (std::vector<uint8_t>{40, 0, 255, 255, 255, 255}));  // 4 times 10, 0, 80, 90
  EXPECT_EQ(map->pixels, (std::vector<uint8_t>{0, 0, 4, 252, 253, 191})) << "the ends of magma, #000004 and #fcfdbf";
}

}  // namespace
}  // namespace farcell
