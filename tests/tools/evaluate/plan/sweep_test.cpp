#include "tools/evaluate/plan/sweep.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>

namespace farcell {
namespace {

Result<std::vector<RendererPlan>> sweepOf(const std::string& renderers, const std::vector<std::string>& sweeps) {
  const SelectionSettings selection{.triangleBudget = 777, .texelPixels = 3};
  return sweepRenderers(planRenderers(renderers, 64, 48, selection).value(), sweeps);
}

std::string namesOf(const Result<std::vector<RendererPlan>>& plans) {
  if (!plans) return plans.error().message;
  std::string line;
  for (const RendererPlan& plan : *plans) line += (line.empty() ? "" : " ") + plan.name;
  return line;
}

TEST(Sweep, RunsEachRendererThatHasTheSettingWithEachValue) {
  const auto plans = sweepOf("A,auto,triangles", {"texel-pixels=.25,1"});
  ASSERT_EQ(namesOf(plans),
            "full-1spp full-4spp triangles A@texel-pixels=0.25 A@texel-pixels=1 auto@texel-pixels=0.25 "
            "auto@texel-pixels=1");
  EXPECT_EQ((*plans)[3].settings.selection.texelPixels, 0.25);
  EXPECT_EQ((*plans)[4].settings.selection.texelPixels, 1);
  EXPECT_EQ((*plans)[4].settings.selection.mode, RenderMode::impostors);
  EXPECT_EQ((*plans)[4].rendererClass, "impostor");
  EXPECT_EQ((*plans)[5].settings.selection.triangleBudget, 777u) << "what is not swept is as the options say";
  EXPECT_EQ((*plans)[2].settings.selection.texelPixels, 3);
}

TEST(Sweep, OfTwoSettingsIsTheirProductWhereARendererHasBoth) {
  const auto plans = sweepOf("flat,auto", {"triangle-budget=2M,1500,0", "texel-pixels=0.5,0.7"});
  ASSERT_EQ(namesOf(plans),
            "full-1spp full-4spp flat@texel-pixels=0.5 flat@texel-pixels=0.7 "
            "auto@triangle-budget=2M@texel-pixels=0.5 auto@triangle-budget=2M@texel-pixels=0.7 "
            "auto@triangle-budget=1500@texel-pixels=0.5 auto@triangle-budget=1500@texel-pixels=0.7 "
            "auto@triangle-budget=0@texel-pixels=0.5 auto@triangle-budget=0@texel-pixels=0.7");
  EXPECT_EQ((*plans)[5].settings.selection.triangleBudget, 2'000'000u);
  EXPECT_EQ((*plans)[5].settings.selection.texelPixels, 0.7);
  EXPECT_EQ((*plans)[9].settings.selection.triangleBudget, 0u);
}

TEST(Sweep, MeshPixelsAreOfRenderersWithSimplifiedMeshes) {
  const auto plans = sweepOf("A,lod,auto,lod-as-auto", {"mesh-pixels=0,2.5"});
  ASSERT_EQ(namesOf(plans),
            "full-1spp full-4spp lod@mesh-pixels=0 lod@mesh-pixels=2.5 A auto@mesh-pixels=0 auto@mesh-pixels=2.5 "
            "lod-as-auto");
  EXPECT_EQ((*plans)[3].settings.selection.meshPixels, 2.5);
  EXPECT_EQ((*plans)[3].kind, "lod");
  EXPECT_EQ((*plans)[6].settings.selection.meshPixels, 2.5);
  EXPECT_EQ(plans->back().timeOf, "auto") << "its own is searched";
}

TEST(Sweep, TimeBudgetsAreOfAutomaticPictures) {
  const auto plans = sweepOf("lod,A,auto", {"time-budget-ms=0,16.5"});
  ASSERT_EQ(namesOf(plans), "full-1spp full-4spp lod A auto@time-budget-ms=0 auto@time-budget-ms=16.5");
  EXPECT_EQ((*plans)[4].settings.selection.timeBudgetMs, 0);
  EXPECT_EQ((*plans)[5].settings.selection.timeBudgetMs, 16.5);
  EXPECT_EQ((*plans)[5].kind, "auto");
}

TEST(Sweep, EqualValuesCountOnceHoweverTheyAreWritten) {
  EXPECT_EQ(namesOf(sweepOf("auto", {"triangle-budget=100k,100000,0.1M"})),
            "full-1spp full-4spp auto@triangle-budget=100k");
  EXPECT_EQ(namesOf(sweepOf("A", {"texel-pixels=0.50,.5,5e-1"})), "full-1spp full-4spp A@texel-pixels=0.5");
  EXPECT_EQ(namesOf(sweepOf("A,auto", {})), "full-1spp full-4spp A auto");
}

// Files are named after renderers; a page's address lists them between commas.
TEST(Sweep, NamesAreOfAFewSafeCharacters) {
  const auto plans =
      sweepOf("flat,A,auto", {"texel-pixels=0.01,1e1,1e-1,100,0.333333333333", "triangle-budget=1e18,3G"});
  ASSERT_TRUE(plans) << plans.error().message;
  std::set<std::string> names;
  for (const RendererPlan& plan : *plans) {
    EXPECT_EQ(plan.name.find_first_not_of("abcdefghijklmnopqrstuvwxyzAGMk0123456789-@=."), std::string::npos)
        << plan.name;
    names.insert(plan.name);
  }
  EXPECT_EQ(names.size(), 2u + 5 + 5 + 10);
}

TEST(Sweep, SaysWhatIsWrong) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"frames=1,2"}, "found 'frames=1,2'"},
      {{"texel-pixels"}, "found 'texel-pixels'"},
      {{""}, "found ''"},
      {{"texel-pixels="}, "--sweep texel-pixels: expected a number from 0.01 to 100, found ''"},
      {{"texel-pixels=0.5,"}, "found ''"},
      {{"texel-pixels=0.5,,1"}, "found ''"},
      {{"texel-pixels=0.009"}, "found '0.009'"},
      {{"texel-pixels=101"}, "found '101'"},
      {{"texel-pixels=nan"}, "found 'nan'"},
      {{"texel-pixels=-1"}, "found '-1'"},
      {{"texel-pixels=0.5x"}, "found '0.5x'"},
      {{"time-budget-ms=-1"}, "--sweep time-budget-ms: expected a number from 0 to 1000000, found '-1'"},
      {{"mesh-pixels=-0.1"}, "--sweep mesh-pixels: expected a number from 0 to 100, found '-0.1'"},
      {{"triangle-budget=1q"}, "found '1q'"},
      {{"triangle-budget=-5"}, "found '-5'"},
      {{"triangle-budget="}, "found ''"},
      {{"texel-pixels=1", "texel-pixels=2"}, "--sweep texel-pixels: given twice"},
  };
  for (const auto& [sweeps, message] : cases) {
    const auto plans = sweepOf("auto", sweeps);
    ASSERT_FALSE(plans) << message;
    EXPECT_EQ(plans.error().kind, ErrorKind::invalidArgument) << message;
    EXPECT_NE(plans.error().message.find(message), std::string::npos) << plans.error().message;
  }
  const auto none = sweepOf("A", {"triangle-budget=1k"});
  ASSERT_FALSE(none) << "a sweep without any effect";
  EXPECT_NE(none.error().message.find("none of the renderers"), std::string::npos) << none.error().message;
}

std::string range(const std::string& setting, int count) {
  std::string text = setting + "=";
  for (int i = 1; i <= count; ++i) text += fmt::format("{}{}", i > 1 ? "," : "", i);
  return text;
}

TEST(Sweep, IsBounded) {
  const auto most = sweepOf("auto", {range("triangle-budget", 62)});
  ASSERT_TRUE(most) << most.error().message;
  EXPECT_EQ(most->size(), kMaxRenderers);
  EXPECT_EQ(namesOf(sweepOf("auto", {range("triangle-budget", 63)})),
            "--sweep triangle-budget: expected at most 64 renderers, found 65");
  EXPECT_TRUE(sweepOf("auto", {range("triangle-budget", 6), range("texel-pixels", 10)}));
  EXPECT_EQ(namesOf(sweepOf("auto", {range("triangle-budget", 7), range("texel-pixels", 9)})),
            "--sweep texel-pixels: expected at most 64 renderers, found 65");
}

}  // namespace
}  // namespace farcell
