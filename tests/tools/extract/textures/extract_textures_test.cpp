#include "tools/extract/textures/extract_textures.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

#include "tests/cache/pack/samples.h"
#include "tools/image/png.h"

namespace farcell {
namespace {

using Json = nlohmann::ordered_json;

class ExtractTextures : public testing::Test {
 protected:
  void SetUp() override {
    directory_ = std::filesystem::temp_directory_path() / fmt::format("farcell_textures_{}", ::getpid());
    std::filesystem::create_directory(directory_);
    // Every texel says where it is.
    for (uint32_t level = 0; level < sample_.atlas.levels.size(); ++level)
      for (uint32_t i = 0; i < sample_.atlas.levels[level].size(); ++i)
        sample_.atlas.levels[level][i] = static_cast<uint8_t>(i * 7 + i / 251 + level);
    samples::write(sample_, directory_ / "a.far");
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  int run(const std::string& arguments) const {
    const std::string command = fmt::format("cd '{}' && '{}/farcell-extract' {} >out.txt 2>err.txt",
                                            directory_.string(), FARCELL_PROGRAMS_DIR, arguments);
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::filesystem::path directory_;
  samples::FullPack sample_ = samples::fullPack();
};

TEST_F(ExtractTextures, AreTheAtlasesUprightAndSharedOnesOnce) {
  const auto pack = PackFile::open(directory_ / "a.far");
  ASSERT_TRUE(pack) << pack.error().message;
  EXPECT_EQ(cellsWithTextures(pack->directory()), (std::vector<uint32_t>{1, 2}));
  for (const uint32_t level : {0u, 2u, 5u}) {
    const uint32_t expected = std::min(level, sample_.atlas.levelCount - 1);
    TextureExtraction settings{{0, 1, 2}, level, "png", directory_ / fmt::format("out{}", level)};
    const auto result = extractTextures(*pack, settings);
    ASSERT_TRUE(result) << result.error().message;
    const Json& written = (*result)["written"];
    ASSERT_EQ(written.size(), 2u) << "the root has none";
    EXPECT_EQ(written[0]["file"], written[1]["file"]) << "the leaves look at the same";
    EXPECT_EQ(written[1]["cell"], 2);
    EXPECT_EQ(written[1]["level"], expected);
    const auto picture = readPng(written[0]["file"].get<std::string>(), 1 << 20);
    ASSERT_TRUE(picture) << picture.error().message;
    const int width = static_cast<int>(sample_.atlas.width >> expected);
    const int height = static_cast<int>(sample_.atlas.height >> expected);
    ASSERT_EQ(picture->width, width);
    ASSERT_EQ(picture->height, height);
    ASSERT_EQ(picture->channels, 3);
    const auto rowBytes = static_cast<size_t>(3 * width);
    for (size_t row = 0; row < static_cast<size_t>(height); ++row) {
      const auto pixels = std::span(picture->pixels).subspan(row * rowBytes, rowBytes);
      const auto texels = std::span(sample_.atlas.levels[expected])
                              .subspan((static_cast<size_t>(height) - 1 - row) * rowBytes, rowBytes);
      ASSERT_TRUE(std::equal(pixels.begin(), pixels.end(), texels.begin())) << row;
    }
  }
}

TEST_F(ExtractTextures, OfTheProgramAreNotMixedWithViews) {
  ASSERT_EQ(run("a.far --textures --level 1 -o out --json"), 0)
      << readTextFile(directory_ / "err.txt", 1 << 16).value();
  const Json json = Json::parse(readTextFile(directory_ / "out.txt", 1 << 16).value());
  ASSERT_EQ(json["written"].size(), 2u);
  EXPECT_EQ(json["written"][0]["width"], sample_.atlas.width / 2);
  EXPECT_EQ(run("a.far --textures --cell 0 -o out"), 0) << "a cell without textures has no pictures";
  EXPECT_EQ(readTextFile(directory_ / "out.txt", 1 << 16).value(), "");
  for (const char* misuse : {"--textures --views 1", "--textures --atlas", "--textures --level 6", "--level 1"})
    EXPECT_EQ(run(fmt::format("a.far -o out {}", misuse)), 2) << misuse;
}

}  // namespace
}  // namespace farcell
