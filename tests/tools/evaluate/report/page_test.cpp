// The page on reports made by hand, without pictures; the whole program's page is evaluate_page_gl_test.cpp.
#include "tools/evaluate/report/page.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/chromium.h"
#include "tests/support/evaluate_directory.h"
#include "tools/evaluate/report/equal_report.h"
#include "tools/evaluate/report/names.h"
#include "tools/evaluate/report/path_report.h"
#include "tools/evaluate/report/report.h"
#include "tools/evaluate/report/summary.h"
#include "tools/evaluate/report/sun_report.h"

namespace farcell {
namespace {

using testing::Chromium;
using testing::countOf;
using testing::TemporaryDirectory;

const std::string kHostile =
    "</script><!--<script>\"'&amp;<img src=x onerror=\"document.title='owned'\">{{data}}\xff\x01";

std::vector<Entry> entriesOf(const std::vector<std::string>& names) {
  const std::vector<std::string> stems = fileStems(names);
  const std::vector<RendererPlan> plans = planRenderers(kAllRenderers, 640, 360, {}).value();
  std::vector<Entry> entries;
  for (size_t camera = 0; camera < names.size(); ++camera)
    for (const RendererPlan& plan : plans) {
      const auto number = static_cast<double>(entries.size());
      Entry entry;
      entry.camera = names[camera];
      entry.stem = stems[camera];
      entry.renderer = plan;
      entry.metrics.paperError = 5 + static_cast<double>(entries.size() * 37 % 101);
      entry.metrics.flip = 0.001 * number;
      entry.metrics.foregroundPixels = 10;
      entry.metrics.psnr = 20 + number / 10;
      entry.frame = frameTimes({1 + number});
      entry.cpuMs = 2 + number;
      entry.bytesRead = entries.size() * 1000;  // one has read nothing: 0 on a logarithmic axis
      entry.triangles = plan.rendererClass == "impostor" ? 0 : 1000;
      entries.push_back(entry);
    }
  setRatios(entries);
  return entries;
}

class Page : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!testing::haveChromium()) GTEST_SKIP() << "chromium is not installed";
    directory_.sourceName = kHostile;
    facts_.packName = kHostile;
    facts_.directory = &directory_;
    facts_.width = 640;
    facts_.height = 360;
    facts_.timedFrames = 1;
    facts_.glRenderer = kHostile;
    facts_.referenceKind = "pack";
    facts_.referenceSamples = 64;
  }

  std::filesystem::path write(const std::vector<Entry>& entries, const std::string& script = "",
                              const std::vector<PathEntry>& paths = {}) const {
    nlohmann::ordered_json json = reportJson(facts_, entries);
    json["paths"] = pathsJson(paths);
    return write(json, script);
  }

  std::filesystem::path write(const nlohmann::ordered_json& report, const std::string& script) const {
    std::string page = reportPage(report);
    if (!script.empty()) page.insert(page.rfind("</body>"), "<p id=result></p><script>" + script + "</script>");
    std::ofstream(scratch_.path() / "index.html", std::ios::binary) << page;
    return scratch_.path() / "index.html";
  }

  TemporaryDirectory scratch_;
  Directory directory_;
  ReportFacts facts_;
  Chromium chromium_{scratch_.path()};
};

TEST_F(Page, DrawsHundredsOfEntries) {
  std::vector<std::string> names;
  for (int i = 0; i < 60; ++i) names.push_back("camera " + std::to_string(i));
  const std::string dom = chromium_.domOf(write(entriesOf(names)));
  EXPECT_EQ(countOf(dom, "data-errors=\"0\""), 1u) << chromium_.log();
  EXPECT_EQ(countOf(dom, "class=\"point\""), 2u * 60 * 10) << "one in each plot";
  EXPECT_EQ(countOf(dom, "class=\"median\""), 2u * 10);
  EXPECT_EQ(countOf(dom, "title=\"Show its pictures\""), 60u * 10);
  EXPECT_NE(dom.find("600 of 600 entries"), std::string::npos);
}

