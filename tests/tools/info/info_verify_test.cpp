// farcell-info and farcell-verify as a person or a script runs them.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>

#include "tests/cache/pack/samples.h"
#include "tools/report/build_report_json.h"

namespace farcell {
namespace {

using Json = nlohmann::json;
using samples::TemporaryFile;

struct Outcome {
  int code = -1;
  std::string out;
  std::string err;
};

std::string textOf(const std::filesystem::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

Outcome run(const std::string& program, const std::string& arguments) {
  const TemporaryFile out("out.txt"), err("err.txt");
  const std::string command = fmt::format("'{}/{}' {} >'{}' 2>'{}'", FARCELL_PROGRAMS_DIR, program, arguments,
                                          out.path().string(), err.path().string());
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, textOf(out.path()), textOf(err.path())};
}

TEST(FarcellInfo, PrintsTheContractAndTheModelOfAPack) {
  const TemporaryFile file("info.far");
  samples::write(samples::fullPack(), file.path());
  const Outcome outcome = run("farcell-info", file.path().string() + " --json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json json = Json::parse(outcome.out);
  EXPECT_EQ(json["input"],
            Json::parse(R"({"triangles":2,"vertices":6,"skipped":{"nonFinitePosition":3,"zeroArea":1}})"));
  EXPECT_EQ(json["cells"], Json::parse(R"({"leaf":2,"inner":1})"));
  EXPECT_EQ(json["views"], Json::parse(R"({"baked":126,"kept":3,"leftOut":{"empty":123}})"));
  EXPECT_EQ(json["bytes"]["pack"], std::filesystem::file_size(file.path()));
  EXPECT_EQ(json["bytes"]["impostorsRaw"], 2000);
  EXPECT_GT(json["bytes"]["impostors"], 0);
  EXPECT_GT(json["bytes"]["geometry"], 0);
  for (const char* stage : {"read", "partition", "lod", "bake", "encode", "total"})
    EXPECT_TRUE(json["seconds"].at(stage).is_null()) << stage;
  EXPECT_TRUE(json.at("peakRssBytes").is_null());

  EXPECT_EQ(json["format"]["version"], 0);
  EXPECT_EQ(json["model"]["source"], "city \xc3\xa4.ply");
  EXPECT_EQ(json["model"]["sourceHash"], "0123456789abcdef");
  EXPECT_EQ(json["model"]["grid"], Json::parse(R"({"origin":[-5,1000000,0.125],"side":80,"bits":20})"));
  // 2^19 of 2^20 steps of an edge of 80 from -5.
  EXPECT_EQ(json["model"]["bounds"]["max"][0], 35);
  EXPECT_EQ(json["model"]["bounds"]["min"], Json::parse("[-5,1000000,0.125]"));
  EXPECT_EQ(json["model"]["up"], "y");
  EXPECT_EQ(json["model"]["metresPerUnit"], 0.0254);
  EXPECT_EQ(json["settings"]["views"], 42);
  EXPECT_EQ(json["settings"]["lighting"], "relightable");
  EXPECT_EQ(json["settings"]["viewError"], 0);
  EXPECT_EQ(json["levels"], Json::parse(R"([
    {"level":0,"leaf":0,"inner":1,"triangles":0,"meshTriangles":0,"geometricErrorMetres":0.0},
    {"level":1,"leaf":2,"inner":0,"triangles":2,"meshTriangles":0,"geometricErrorMetres":0.0}])"));
  EXPECT_EQ(json["pages"], Json::parse(R"({"geometry":2,"textures":2,"views":3})"));
}

TEST(FarcellInfo, PrintsTextForPeopleWithoutControlCharacters) {
  const TemporaryFile file("text.far");
  samples::FullPack pack = samples::fullPack();
  pack.directory.sourceName = "a\x1b[31m\xff.ply";
  samples::write(pack, file.path());
  const Outcome outcome = run("farcell-info", file.path().string());
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find('\x1b'), std::string::npos);
  EXPECT_NE(outcome.out.find("triangles"), std::string::npos);
  const Outcome json = run("farcell-info", "--json " + file.path().string());
  ASSERT_EQ(json.code, 0) << json.err;
  EXPECT_EQ(Json::parse(json.out)["model"]["source"], "a\x1b[31m\xef\xbf\xbd.ply");
}

TEST(FarcellInfo, CountsTheTrianglesOfAMesh) {
  const TemporaryFile file("mesh.obj");
  std::ofstream(file.path()) << "v 0 0 0\nv 2 0 0\nv 2 3 0\nv 0 3 -1\nf 1 2 3 4\nf 1 1 2\n";
  const Outcome outcome = run("farcell-info", "--json " + file.path().string());
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json json = Json::parse(outcome.out);
  EXPECT_EQ(json["input"], Json::parse(R"({"triangles":2,"vertices":4,"skipped":{"zeroArea":1}})"));
  EXPECT_EQ(json["bounds"], Json::parse(R"({"min":[0,0,-1],"max":[2,3,0]})"));
  EXPECT_EQ(json["hasColours"], false);
  EXPECT_EQ(json["hasNormals"], false);
}

TEST(FarcellInfo, FailsWithOneMessageAndNothingOnStdout) {
  const TemporaryFile file("bad.far");
  samples::write(samples::fullPack(), file.path());
  samples::Bytes bytes = samples::readAll(file.path());
  bytes.pop_back();
  samples::writeAll(file.path(), bytes);
  const Outcome cut = run("farcell-info", file.path().string() + " --json");
  EXPECT_EQ(cut.code, 1);
  EXPECT_EQ(cut.out, "");
  EXPECT_NE(cut.err.find(file.path().string() + ": offset "), std::string::npos) << cut.err;
  EXPECT_EQ(run("farcell-info", "/nowhere.far").code, 1);
  EXPECT_EQ(run("farcell-info", "").code, 2);
  EXPECT_EQ(run("farcell-info", "--no-such-option x").code, 2);
}

TEST(FarcellVerify, SaysThatAWholePackIsValid) {
  const TemporaryFile file("valid.far");
  samples::write(samples::fullPack(), file.path());
  const Outcome text = run("farcell-verify", file.path().string());
  EXPECT_EQ(text.code, 0) << text.err;
  EXPECT_EQ(text.out, fmt::format("{}: valid, 7 pages, {} bytes\n", file.path().string(),
                                  std::filesystem::file_size(file.path())));
  const Outcome json = run("farcell-verify", "--json " + file.path().string());
  EXPECT_EQ(json.code, 0);
  EXPECT_EQ(Json::parse(json.out)["valid"], true);
  EXPECT_EQ(Json::parse(json.out)["findings"], Json::array());
}

TEST(FarcellVerify, PrintsALineForEachFindingAndFails) {
  const TemporaryFile file("damaged.far");
  samples::write(samples::fullPack(), file.path());
  samples::Bytes bytes = samples::readAll(file.path());
  const std::vector<PageRecord> pages = PackFile::open(file.path())->directory().pages;
  for (const size_t offset : {pages[0].offsetBytes, pages[3].offsetBytes - 1}) bytes.at(offset) ^= std::byte{1};
  samples::writeAll(file.path(), bytes);
  const Outcome outcome = run("farcell-verify", file.path().string());
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find(": offset 32: page 0: expected checksum "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find(fmt::format(": offset {}: page 2: expected checksum ", pages[2].offsetBytes)),
            std::string::npos)
      << outcome.err;
  const Json json = Json::parse(run("farcell-verify", "--json " + file.path().string()).out);
  EXPECT_EQ(json["valid"], false);
  EXPECT_EQ(json["findings"].size(), 2u);
  const Json first = Json::parse(run("farcell-verify", "--json --max-findings 1 " + file.path().string()).out);
  EXPECT_EQ(first["findings"].size(), 1u);
}

TEST(FarcellVerify, ReportsAPackThatCannotBeOpenedAndFailsOnMissingFiles) {
  const TemporaryFile file("cut.far");
  samples::write(samples::fullPack(), file.path());
  samples::Bytes bytes = samples::readAll(file.path());
  bytes.resize(bytes.size() / 2);
  samples::writeAll(file.path(), bytes);
  const Outcome cut = run("farcell-verify", "--json " + file.path().string());
  EXPECT_EQ(cut.code, 1);
  EXPECT_EQ(Json::parse(cut.out)["findings"].size(), 1u);
  EXPECT_EQ(run("farcell-verify", "/nowhere.far").code, 1);
  EXPECT_EQ(run("farcell-verify", "").code, 2);
}

TEST(BuildReportJson, HoldsTimesAndMemoryWhenTheyAreKnown) {
  const BuildTimes times{1, 2, 3, 4, 5, 15.5};
  const uint64_t peak = uint64_t{1} << 33;
  const Json json = buildReportJson(samples::fullDirectory(), 123, &times, &peak);
  EXPECT_EQ(json["seconds"], Json::parse(R"({"read":1,"partition":2,"lod":3,"bake":4,"encode":5,"total":15.5})"));
  EXPECT_EQ(json["peakRssBytes"], peak);
  EXPECT_EQ(json["bytes"]["pack"], 123);
}

}  // namespace
}  // namespace farcell
