#include "tools/evaluate/report/report.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tools/evaluate/report/summary.h"

namespace farcell {
namespace {

using Json = nlohmann::ordered_json;

Entry entryOf(const std::string& camera, const std::string& renderer, double paperError, double impostorShare = 0) {
  Entry entry;
  entry.camera = camera;
  const auto plans = planRenderers(kAllRenderers, 64, 48, {.triangleBudget = 500});
  for (const RendererPlan& plan : plans.value())
    if (plan.name == renderer) entry.renderer = plan;
  entry.metrics.paperError = paperError;
  entry.metrics.paperErrorSum = 100 * paperError;
  entry.metrics.impostorShare = impostorShare;
  entry.metrics.psnr = 30;
  entry.metrics.foregroundPixels = 10;
  entry.frame = frameTimes({3, 1, 2});
  entry.cpuMs = 4;
  return entry;
}

std::vector<Entry> twoCameras() {
  std::vector<Entry> entries = {entryOf("near", "full-1spp", 8), entryOf("near", "auto", 4, .5),
                                entryOf("far", "full-1spp", 10), entryOf("far", "auto", 2, .9)};
  setRatios(entries);
  return entries;
}

struct Facts {
  Directory directory;
  ReportFacts facts;
  Facts() {
    directory.sourceName = "model.ply";
    facts.packName = "model.far";
    facts.directory = &directory;
    facts.width = 64;
    facts.height = 48;
    facts.timedFrames = 3;
    facts.background = {255, 128, 0};
    facts.referenceKind = "pack";
    facts.referenceSamples = 64;
  }
};

TEST(FrameTimes, AreMedianNearestRankAndMaximum) {
  std::vector<double> times;
  for (int i = 40; i >= 1; --i) times.push_back(i);
  const FrameTimes frame = frameTimes(times);
  EXPECT_EQ(frame.medianMs, 20.5);
  EXPECT_EQ(frame.p95Ms, 38);
  EXPECT_EQ(frame.maxMs, 40);
  EXPECT_EQ(frameTimes({7}).p95Ms, 7);
  EXPECT_EQ(medianOf({3, 1, 2}), 2);
}

TEST(Summary, RatiosAreToTheSameCamerasBaselineAndTheirMeanIsGeometric) {
  const std::vector<Entry> entries = twoCameras();
  EXPECT_EQ(entries[0].ratioToFull1spp, 1.0);
  EXPECT_EQ(entries[1].ratioToFull1spp, 0.5);
  EXPECT_EQ(entries[3].ratioToFull1spp, 0.2);
  const std::vector<RendererSummary> summaries = summarise(entries);
  ASSERT_EQ(summaries.size(), 2u);
  EXPECT_EQ(summaries[1].renderer, "auto");
  EXPECT_EQ(summaries[1].rendererClass, "mixed");
  EXPECT_NEAR(summaries[1].all.ratioToFull1spp.value(), std::sqrt(0.1), 1e-12);
  EXPECT_EQ(summaries[1].all.worstRatio, 0.5);
  EXPECT_EQ(summaries[1].mostlyImpostors.cameras, 1u);
  EXPECT_NEAR(summaries[1].mostlyImpostors.ratioToFull1spp.value(), 0.2, 1e-12);
  EXPECT_NEAR(summaries[1].elsewhere.ratioToFull1spp.value(), 0.5, 1e-12);
}

TEST(Summary, ACameraWithoutBaselineErrorIsLeftOut) {
  std::vector<Entry> entries = {entryOf("nothing", "full-1spp", 0), entryOf("nothing", "A", 3),
                                entryOf("some", "full-1spp", 4), entryOf("some", "A", 0)};
  setRatios(entries);
  EXPECT_FALSE(entries[1].ratioToFull1spp);
  const std::vector<RendererSummary> summaries = summarise(entries);
  EXPECT_EQ(summaries[1].all.cameras, 1u);
  EXPECT_EQ(summaries[1].all.ratioToFull1spp, 0.0) << "a picture without error has the ratio 0, not NaN";
}

void expectFinite(const Json& json, const std::string& where) {
  for (const auto& [key, value] : json.items()) {
    if (value.is_structured())
      expectFinite(value, where + "/" + key);
    else if (value.is_number())
      EXPECT_TRUE(std::isfinite(value.get<double>())) << where << "/" << key;
    else
      EXPECT_FALSE(value.is_null()) << where << "/" << key;
  }
}

TEST(ReportJson, HoldsEveryMemberOfTheContractAndIsFinite) {
  const Json json = Json::parse(reportJson(Facts().facts, twoCameras()).dump());
  ASSERT_EQ(json["entries"].size(), 4u);
  for (const Json& entry : json["entries"]) {
    for (const char* text : {"camera", "stem", "renderer", "class"}) EXPECT_TRUE(entry.at(text).is_string()) << text;
    EXPECT_TRUE(entry.at("settings").is_object());
    for (const char* number :
         {"paperErrorSum", "paperError", "mae", "psnr", "ssim", "flip", "p95", "p99", "holeRate", "leakRate",
          "coverageBias", "impostorShare", "cpuMs", "triangles", "texels", "bytesRead"})
      EXPECT_TRUE(entry.at(number).is_number()) << number;
    for (const char* number : {"median", "p95", "max"})
      EXPECT_TRUE(entry.at("frameMs").at(number).is_number()) << number;
  }
  EXPECT_EQ(json["entries"][3]["camera"], "far");
  EXPECT_EQ(json["entries"][3]["paperError"], 2.0);
  EXPECT_EQ(json["entries"][3]["settings"]["kind"], "A");
  EXPECT_EQ(json["entries"][3]["settings"]["triangleBudget"], 500);
  for (const char* renderer : {"full-1spp", "auto"}) {
    const Json& summary = json.at("summary").at(renderer);
    EXPECT_TRUE(summary.at("class").is_string());
    EXPECT_TRUE(summary.at("ratioToFull1spp").is_number());
    EXPECT_TRUE(summary.at("worstRatio").is_number());
  }
  EXPECT_EQ(json.at("background"), Json({255, 128, 0}));
  EXPECT_EQ(json.at("reference").at("samples"), 64);
  EXPECT_EQ(json.at("complete"), true);
  expectFinite(json["entries"], "entries");
}

TEST(ReportJson, SaysNullWhereThereIsNoRatio) {
  std::vector<Entry> entries = {entryOf("nothing", "full-1spp", 0)};
  setRatios(entries);
  const Json json = reportJson(Facts().facts, entries);
  EXPECT_TRUE(json["entries"][0]["ratioToFull1spp"].is_null());
  EXPECT_TRUE(json["summary"]["full-1spp"]["ratioToFull1spp"].is_null());
}

// Fields of one line of CSV, by RFC 4180.
std::vector<std::string> csvFields(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (size_t i = 0; i < line.size(); ++i) {
    if (quoted && line[i] == '"' && i + 1 < line.size() && line[i + 1] == '"')
      fields.back() += line[++i];
    else if (line[i] == '"')
      quoted = !quoted;
    else if (line[i] == ',' && !quoted)
      fields.emplace_back();
    else
      fields.back() += line[i];
  }
  return fields;
}

TEST(ReportCsv, HasTheSameFiguresUnderTheSameNames) {
  std::vector<Entry> entries = {entryOf("a,\"b\"", "full-1spp", 0.1), entryOf("", "auto", 1.0 / 3, 0.5)};
  setRatios(entries);
  std::istringstream text(reportCsv(entries));
  std::string line;
  std::getline(text, line);
  const std::vector<std::string> names = csvFields(line);
  const Json json = reportJson(Facts().facts, entries);
  for (size_t i = 0; i < entries.size(); ++i) {
    ASSERT_TRUE(std::getline(text, line));
    const std::vector<std::string> fields = csvFields(line);
    ASSERT_EQ(fields.size(), names.size());
    EXPECT_EQ(fields[0], entries[i].camera);
    for (size_t column = 0; column < names.size(); ++column) {
      const size_t dot = names[column].find('.');
      const Json& entry = json["entries"][i];
      const Json value = dot == std::string::npos
                             ? entry.at(names[column])
                             : entry.at(names[column].substr(0, dot)).at(names[column].substr(dot + 1));
      if (value.is_number()) {
        EXPECT_EQ(std::stod(fields[column]), value.get<double>()) << names[column];
      }
    }
  }
  EXPECT_FALSE(std::getline(text, line));
}

TEST(SummaryCsv, HasALineForEachRendererWithTheSummarysFiguresUnderTheSameNames) {
  const std::vector<Entry> entries = twoCameras();
  const Json summary = reportJson(Facts().facts, entries)["summary"];
  std::istringstream text(summaryCsv(entries));
  std::string line;
  std::getline(text, line);
  const std::vector<std::string> names = csvFields(line);
  for (const char* name : {"ratioToFull1spp", "worstRatio", "worstHoleRate", "medianFrameMs", "medianTriangles",
                           "onParetoFront", "mostlyImpostors.cameras"})
    EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
  for (const char* renderer : {"full-1spp", "auto"}) {
    ASSERT_TRUE(std::getline(text, line));
    const std::vector<std::string> fields = csvFields(line);
    ASSERT_EQ(fields.size(), names.size());
    EXPECT_EQ(fields[0], renderer);
    for (size_t column = 1; column < names.size(); ++column) {
      std::string pointer = fmt::format("/{}", names[column]);
      std::replace(pointer.begin(), pointer.end(), '.', '/');
      const Json& value = summary.at(renderer).at(Json::json_pointer(pointer));
      EXPECT_EQ(fields[column], value.is_null() ? "" : value.is_string() ? value.get<std::string>() : value.dump());
    }
  }
  EXPECT_FALSE(std::getline(text, line));
}

TEST(Summary, MarksTheParetoFrontOfRatioAndFrameTime) {
  // Median frame times: full-1spp 2 ms, full-4spp 5, A 2 and less error than full-1spp, auto 9 and the least error.
  std::vector<Entry> entries;
  const auto add = [&](const std::string& camera, const std::string& renderer, double error, double ms,
                       uint64_t triangles) {
    Entry& entry = entries.emplace_back(entryOf(camera, renderer, error));
    entry.frame = frameTimes({ms});
    entry.triangles = triangles;
  };
  for (const char* camera : {"near", "far"}) {
    add(camera, "full-1spp", 10, 2, 100);
    add(camera, "full-4spp", 4, 5, 100);
    add(camera, "A", 5, 2, 0);
    add(camera, "flat", 20, 6, 0);
    add(camera, "auto", 2, 9, camera[0] == 'n' ? 30 : 10);
  }
  setRatios(entries);
  const Json summary = reportJson(Facts().facts, entries)["summary"];
  std::string front;
  for (const auto& [name, renderer] : summary.items())
    if (renderer.at("onParetoFront") == true) front += name + " ";
  EXPECT_EQ(front, "full-4spp A auto ");
  EXPECT_EQ(summary["auto"]["medianTriangles"], 20);
  EXPECT_EQ(summary["auto"]["medianFrameMs"], 9);
}

// Error, ms and bytes of two kinds; x1 is beaten by y1 in both, x2 by x1 in bytes alone.
TEST(Summary, HasFrontsOfTimeAndBytesOfAllAndOfEachKind) {
  struct Variant {
    const char *name, *kind;
    double error, ms;
    uint64_t bytes;
  };
  std::vector<Entry> entries = {entryOf("c", "full-1spp", 10)};
  entries[0].renderer.kind = "full-1spp";
  entries[0].frame = frameTimes({100});
  entries[0].bytesRead = 1000;
  for (const Variant& variant : {Variant{"x1", "x", 5, 10, 50}, Variant{"x2", "x", 6, 5, 60},
                                 Variant{"y1", "y", 4, 9, 40}, Variant{"y2", "y", 3, 20, 90}}) {
    Entry entry = entryOf("c", "auto", variant.error);
    entry.renderer.name = variant.name;
    entry.renderer.kind = variant.kind;
    entry.frame = frameTimes({variant.ms});
    entry.bytesRead = variant.bytes;
    entries.push_back(entry);
  }
  setRatios(entries);
  const auto fronts = [&](bool RendererSummary::*mark) {
    std::string names;
    for (const RendererSummary& summary : summarise(entries)) names += summary.*mark ? summary.renderer + " " : "";
    return names;
  };
  EXPECT_EQ(fronts(&RendererSummary::onParetoFront), "x2 y1 y2 ");
  EXPECT_EQ(fronts(&RendererSummary::onKindFront), "full-1spp x1 x2 y1 y2 ");
  EXPECT_EQ(fronts(&RendererSummary::onBytesFront), "y1 y2 ");
  EXPECT_EQ(fronts(&RendererSummary::onKindBytesFront), "full-1spp x1 y1 y2 ");
}

TEST(Summary, WithoutARatioNothingIsOnTheFront) {
  std::vector<Entry> entries = {entryOf("nothing", "full-1spp", 0)};
  setRatios(entries);
  EXPECT_FALSE(summarise(entries)[0].onParetoFront);
}

TEST(ReportTable, ColumnsStayInLineUnderTheLongestName) {
  std::vector<Entry> entries = twoCameras();
  entries[1].renderer.name = entries[3].renderer.name = "auto@texel-pixels=0.35@triangle-budget=100k";
  std::istringstream table(reportTable(entries));
  std::string heading, line;
  std::getline(table, heading);
  for (std::getline(table, line); !line.empty(); std::getline(table, line))
    EXPECT_EQ(line.size(), heading.size()) << line;
  std::getline(table, heading);
  EXPECT_TRUE(heading.ends_with("front"));
  int stars = 0;
  while (std::getline(table, line)) {
    EXPECT_EQ(line.size(), heading.size()) << line;
    stars += line.ends_with('*') ? 1 : 0;
  }
  EXPECT_EQ(stars, 1) << "all take the same time: the least error alone is on the front";
}

TEST(ReportTable, ShowsEveryEntryAndNoControlCharacters) {
  std::vector<Entry> entries = twoCameras();
  entries[0].camera = "evil\x1b[31m\n";
  const std::string table = reportTable(entries);
  EXPECT_NE(table.find("far"), std::string::npos);
  EXPECT_NE(table.find("evil?[31m?"), std::string::npos) << table;
  EXPECT_EQ(table.find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace farcell
