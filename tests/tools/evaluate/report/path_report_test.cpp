#include "tools/evaluate/report/path_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace farcell {
namespace {

PathRun runOf(const std::string& name, const std::vector<double>& flicker) {
  PathRun run;
  const auto plans = planRenderers(kAllRenderers, 64, 48, {});
  for (const RendererPlan& plan : plans.value())
    if (plan.name == name) run.renderer = plan;
  for (const double value : flicker) {
    PathFrame frame;
    frame.paperError = 2 * static_cast<double>(run.frames.size());
    frame.change = {3, 2, value};
    frame.wallMs = 10 - static_cast<double>(run.frames.size());
    run.frames.push_back(frame);
  }
  return run;
}

TEST(PathSummary, IsByHand) {
  PathRun run = runOf("auto", {0, 1, 5, 2, 4});
  run.frames[2].viewSwitches = 3;
  run.frames[4].levelSwitches = 1;
  const PathSummary summary = summarise(run);
  EXPECT_EQ(summary.frames, 4u);
  EXPECT_DOUBLE_EQ(summary.meanError, 4);
  EXPECT_DOUBLE_EQ(summary.meanFlicker, 3);
  EXPECT_DOUBLE_EQ(summary.p99Flicker, 5);
  EXPECT_DOUBLE_EQ(summary.worstFlicker, 5);
  EXPECT_EQ(summary.worstFrame, 2u);
  EXPECT_DOUBLE_EQ(summary.ownChange, 3);
  EXPECT_DOUBLE_EQ(summary.referenceChange, 2);
  EXPECT_EQ(summary.switchFrames, 2u);
  EXPECT_EQ(summary.viewSwitches, 3u);
  EXPECT_EQ(summary.levelSwitches, 1u);
  EXPECT_DOUBLE_EQ(*summary.flickerAtSwitches, 4.5);
  EXPECT_DOUBLE_EQ(*summary.flickerElsewhere, 1.5);
  EXPECT_DOUBLE_EQ(summary.worstPopToReference, 2.5);
  EXPECT_DOUBLE_EQ(summary.medianMs, 7.5) << "without the first frame";
  EXPECT_DOUBLE_EQ(summary.worstMs, 9);
}

TEST(PathSummary, The99thPercentileIsNotTheWorstOfManyFrames) {
  std::vector<double> flicker = {0};
  for (int i = 1; i <= 200; ++i) flicker.push_back(i);
  EXPECT_DOUBLE_EQ(summarise(runOf("auto", flicker)).p99Flicker, 198);
}

TEST(PathSummary, ComparesWithFullGeometryAtFourSamples) {
  PathEntry path;
  path.runs = {runOf("full-1spp", {0, 8}), runOf("full-4spp", {0, 4}), runOf("auto", {0, 3})};
  const auto summaries = summarise(path);
  EXPECT_DOUBLE_EQ(*summaries[0].flickerToFull4spp, 2);
  EXPECT_DOUBLE_EQ(*summaries[2].flickerToFull4spp, 0.75);
  path.runs[1] = runOf("full-4spp", {0, 0});
  EXPECT_FALSE(summarise(path)[2].flickerToFull4spp);
}

TEST(PathReport, HasEveryFrameInJsonAndCsv) {
  PathEntry path;
  path.name = "a,\"b\"\x1b";
  path.stem = "path-a";
  path.runs = {runOf("full-4spp", {0, 4, 2}), runOf("auto", {0, 3, 7})};
  const nlohmann::ordered_json json = pathsJson(std::vector{path});
  ASSERT_EQ(json.size(), 1u);
  EXPECT_EQ(json[0].at("frames"), 3);
  const auto& run = json[0].at("renderers")[1];
  EXPECT_EQ(run.at("renderer"), "auto");
  EXPECT_EQ(run.at("frames").at("flicker"), (std::vector<double>{0, 3, 7}));
  EXPECT_EQ(run.at("summary").at("worstFrame"), 2);
  EXPECT_EQ(run.at("settings").at("mode"), "auto");
  EXPECT_TRUE(run.at("summary").at("flickerAtSwitches").is_null());
  const std::string csv = pathsCsv(std::vector{path});
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 6);
  EXPECT_TRUE(csv.starts_with("path,frame,renderer,paperError,flicker,")) << csv.substr(0, 80);
  EXPECT_NE(csv.find("\"a,\"\"b\"\"\x1b\",2,auto,4.0,7.0,"), std::string::npos) << csv;
  const std::string table = pathsTable(std::vector{path});
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + 2);
  EXPECT_EQ(table.find('\x1b'), std::string::npos);
}

// A run that ended in its first frame.
TEST(PathReport, OfNoFramesHasNoFigures) {
  PathEntry path;
  path.runs = {runOf("full-4spp", {}), runOf("auto", {})};
  EXPECT_EQ(summarise(path)[1].frames, 0u);
  EXPECT_EQ(pathsJson(std::vector{path})[0].at("renderers")[0].at("frames").at("flicker").size(), 0u);
  EXPECT_EQ(pathsJson({}).size(), 0u);
}

}  // namespace
}  // namespace farcell