TEST_F(Page, NamesFromOutsideStayText) {
  const std::string dom = chromium_.domOf(write(entriesOf({kHostile, kHostile, ""})), "#camera=%3Cb%3E&y=constructor");
  EXPECT_EQ(countOf(dom, "data-errors=\"0\""), 1u) << chromium_.log();
  EXPECT_EQ(countOf(dom, "title=\"Show its pictures\""), 3u * 10) << "cameras of one name are kept apart";
  EXPECT_EQ(dom.find("<img src=\"x\""), std::string::npos);
  EXPECT_EQ(dom.find("<title>owned"), std::string::npos);
  EXPECT_NE(dom.find("&lt;img src=x onerror="), std::string::npos);
  EXPECT_NE(dom.find("{{data}}"), std::string::npos) << "what was put in is not searched again";
}

TEST_F(Page, PlotsEveryRendererAndTheFrontWhateverTheNames) {
  std::vector<Entry> entries = entriesOf({"one", "two"});
  for (Entry& entry : entries) {
    if (entry.renderer.name == "auto") entry.renderer.name = "auto@texel-pixels=0.35@triangle-budget=2M";
    if (entry.renderer.name == "flat") entry.renderer.name = kHostile;
    if (entry.renderer.name == "A") entry.renderer.name = "A@" + kHostile;
  }
  const std::vector<RendererSummary> summaries = summarise(entries);
  size_t best = 0;
  for (const RendererSummary& summary : summaries) best += summary.onParetoFront ? 1 : 0;
  ASSERT_GT(best, 0u);
  const std::string dom = chromium_.domOf(write(entries));
  EXPECT_EQ(countOf(dom, "data-errors=\"0\""), 1u) << chromium_.log();
  EXPECT_EQ(countOf(dom, "class=\"dot best\""), best);
  EXPECT_EQ(countOf(dom, "class=\"dot\""), summaries.size() - best);
  EXPECT_EQ(countOf(dom, "class=\"front\""), 1u);
  EXPECT_EQ(countOf(dom, "class=\"baseline\""), 2u) << "full geometry at one and at four samples";
  EXPECT_NE(dom.find(">0.35 · 2M</text>"), std::string::npos) << "a variant's values";
  EXPECT_NE(dom.find("<title>auto@texel-pixels=0.35@triangle-budget=2M: ratio "), std::string::npos);
  EXPECT_EQ(countOf(dom, "<td>●</td>"), best) << "in the table";
  EXPECT_EQ(dom.find("<img src=\"x\""), std::string::npos);
  EXPECT_EQ(dom.find("<title>owned"), std::string::npos);
  EXPECT_NE(dom.find("<title>&lt;/script&gt;"), std::string::npos);
}

TEST_F(Page, PlotsTheFrontOfBytesAndComparesAtEqualTimeAndUnderOtherSuns) {
  std::vector<Entry> entries = entriesOf({"one", "two"});
  nlohmann::ordered_json json = reportJson(facts_, entries);
  json["equal"] = equalJson(equalTable(entries));
  json["suns"] = sunsJson(std::vector<SunEntries>{{{0, 0.5}, entries}, {{1, 0.25}, entries}, {{2, 0}, entries}});
  const std::string script = R"js(
    const notes = [], all = (selector) => [...document.querySelectorAll(selector)];
    const chooser = document.querySelector("#front select");
    notes.push(all("#front .dot.best").length);
    chooser.value = "bytes";
    chooser.dispatchEvent(new Event("change"));
    notes.push(all("#front .dot.best").length, all("#equal-summary tbody tr").length, all("#equal-cameras tbody tr").length,
               all("#suns-table tbody tr").length, document.getElementById("suns").hidden);
    document.getElementById("result").textContent = notes.join(" | ");
  )js";
  size_t time = 0, bytes = 0;
  for (const RendererSummary& summary : summarise(entries)) {
    time += summary.onParetoFront ? 1 : 0;
    bytes += summary.onBytesFront ? 1 : 0;
  }
  const std::string dom = chromium_.domOf(write(json, script));
  EXPECT_EQ(countOf(dom, "data-errors=\"0\""), 1u) << chromium_.log();
  const std::string expected = fmt::format("<p id=\"result\">{} | {} | 9 | 18 | 3 | false</p>", time, bytes);
  EXPECT_NE(dom.find(expected), std::string::npos)
      << dom.substr(std::min(dom.size(), dom.find("<p id=\"result\"")), 99);
}

