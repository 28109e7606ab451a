#include "tools/evaluate/report/sun_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>

namespace farcell {
namespace {

Entry entryUnder(const std::string& camera, const std::string& renderer, double error, double ratio) {
  Entry entry;
  entry.camera = camera;
  entry.renderer.name = renderer;
  entry.metrics.paperError = error;
  entry.ratioToFull1spp = ratio;
  return entry;
}

const std::vector<SunEntries> kSuns = {
    {{std::numbers::pi / 2, 0.1}, {entryUnder("a", "auto", 2, 0.2), entryUnder("b", "auto", 8, 0.8)}},
    {{0, std::numbers::pi / 6}, {entryUnder("a", "auto", 1, 0.1), entryUnder("b", "auto", 1, 0.1)}}};

TEST(SunReport, saysOfEachSunWhereItStandsAndHowEachRendererDoes) {
  const auto json = sunsJson(kSuns);
  ASSERT_EQ(json.size(), 2u);
  EXPECT_NEAR(json[0]["azimuthDeg"].get<double>(), 90, 1e-9);
  EXPECT_NEAR(json[1]["elevationDeg"].get<double>(), 30, 1e-9);
  EXPECT_NEAR(json[0]["renderers"]["auto"]["ratioToFull1spp"].get<double>(), 0.4, 1e-9);  // geometric mean
  EXPECT_EQ(json[0]["renderers"]["auto"]["worstRatio"], 0.8);
  EXPECT_EQ(json[1]["renderers"]["auto"]["cameras"], 2);
}

TEST(SunReport, hasALineForEachSunCameraAndRenderer) {
  const std::string csv = sunsCsv(kSuns);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5);
  EXPECT_EQ(csv.substr(0, csv.find('\n')), "azimuthDeg,elevationDeg,camera,renderer,paperError,ratioToFull1spp");
  EXPECT_NE(csv.find(",b,auto,8.0,0.8\n"), std::string::npos) << csv;
}

TEST(SunReport, tellsTheMeanOverAllSunsTheBestAndTheWorst) {
  const std::string text = sunsText(kSuns);
  for (const char* figure : {"auto", " 2 ", "0.200", "0.100", "0.400", "0.800"})
    EXPECT_NE(text.find(figure), std::string::npos) << text;
  EXPECT_EQ(sunsText({}), "");
  EXPECT_EQ(sunsText({SunEntries{}}), "");
  EXPECT_EQ(sunsJson({}).dump(), "[]");
}

}  // namespace
}  // namespace farcell
