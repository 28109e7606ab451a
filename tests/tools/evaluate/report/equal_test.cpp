#include "tools/evaluate/report/equal_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace farcell {
namespace {

// Error 8 in 1 ms, 2 in 4 ms, 1 in 16 ms; two that are beaten.
const std::vector<ErrorAndTime> kPoints = {{1, 16}, {8, 1}, {9, 3}, {2, 4}, {2, 30}};

TEST(EqualTime, LiesBetweenMeasuredPointsByLogarithms) {
  EXPECT_FALSE(errorAtTime(kPoints, 0.9));
  EXPECT_DOUBLE_EQ(*errorAtTime(kPoints, 1), 8);
  EXPECT_NEAR(*errorAtTime(kPoints, 2), 4, 1e-12) << "error falls as 1 / time from 1 to 4 ms";
  EXPECT_DOUBLE_EQ(*errorAtTime(kPoints, 4), 2);
  EXPECT_NEAR(*errorAtTime(kPoints, 8), std::sqrt(2.0), 1e-12) << "and as 1 / sqrt(time) from there";
  EXPECT_DOUBLE_EQ(*errorAtTime(kPoints, 1000), 1);
}

TEST(EqualTime, OfAnErrorIsTheInverse) {
  EXPECT_FALSE(timeAtError(kPoints, 0.99));
  EXPECT_DOUBLE_EQ(*timeAtError(kPoints, 1), 16);
  EXPECT_NEAR(*timeAtError(kPoints, std::sqrt(2.0)), 8, 1e-12);
  EXPECT_DOUBLE_EQ(*timeAtError(kPoints, 2), 4);
  EXPECT_NEAR(*timeAtError(kPoints, 4), 2, 1e-12);
  EXPECT_DOUBLE_EQ(*timeAtError(kPoints, 100), 1);
  for (double error = 1; error < 8; error += 0.37)
    EXPECT_NEAR(*errorAtTime(kPoints, *timeAtError(kPoints, error)), error, 1e-9);
}

TEST(EqualTime, OfOnePointOrNoErrorIsDefined) {
  const std::vector<ErrorAndTime> one = {{5, 10}};
  EXPECT_FALSE(errorAtTime(one, 9));
  EXPECT_EQ(*errorAtTime(one, 11), 5);
  EXPECT_FALSE(timeAtError(one, 4));
  EXPECT_EQ(*timeAtError(one, 6), 10);
  const std::vector<ErrorAndTime> perfect = {{4, 10}, {0, 20}};
  EXPECT_DOUBLE_EQ(*errorAtTime(perfect, 15), 2);
  EXPECT_DOUBLE_EQ(*timeAtError(perfect, 0), 20);
}

Entry entryOf(const std::string& camera, const std::string& name, const std::string& kind, double error, double ms) {
  Entry entry;
  entry.camera = entry.stem = camera;
  entry.renderer.name = name;
  entry.renderer.kind = kind;
  entry.renderer.rendererClass = kind == "auto" ? "mixed" : "geometry";
  entry.metrics.paperError = error;
  entry.metrics.foregroundPixels = camera == "nothing" ? 0 : 10;
  entry.frame = frameTimes({ms});
  return entry;
}

// From a: lod has twice auto's error in auto's time, takes 4 times as long for it. From b: it is always slower, and
// never as good.
std::vector<Entry> entries() {
  return {entryOf("a", "lod@mesh-pixels=1", "lod", 8, 1),
          entryOf("a", "lod@mesh-pixels=4", "lod", 2, 16),
          entryOf("a", "auto", "auto", 2, 4),
          entryOf("b", "lod@mesh-pixels=1", "lod", 8, 10),
          entryOf("b", "lod@mesh-pixels=4", "lod", 2, 16),
          entryOf("b", "auto", "auto", 1, 5),
          entryOf("nothing", "lod@mesh-pixels=1", "lod", 0, 1),
          entryOf("nothing", "auto", "auto", 0, 1)};
}

TEST(EqualTable, ComparesTheSubjectWithEachKindFromEachCamera) {
  const EqualTable table = equalTable(entries());
  EXPECT_EQ(table.subject, "auto");
  ASSERT_EQ(table.cameras.size(), 2u) << "not the one that sees nothing";
  const EqualEntry& a = table.cameras[0].kinds.at(0);
  EXPECT_EQ(a.kind, "lod");
  EXPECT_NEAR(*a.errorThere, 4, 1e-12);
  EXPECT_NEAR(*a.msThere, 16, 1e-12);
  const EqualEntry& b = table.cameras[1].kinds.at(0);
  EXPECT_FALSE(b.errorThere);
  EXPECT_FALSE(b.msThere);
  ASSERT_EQ(table.kinds.size(), 1u);
  EXPECT_EQ(table.kinds[0].cameras, 2u);
  EXPECT_EQ(table.kinds[0].subjectBetter, 2u);
  EXPECT_EQ(table.kinds[0].neverAsFast, 1u);
  EXPECT_EQ(table.kinds[0].neverAsGood, 1u);
  EXPECT_NEAR(*table.kinds[0].errorRatio, 0.5, 1e-12);
  EXPECT_NEAR(*table.kinds[0].leastSpeed, 4, 1e-12);
}

TEST(EqualTable, IsWrittenWithWhatIsNotKnownLeftEmpty) {
  const EqualTable table = equalTable(entries());
  const nlohmann::ordered_json json = equalJson(table);
  EXPECT_EQ(json.at("subject"), "auto");
  EXPECT_TRUE(json.at("cameras")[1].at("kinds")[0].at("msThere").is_null());
  const std::string csv = equalCsv(table);
  EXPECT_TRUE(csv.starts_with("camera,kind,ms,error,errorThere,msThere\n"));
  EXPECT_NE(csv.find("b,lod,5.0,1.0,,\n"), std::string::npos) << csv;
  const std::string text = equalText(table);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2);
}

TEST(EqualTable, WithoutASubjectIsEmpty) {
  const EqualTable table = equalTable(std::vector<Entry>{entryOf("a", "lod", "lod", 1, 1)});
  EXPECT_EQ(table.subject, "");
  EXPECT_EQ(equalText(table), "");
  EXPECT_EQ(equalJson(table).at("cameras").size(), 0u);
  EXPECT_EQ(equalTable({}).subject, "");
}

}  // namespace
}  // namespace farcell