TEST_F(Page, SaysWhenNoRendererHasARatio) {
  std::vector<Entry> entries = entriesOf({"one"});
  for (Entry& entry : entries) entry.ratioToFull1spp.reset();
  const std::string dom = chromium_.domOf(write(entries));
  EXPECT_EQ(countOf(dom, "data-errors=\"0\""), 1u) << chromium_.log();
  EXPECT_NE(dom.find(">No ratio to show</text>"), std::string::npos);
}

TEST_F(Page, SaysWhenTheRunWasInterrupted) {
  EXPECT_NE(chromium_.domOf(write(entriesOf({"a"}))).find("id=\"incomplete\" class=\"banner\" hidden"),
            std::string::npos);
  facts_.complete = false;
  const std::string dom = chromium_.domOf(write(entriesOf({"a"})));
  EXPECT_NE(dom.find("id=\"incomplete\" class=\"banner\">Incomplete: "), std::string::npos);
  EXPECT_EQ(countOf(dom, "data-errors=\"0\""), 1u);
}

TEST_F(Page, FollowsWhatAReaderDoes) {
  // Each step notes what it changed.
  const std::string script = R"js(
    const notes = [], all = (selector) => [...document.querySelectorAll(selector)];
    const note = (value) => notes.push(String(value));
    note(all("#plot-time .point").length);
    document.querySelector("#legend button").click();                          // hides full-1spp
    note(all("#plot-time .point").length);
    const metric = document.getElementById("metric");
    metric.value = "ratioToFull1spp";
    metric.dispatchEvent(new Event("change"));
    note(all(".plots .level").length);                                         // the line at 1, in both plots
    const heading = all("#entries thead button").find((button) => button.textContent === "Error");
    const errors = () => all("#entries tbody tr").map((row) => Number(row.children[2].textContent));
    const sorted = (values) => values.every((value, i) => i === 0 || values[i - 1] <= value);
    heading.click();
    note(sorted(errors()));
    heading.click();
    note(sorted(errors().reverse()));
    const filter = document.getElementById("filter");
    filter.value = "FULL-16";
    filter.dispatchEvent(new Event("input"));
    note(document.getElementById("shown").textContent);
    const point = all("#plot-time .point")[0].getBoundingClientRect();
    document.querySelector("#plot-time > svg").dispatchEvent(new PointerEvent("pointermove",
      { clientX: point.x + point.width / 2, clientY: point.y + point.height / 2 }));
    note(document.querySelector("#plot-time .readout").hidden);
    note(all("#plot-bytes .ring").length);
    all("#entries tbody tr").find((row) => row.textContent.startsWith("two") && row.textContent.includes("flat")).click();
    note(all("#picture-controls select").map((node) => node.value));
    all(".buttons button").find((button) => button.value === "flip").click();
    note(all(".key").map((node) => node.textContent));
    note(decodeURIComponent(location.hash).includes("y=ratioToFull1spp") && location.hash.includes("mode=flip"));
    document.getElementById("result").textContent = notes.join(" | ");
  )js";
  const std::string dom = chromium_.domOf(write(entriesOf({"one", "two"}), script));
  EXPECT_EQ(countOf(dom, "data-errors=\"0\""), 1u) << chromium_.log();
  EXPECT_NE(dom.find("<p id=\"result\">20 | 18 | 2 | true | true | 2 of 20 entries | false | 1 | two,reference,flat | "
                     "FLIP, 0 to 1 | true</p>"),
            std::string::npos)
      << dom.substr(std::min(dom.size(), dom.find("<p id=\"result\"")), 400);
}

