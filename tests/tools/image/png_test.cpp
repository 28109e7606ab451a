#include "tools/image/png.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <random>

namespace farcell {
namespace {

class Png : public testing::Test {
 protected:
  void SetUp() override {
    directory_ = std::filesystem::temp_directory_path() / fmt::format("farcell_png_{}", static_cast<int>(getpid()));
    std::filesystem::create_directory(directory_);
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }
  std::filesystem::path at(const std::string& name) const { return directory_ / name; }

  std::filesystem::path directory_;
};

TEST_F(Png, everyByteComesBackForOneThreeAndFourChannels) {
  const unsigned seed = 21;
  SCOPED_TRACE(fmt::format("seed {}", seed));
  std::mt19937 random(seed);
  for (const int channels : {1, 3, 4}) {
    Picture picture{37, 23, channels, {}};
    for (int i = 0; i < 37 * 23 * channels; ++i) picture.pixels.push_back(static_cast<uint8_t>(random()));
    ASSERT_TRUE(writePng(at("a.png"), picture));
    const auto back = readPng(at("a.png"), 37 * 23);
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(back->width, 37);
    EXPECT_EQ(back->height, 23);
    EXPECT_EQ(back->channels, channels);
    // Colours under a small or zero alpha too: nothing is multiplied on the way.
    EXPECT_EQ(back->pixels, picture.pixels);
  }
}

TEST_F(Png, aPictureLargerThanAllowedIsRefused) {
  ASSERT_TRUE(writePng(at("a.png"), {8, 8, 1, std::vector<uint8_t>(64)}));
  const auto result = readPng(at("a.png"), 63);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, ErrorKind::exhausted);
}

TEST_F(Png, whatIsNoPngIsAnError) {
  EXPECT_EQ(readPng(at("none.png"), 64).error().kind, ErrorKind::notFound);
  EXPECT_FALSE(readPng(directory_, 64));
  std::ofstream(at("text.png")) << "not a picture at all, but long enough to have been one";
  EXPECT_EQ(readPng(at("text.png"), 64).error().kind, ErrorKind::corrupt);
  std::ofstream(at("empty.png")).close();
  EXPECT_FALSE(readPng(at("empty.png"), 64));
  EXPECT_FALSE(writePng(at("missing") / "a.png", {1, 1, 1, {0}}));
}

TEST_F(Png, aTruncatedFileIsAnErrorOrShortAndNeverACrash) {
  Picture picture{16, 16, 3, {}};
  std::mt19937 random(4);
  for (int i = 0; i < 16 * 16 * 3; ++i) picture.pixels.push_back(static_cast<uint8_t>(random()));
  ASSERT_TRUE(writePng(at("a.png"), picture));
  std::ifstream file(at("a.png"), std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), {});
  for (size_t length = 0; length < bytes.size() - 20; length += 7) {
    std::ofstream(at("cut.png"), std::ios::binary) << bytes.substr(0, length);
    EXPECT_FALSE(readPng(at("cut.png"), 256)) << length << " of " << bytes.size();
  }
}

}  // namespace
}  // namespace farcell
