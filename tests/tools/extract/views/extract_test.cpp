#include "tools/extract/views/extract.h"

#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <set>

#include "cache/base/file.h"
#include "tests/support/synthetic_pack.h"

namespace farcell {
namespace {

using Json = nlohmann::ordered_json;

class ExtractTest : public testing::Test {
 protected:
  void SetUp() override {
    directory_ = std::filesystem::temp_directory_path() / fmt::format("farcell_extract_{}", static_cast<int>(getpid()));
    std::filesystem::create_directory(directory_);
    // A green box whose texels at the edges are covered in part.
    const auto written = writeSyntheticPack(directory_ / "a.far", boxTriangles({-1, -1, -1}, {1, 0.5, 0.7}, 0x0020c040),
                                            {.level = 1, .views = 12, .imageSize = 32, .samplesPerEdge = 3});
    ASSERT_TRUE(written) << written.error().message;
    auto opened = PackFile::open(directory_ / "a.far");
    ASSERT_TRUE(opened) << opened.error().message;
    pack_.emplace(std::move(*opened));
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  ExtractSettings settings(std::vector<uint32_t> cells, std::vector<uint32_t> views) const {
    ExtractSettings wanted;
    wanted.cells = std::move(cells);
    wanted.views = std::move(views);
    wanted.directory = directory_ / "out";
    return wanted;
  }
  Json extract(const ExtractSettings& settings) const {
    auto result = extractViews(*pack_, settings);
    if (!result) throw std::runtime_error(result.error().message);
    return std::move(*result);
  }
  static Picture pictureOf(const Json& file) {
    auto picture = readPng(file["file"].get<std::string>(), 1 << 24);
    if (!picture) throw std::runtime_error(picture.error().message);
    return std::move(*picture);
  }
  ViewImage stored(uint32_t cell, uint32_t view) const {
    const CellRecord& record = pack_->directory().cells[cell];
    for (uint32_t page = record.firstViewPage; page < record.firstViewPage + record.viewPageCount; ++page) {
      auto content = pack_->readViews(page);
      if (!content) throw std::runtime_error(content.error().message);
      for (ViewImage& image : content->views)
        if (image.view == view) return std::move(image);
    }
    return {.view = view, .rgba = {}, .depth = {}, .normal = {}};
  }
  int run(const std::string& arguments) const {
    const std::string command = fmt::format("{}/farcell-extract {} >{} 2>{}", FARCELL_PROGRAMS_DIR, arguments,
                                            (directory_ / "out.txt").string(), (directory_ / "err.txt").string());
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::filesystem::path directory_;
  std::optional<PackFile> pack_;
};

TEST_F(ExtractTest, EveryTexelOfAViewIsWrittenUpright) {
  const Json result = extract(settings({0}, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}));
  ASSERT_EQ(result["written"].size(), 12u);
  EXPECT_EQ(result["empty"], 0);
  for (const Json& file : result["written"]) {
    const ViewImage view = stored(0, file["view"].get<uint32_t>());
    const Picture picture = pictureOf(file);
    ASSERT_EQ(picture.channels, 4);
    ASSERT_EQ(picture.width, static_cast<int>(view.width));
    ASSERT_EQ(picture.height, static_cast<int>(view.height));
    int partly = 0;
    for (uint32_t y = 0; y < view.height; ++y)
      for (uint32_t x = 0; x < view.width; ++x) {
        const uint8_t* texel = view.rgba.data() + 4 * (y * view.width + x);
        const uint8_t* pixel = picture.pixels.data() + 4 * ((view.height - 1 - y) * view.width + x);
        ASSERT_EQ(pixel[3], texel[3]);
        partly += texel[3] > 0 && texel[3] < 255 ? 1 : 0;
        for (int i = 0; i < 3 && texel[3] > 0; ++i) ASSERT_NEAR(pixel[i] * texel[3] / 255.0, texel[i], 0.51);
      }
    EXPECT_GT(partly, 0);
  }
}

TEST_F(ExtractTest, TheFormatIsTheOneAskedFor) {
  ExtractSettings wanted = settings({0}, {3});
  wanted.format = "tif";
  const std::string file = extract(wanted)["written"][0]["file"].get<std::string>();
  EXPECT_TRUE(file.ends_with(".tif")) << file;
  std::ifstream stream(file, std::ios::binary);
  std::string magic(4, '\0');
  stream.read(magic.data(), 4);
  EXPECT_TRUE(magic == std::string("II*\0", 4) || magic == std::string("MM\0*", 4));
}

TEST_F(ExtractTest, AFullSquareAndAnAtlasHoldTheSameTexelsWhereTheirRectanglesSay) {
  const std::vector<uint32_t> views = {1, 4, 5, 9, 11};
  for (const ViewChannel channel : {ViewChannel::coverage, ViewChannel::depth}) {
    ExtractSettings wanted = settings({0}, views);
    wanted.channel = channel;
    wanted.full = true;
    const Json squares = extract(wanted);
    wanted.atlas = true;
    const Json atlases = extract(wanted);
    ASSERT_EQ(squares["written"].size(), 5u);
    ASSERT_EQ(atlases["written"].size(), 1u);
    const Json beside = Json::parse(*readTextFile(
        directory_ / "out" / (channel == ViewChannel::depth ? "cell-0-depth.json" : "cell-0-coverage.json"), 1 << 20));
    EXPECT_EQ(beside, atlases["written"][0]);
    const Picture atlas = pictureOf(atlases["written"][0]);
    EXPECT_EQ(atlas.width, 3 * 32);
    EXPECT_EQ(atlas.height, 2 * 32);
    for (size_t i = 0; i < views.size(); ++i) {
      const ViewImage view = stored(0, views[i]);
      const Picture square = pictureOf(squares["written"][i]);
      ASSERT_EQ(square.width, 32);
      ASSERT_EQ(square.height, 32);
      const auto checkRectangle = [&](const Picture& picture, const Json& json) {
        const auto corner = json["rectangle"].get<std::array<int, 4>>();
        ASSERT_EQ(corner[2], static_cast<int>(view.width));
        ASSERT_EQ(corner[3], static_cast<int>(view.height));
        for (int y = 0; y < corner[3]; ++y)
          for (int x = 0; x < corner[2]; ++x) {
            const size_t texel = static_cast<size_t>((corner[3] - 1 - y) * corner[2] + x);
            const uint8_t expected = channel == ViewChannel::depth ? view.depth[texel] : view.rgba[4 * texel + 3];
            ASSERT_EQ(picture.pixels[static_cast<size_t>((corner[1] + y) * picture.width + corner[0] + x)], expected);
          }
      };
      checkRectangle(square, squares["written"][i]);
      checkRectangle(atlas, atlases["written"][0]["views"][i]);
      EXPECT_EQ(squares["written"][i]["depth"], Json({view.depthMin, view.depthMax}));
    }
  }
}

TEST_F(ExtractTest, NamesCellsByNumberAndByKey) {
  const Directory& directory = pack_->directory();
  EXPECT_EQ(*parseCells("0", directory), std::vector<uint32_t>{0});
  EXPECT_EQ(*parseCells("0/0/0/0", directory), std::vector<uint32_t>{0});
  const CellKey last = directory.cells.back().key;
  EXPECT_EQ(*parseCells(fmt::format("{}/{}/{}/{}", last.level, last.x, last.y, last.z), directory),
            std::vector<uint32_t>{static_cast<uint32_t>(directory.cells.size() - 1)});
  EXPECT_EQ(parseCells("all", directory)->size(), directory.cells.size());
  for (const char* bad : {"", "-1", "99", "1/2", "1/2/3/4", "0/0/0/0/0", "all ", "4294967296", "0x1"})
    EXPECT_EQ(parseCells(bad, directory).error().kind, ErrorKind::invalidArgument) << bad;
}

TEST_F(ExtractTest, NamesViewsByListsAndRanges) {
  EXPECT_EQ(*parseViews("3,1,5-7,6", 12), (std::vector<uint32_t>{1, 3, 5, 6, 7}));
  EXPECT_EQ(parseViews("all", 12)->size(), 12u);
  for (const char* bad : {"", ",", "1,", "12", "3-1", "0-4294967295", "-1", "1-", "a", "1,,2", "1 2"})
    EXPECT_EQ(parseViews(bad, 12).error().kind, ErrorKind::invalidArgument) << bad;
}

TEST_F(ExtractTest, RefusesWhatThePackCannotGiveAndWhatWouldFillTheDisk) {
  ExtractSettings wanted = settings({0}, {0});
  wanted.channel = ViewChannel::normal;
  EXPECT_EQ(extractViews(*pack_, wanted).error().kind, ErrorKind::unsupported);
  EXPECT_EQ(extractViews(*pack_, settings(std::vector<uint32_t>(kMaxExtractedFiles + 1, 0), {0})).error().kind,
            ErrorKind::exhausted);
  EXPECT_FALSE(std::filesystem::exists(directory_ / "out"));
}

TEST_F(ExtractTest, NormalsBecomeColoursOfTheirAxes) {
  ViewImage view{.view = 0,
                 .x0 = 0,
                 .y0 = 0,
                 .width = 2,
                 .height = 1,
                 .rgba = std::vector<uint8_t>(8, 255),
                 .depth = {1, 1},
                 .normal = {128, 128, 255, 255, 128, 255}};  // octahedral x, y, and length
  const Picture picture = viewPicture(view, ViewChannel::normal);
  const std::array<int, 8> expected = {128, 128, 255, 255, 255, 128, 128, 255};
  for (size_t i = 0; i < 8; ++i) EXPECT_NEAR(picture.pixels[i], expected[i], 2) << i;
}

TEST_F(ExtractTest, TheProgramSaysWhatItWroteAndHowItFailed) {
  const std::string pack = (directory_ / "a.far").string();
  const std::string out = " -o " + (directory_ / "pictures").string();
  ASSERT_EQ(run(pack + out + " --cell 0 --views 0-3 --json"), 0);
  const Json json = Json::parse(*readTextFile(directory_ / "out.txt", 1 << 20));
  EXPECT_EQ(json["written"].size(), 4u);
  for (const Json& file : json["written"]) EXPECT_TRUE(std::filesystem::exists(file["file"].get<std::string>()));
  EXPECT_EQ(run(pack + out + " --cell 77"), 2);
  EXPECT_EQ(run(pack + out + " --views 12"), 2);
  EXPECT_EQ(run(pack + out + " --channel red"), 2);
  EXPECT_EQ(run(pack), 2);
  EXPECT_EQ(run(pack + out + " --channel normal"), 1);
  EXPECT_EQ(run(pack + ".none" + out), 1);
  EXPECT_EQ(run(pack + " -o " + pack), 1);
  const auto bytes = readTextFile(pack, 1 << 26);
  ASSERT_TRUE(bytes);
  std::string broken = *bytes;
  const auto opened = PackFile::open(pack);
  for (const PageRecord& page : opened->directory().pages)
    broken[page.offsetBytes] = static_cast<char>(broken[page.offsetBytes] ^ 1);
  ASSERT_TRUE(writeTextFile(directory_ / "broken.far", broken));
  EXPECT_EQ(run((directory_ / "broken.far").string() + out), 1);
}

}  // namespace
}  // namespace farcell