// Every renderer's flicker rises from 0 to the last frame; in frame 3 cells switch.
PathEntry pathOf(const std::string& name, size_t frames) {
  PathEntry path;
  path.name = name;
  path.stem = fileStems({name}).front();
  const auto plans = planRenderers("auto", 640, 360, {});
  for (const RendererPlan& plan : plans.value()) {
    path.runs.push_back({plan, {}});
    for (size_t i = 0; i < frames; ++i) {
      PathFrame frame;
      frame.change = {2, 1, 0.1 * static_cast<double>(i)};
      frame.viewSwitches = i == 3 ? 5 : 0;
      path.runs.back().frames.push_back(frame);
    }
  }
  return path;
}

TEST_F(Page, ShowsPathsFrameByFrame) {
  const std::string script = R"js(
    const notes = [], all = (selector) => [...document.querySelectorAll(selector)];
    const note = (value) => notes.push(String(value));
    note(all("#path-plot polyline").length);                                   // three renderers and the truth
    note(all("#path-plot .switch").length);
    const svg = document.querySelector("#path-plot > svg"), box = svg.getBoundingClientRect();
    const mark = all("#path-plot .switch")[0].getBoundingClientRect();
    svg.dispatchEvent(new PointerEvent("pointermove", { clientX: mark.x + mark.width / 2, clientY: box.y + 50 }));
    note(document.querySelector("#path-plot .readout").textContent.replace(/\s+/g, " "));
    note(all("#path-summary tbody tr").length);
    note(all("#path-pictures .worst").length);
    const [path, key] = all("#path-plot select");
    key.value = "ms";
    key.dispatchEvent(new Event("change"));
    note(all("#path-plot polyline").length);                                   // no truth
    path.value = "1";
    path.dispatchEvent(new Event("change"));
    note(all("#path-plot polyline")[0].getAttribute("points").split(" ").length);
    note(document.querySelector(".of-cameras").hidden);
    document.getElementById("result").textContent = notes.join(" | ");
  )js";
  const std::string dom = chromium_.domOf(write({}, script, {pathOf(kHostile, 6), pathOf("b", 4)}));
  EXPECT_EQ(countOf(dom, "data-errors=\"0\""), 1u) << chromium_.log();
  EXPECT_NE(dom.find("<p id=\"result\">4 | 3 | Frame 3the reference's change1.00 full-1spp0.300 · 5 switched "
                     "full-4spp0.300 · 5 switched auto0.300 · 5 switched | 3 | 3 | 3 | 4 | true</p>"),
            std::string::npos)
      << dom.substr(std::min(dom.size(), dom.find("<p id=\"result\"")), 400);
  EXPECT_EQ(dom.find("<img src=\"x\""), std::string::npos);
}

TEST_F(Page, OfAPathWithoutFramesSaysSo) {
  const std::string dom = chromium_.domOf(write(entriesOf({"one"}), "", {pathOf("a", 0)}));
  EXPECT_EQ(countOf(dom, "data-errors=\"0\""), 1u) << chromium_.log();
  EXPECT_NE(dom.find(">No frame to show</text>"), std::string::npos);
}

TEST(ReportPage, IsWholeAndHoldsNoMarkupFromOutside) {
  Directory directory;
  ReportFacts facts;
  facts.directory = &directory;
  facts.packName = kHostile;
  const std::string page = reportPage(reportJson(facts, entriesOf({kHostile})));
  EXPECT_EQ(countOf(page, "</script>"), 3u) << "its own three";
  EXPECT_EQ(page.find("<img"), std::string::npos);
  EXPECT_EQ(page.find("{{style}}"), std::string::npos);
  EXPECT_TRUE(page.ends_with("</html>\n"));
}

}  // namespace
}  // namespace farcell
