// The whole program's page, opened from disk in a browser.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "tests/support/chromium.h"
#include "tests/support/evaluate_models.h"
#include "tools/image/png.h"

namespace farcell {
namespace {

using testing::countOf;

std::string without(std::string text, const std::string& part) {
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at)) text.erase(at, part.size());
  return text;
}

void expectPicture(const std::filesystem::path& path) {
  const auto picture = readPng(path, 1 << 24);
  ASSERT_TRUE(picture) << picture.error().message;
  std::map<uint32_t, size_t> colours;
  const auto channels = static_cast<size_t>(picture->channels);
  for (size_t at = 0; at < picture->pixels.size(); at += channels)
    ++colours[picture->pixels[at] | picture->pixels[at + 1] << 8 | picture->pixels[at + 2] << 16];
  size_t most = 0;
  for (const auto& [colour, count] : colours) most = std::max(most, count);
  EXPECT_GT(colours.size(), 200u) << "text, marks and pictures";
  EXPECT_LT(most, picture->pixels.size() / channels * 95 / 100) << "not one colour alone";
}

TEST(EvaluatePage, OpensFromDiskWithEveryEntryAndPicture) {
  if (!testing::haveChromium()) GTEST_SKIP() << "chromium is not installed";
  const testing::TemporaryDirectory directory, scratch;
  const testing::TestModel model = testing::sphereModel({100, 200, 300}, 10, 4);
  testing::writeTestPack(model, directory.path() / "sphere.far",
                         testing::writeTestPly(model, directory.path() / "s.ply"));
  std::ofstream(directory.path() / "cameras.json")
      << R"({"cameras":[{"name":"</script><b>near","position":[130,206,308],"target":[100,200,300],"up":[0,0,1],"fovYDeg":40},
                        {"name":"far","position":[160,210,310],"target":[100,200,300],"up":[0,0,1],"fovYDeg":40}]})";
  const std::string command = "cd " + directory.path().string() + " && " + FARCELL_PROGRAMS_DIR +
                              "/farcell-evaluate sphere.far --cameras cameras.json --renderers triangles --size 160x120"
                              " --frames 1 --reference-samples 16 -o report > /dev/null 2> stderr";
  ASSERT_EQ(std::system(command.c_str()), 0);

  testing::Chromium chromium(scratch.path());
  const std::filesystem::path page = directory.path() / "report" / "index.html";
  const std::string dom = chromium.domOf(page);
  EXPECT_EQ(countOf(dom, "data-errors=\"0\""), 1u) << chromium.log();
  EXPECT_EQ(countOf(dom, "class=\"point\""), 2u * 2 * 3)
      << "in each plot one for each of three renderers and two cameras";
  EXPECT_EQ(countOf(dom, "title=\"Show its pictures\""), 2u * 3);
  EXPECT_EQ(countOf(dom, "class=\"absent\""), 0u) << "every picture is found";
  EXPECT_EQ(dom.find("<b>near"), std::string::npos);
  EXPECT_NE(dom.find("&lt;/script&gt;&lt;b&gt;near"), std::string::npos);
  const std::string addresses = without(dom, "http://www.w3.org/2000/svg");
  EXPECT_EQ(countOf(addresses, "http"), countOf(addresses, "http-equiv")) << "nothing leaves the disk";
  EXPECT_EQ(countOf(addresses, "=\"//"), 0u);

  chromium.screenshot(page, scratch.path() / "page.png", "#mode=flip&right=full-1spp");
  expectPicture(scratch.path() / "page.png");
}

}  // namespace
}  // namespace farcell
