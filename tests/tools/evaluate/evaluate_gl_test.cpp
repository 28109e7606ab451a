// The whole program, on packs whose pictures are known.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "tests/support/evaluate_models.h"
#include "tools/image/png.h"

namespace farcell {
namespace {

using Json = nlohmann::json;
using testing::TemporaryDirectory;

std::string textOf(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

// A sphere's pack, its mesh file and two cameras of hostile names that clean up to the same.
class EvaluateProgram : public ::testing::Test {
 protected:
  void SetUp() override {
    const testing::TestModel model = testing::sphereModel({100, 200, 300}, 10, 4);
    const uint64_t hash = testing::writeTestPly(model, path("sphere.ply"));
    testing::writeTestPack(model, path("sphere.far"), hash);
    writeCameras(R"({"name":"../x","position":[140,210,310],"target":[100,200,300],"up":[0,0,1],"fovYDeg":40},
                    {"name":"..?x","position":[100,260,320],"target":[100,200,300],"up":[0,0,1],"fovYDeg":30})");
  }

  std::filesystem::path path(const std::string& name) const { return directory_.path() / name; }

  void writeCameras(const std::string& cameras) const {
    std::ofstream(path("cameras.json")) << "{\"cameras\":[" << cameras << "]}";
  }

  // Exit code; stdout and stderr go to files of those names.
  int run(const std::string& arguments) const {
    const std::string command = std::string(FARCELL_PROGRAMS_DIR) + "/farcell-evaluate " + arguments + " > " +
                                path("stdout").string() + " 2> " + path("stderr").string();
    const int status = std::system(("cd " + directory_.path().string() + " && " + command).c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  Json report() const { return Json::parse(textOf(path("report/report.json"))); }

  TemporaryDirectory directory_;
};

TEST_F(EvaluateProgram, FullGeometryConvergesToTheReferenceWithItsSamples) {
  ASSERT_EQ(
      run("sphere.far --cameras cameras.json --renderers full-16spp,triangles --size 200x150 --frames 2 -o report"), 0)
      << textOf(path("stderr"));
  const Json entries = report().at("entries");
  ASSERT_EQ(entries.size(), 8u);
  for (size_t camera = 0; camera < 2; ++camera) {
    const Json& one = entries[4 * camera];
    const Json& four = entries[4 * camera + 1];
    const Json& sixteen = entries[4 * camera + 2];
    EXPECT_EQ(one.at("renderer"), "full-1spp");
    EXPECT_EQ(one.at("ratioToFull1spp"), 1.0);
    EXPECT_LT(four.at("ratioToFull1spp"), 0.7);
    EXPECT_LT(sixteen.at("ratioToFull1spp"), four.at("ratioToFull1spp"));
    EXPECT_GT(sixteen.at("psnr"), 40) << "runtime and reference agree on camera, shading and coverage";
    EXPECT_LT(std::abs(sixteen.at("coverageBias").get<double>()), 0.005);
    EXPECT_EQ(one.at("holeRate"), 0);
    EXPECT_EQ(one.at("triangles"), 8 * 256);
    EXPECT_GT(one.at("bytesRead"), 0);
    EXPECT_EQ(one.at("impostorShare"), 0);
  }
  EXPECT_TRUE(report().at("summary").contains("triangles"));
}

TEST_F(EvaluateProgram, HostileNamesStayInTheReportsDirectoryAndApart) {
  ASSERT_EQ(run("sphere.far --cameras cameras.json --renderers full-1spp --size 40x30 --frames 1 --reference-samples 4 "
                "-o report"),
            0)
      << textOf(path("stderr"));
  int pictures = 0;
  for (const auto& file : std::filesystem::directory_iterator(path("report")))
    pictures += file.path().extension() == ".png" ? 1 : 0;
  EXPECT_EQ(pictures, 2 * (1 + 2 * 3)) << "of each camera the reference, and three for each of two renderers";
  for (const auto& file : std::filesystem::directory_iterator(directory_.path()))
    EXPECT_NE(file.path().extension(), ".png") << file.path();
}

TEST_F(EvaluateProgram, TheOriginalFileCanBeTheTruthAndOnlyThatFile) {
  const std::string common =
      "sphere.far --cameras cameras.json --renderers full-4spp --size 100x80 --frames 1 -o report ";
  ASSERT_EQ(run(common + "--mesh sphere.ply --json"), 0) << textOf(path("stderr"));
  const Json json = report();
  EXPECT_EQ(Json::parse(textOf(path("stdout"))), json);
  EXPECT_EQ(json.at("reference").at("kind"), "mesh");
  EXPECT_GT(json.at("entries")[1].at("psnr"), 35);
  std::ofstream(path("sphere.ply"), std::ios::app) << "\n";
  EXPECT_EQ(run(common + "--mesh sphere.ply"), 2);
  EXPECT_NE(textOf(path("stderr")).find("not the same source"), std::string::npos) << textOf(path("stderr"));
}

TEST_F(EvaluateProgram, MakesItsOwnCamerasAndWritesThem) {
  ASSERT_EQ(
      run("sphere.far --auto-cameras 3 --renderers full-1spp --size 40x30 --frames 1 --reference-samples 1 -o report"),
      0)
      << textOf(path("stderr"));
  const Json cameras = Json::parse(textOf(path("report/cameras.json"))).at("cameras");
  EXPECT_EQ(cameras.size(), 3u);
  EXPECT_NEAR(report().at("entries")[0].at("diameters").get<double>(), 0.25, 1e-6);
  EXPECT_EQ(run("sphere.far --cameras report/cameras.json --renderers full-1spp --size 40x30 --frames 1 -o again"), 0);
}

TEST_F(EvaluateProgram, ASweepRunsEveryVariantAgainstTheSameReferences) {
  ASSERT_EQ(run("sphere.far --cameras cameras.json --renderers A,auto --sweep texel-pixels=0.5,8 --sweep "
                "triangle-budget=0,10k --size 60x40 --frames 1 --reference-samples 4 -o report"),
            0)
      << textOf(path("stderr"));
  const Json json = report();
  EXPECT_EQ(json.at("entries").size(), 2u * (2 + 2 + 4));
  EXPECT_EQ(json.at("summary").size(), 8u);
  const std::string variant = "auto@texel-pixels=8@triangle-budget=10k";
  EXPECT_TRUE(json.at("summary").contains(variant));
  EXPECT_EQ(json.at("entries")[7].at("renderer"), variant);
  EXPECT_EQ(json.at("entries")[7].at("settings").at("texelPixels"), 8);
  EXPECT_EQ(json.at("entries")[7].at("settings").at("triangleBudget"), 10'000);
  const std::string lines = textOf(path("report/summary.csv"));
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 1 + 8);
  int pictures = 0;
  for (const auto& file : std::filesystem::directory_iterator(path("report")))
    pictures += file.path().extension() == ".png" ? 1 : 0;
  EXPECT_EQ(pictures, 2 * (1 + 3 * 8));
}

TEST_F(EvaluateProgram, SaysWhatIsWrongWithTheRightExitCode) {
  EXPECT_EQ(run("sphere.far --cameras cameras.json --renderers C -o report"), 2);
  EXPECT_EQ(run("sphere.far --cameras cameras.json --reference-samples 7 -o report"), 2);
  EXPECT_EQ(run("sphere.far --cameras cameras.json --sweep texel-pixels=0 -o report"), 2);
  EXPECT_NE(textOf(path("stderr")).find("expected a number from 0.01 to 100, found '0'"), std::string::npos);
  EXPECT_EQ(run("sphere.far --cameras cameras.json --background 1,2,256 -o report"), 2);
  EXPECT_EQ(run("sphere.far --cameras cameras.json --background 1,2 -o report"), 2);
  EXPECT_EQ(run("sphere.far --cameras cameras.json --auto-cameras 3 -o report"), 2);
  EXPECT_EQ(run("sphere.far -o report"), 2);
  EXPECT_EQ(run("sphere.far --cameras cameras.json"), 2);
  EXPECT_EQ(run("absent.far --cameras cameras.json -o report"), 1);
  EXPECT_NE(textOf(path("stderr")).find("absent.far"), std::string::npos);
  EXPECT_EQ(run("sphere.far --cameras cameras.json --size 10x10 -o sphere.ply/report"), 1);
  EXPECT_FALSE(std::filesystem::exists(path("report/report.json")));
}

TEST_F(EvaluateProgram, ReferenceAndRenderersAreLitAlikeAndTheReportSaysBy) {
  testing::TestModel model = testing::sphereModel({100, 200, 300}, 10, 4);
  model.lighting = Lighting::relightable;
  testing::writeTestPack(model, path("relightable.far"), 1);
  const std::string common =
      "relightable.far --cameras cameras.json --size 120x90 --frames 1 --renderers full-16spp -o ";
  ASSERT_EQ(run(common + "report --sun 200,-20 --suns 2"), 0) << textOf(path("stderr"));
  EXPECT_EQ(report().at("light").at("text"), "sun 200,-20");
  ASSERT_EQ(report().at("suns").size(), 2u);
  for (const Json& sun : report().at("suns"))
    EXPECT_LT(sun.at("renderers").at("full-16spp").at("ratioToFull1spp"), 0.5) << sun;
  EXPECT_EQ(textOf(path("report/suns.csv")).find("azimuthDeg,elevationDeg,camera,"), 0u);
  for (const Json& entry : report().at("entries"))
    if (entry.at("renderer") == "full-16spp") {
      EXPECT_GT(entry.at("psnr"), 38);
    }

  ASSERT_EQ(run(common + "report --light headlight"), 0) << textOf(path("stderr"));
  EXPECT_EQ(report().at("light").at("text"), "headlight");
  EXPECT_TRUE(report().at("light").at("sun").is_null());
  for (const Json& entry : report().at("entries"))
    if (entry.at("renderer") == "full-16spp") {
      EXPECT_GT(entry.at("psnr"), 38);
    }
}

TEST_F(EvaluateProgram, RefusesAnotherLightThanABakedPacksBeforeAnyWork) {
  for (const std::string light : {"--light headlight", "--sun 10,10", "--suns 3"}) {
    EXPECT_EQ(run("sphere.far --cameras cameras.json --size 120x90 -o report " + light), 2) << light;
    EXPECT_NE(textOf(path("stderr")).find("--lighting relightable"), std::string::npos) << textOf(path("stderr"));
    EXPECT_FALSE(std::filesystem::exists(path("report"))) << light;
  }
}

TEST_F(EvaluateProgram, ACameraThatSeesNothingIsReportedButDoesNotCount) {
  writeCameras(R"({"name":"away","position":[140,210,310],"target":[180,220,320],"up":[0,0,1],"fovYDeg":40},
                  {"name":"here","position":[140,210,310],"target":[100,200,300],"up":[0,0,1],"fovYDeg":40})");
  ASSERT_EQ(run("sphere.far --cameras cameras.json --renderers full-4spp --size 60x40 --frames 1 -o report"), 0)
      << textOf(path("stderr"));
  EXPECT_NE(textOf(path("stderr")).find("'away' sees nothing"), std::string::npos);
  const Json json = report();
  EXPECT_TRUE(json.at("entries")[0].at("ratioToFull1spp").is_null());
  EXPECT_EQ(json.at("summary").at("full-4spp").at("cameras"), 1);
}

TEST_F(EvaluateProgram, RenderersOfAnotherPackOfTheSameModelAreInTheSameRun) {
  const testing::TestModel model = testing::sphereModel({100, 200, 300}, 10, 4);
  testing::writeTestPack(model, path("root.far"), PackFile::open(path("sphere.far"))->directory().sourceHash, true);
  ASSERT_EQ(run("sphere.far --against root=root.far --cameras cameras.json --renderers auto,triangles@root,lod-as-auto "
                "--samples 4 --size 60x40 --frames 1 --reference-samples 4 -o report"),
            0)
      << textOf(path("stderr"));
  const Json json = report();
  ASSERT_EQ(json.at("entries").size(), 2u * 5);
  const Json& other = json.at("entries")[4];
  EXPECT_EQ(other.at("renderer"), "triangles@root");
  EXPECT_EQ(other.at("paperError"), json.at("entries")[1].at("paperError")) << "the same triangles at four samples";
  EXPECT_EQ(json.at("against").at("root").at("name"), "root.far");
  EXPECT_NEAR(json.at("against").at("root").at("bytesToPack").get<double>(),
              static_cast<double>(std::filesystem::file_size(path("root.far"))) /
                  static_cast<double>(std::filesystem::file_size(path("sphere.far"))),
              1e-9);
  const Json& lod = json.at("entries")[3];
  EXPECT_EQ(lod.at("renderer"), "lod-as-auto");
  EXPECT_GE(lod.at("settings").at("meshPixels"), 0.01);
  EXPECT_LE(lod.at("settings").at("meshPixels"), 100);
}

TEST_F(EvaluateProgram, AnOctahedralImpostorIsAmongTheRenderersOfCameras) {
  ASSERT_EQ(run("sphere.far --cameras cameras.json --renderers auto,octahedral --size 60x40 --frames 1 "
                "--reference-samples 4 -o report"),
            0)
      << textOf(path("stderr"));
  const Json entry = report().at("entries")[3];
  EXPECT_EQ(entry.at("renderer"), "octahedral");
  EXPECT_GE(entry.at("settings").at("frameEdge"), 16);
  EXPECT_EQ(entry.at("impostors"), 1);
  EXPECT_GT(entry.at("impostorShare"), 0.99);
  EXPECT_GT(entry.at("psnr"), 15);
}

TEST_F(EvaluateProgram, APackOfAnotherModelIsRefused) {
  testing::writeTestPack(testing::sphereModel({100, 200, 300}, 10, 4), path("other.far"), 12345);
  const std::string rest = " --cameras cameras.json --size 60x40 -o report";
  EXPECT_EQ(run("sphere.far --against x=other.far" + rest), 2);
  const std::string message = textOf(path("stderr"));
  EXPECT_NE(message.find("other.far: not a pack of the same model as sphere.far"), std::string::npos) << message;
  EXPECT_NE(message.find("0000000000003039"), std::string::npos) << "both hashes";
  for (const char* wrong : {"other.far", "=other.far", "a,b=other.far", "x="}) {
    EXPECT_EQ(run(std::string("sphere.far --against '") + wrong + "'" + rest), 2) << wrong;
    EXPECT_NE(textOf(path("stderr")).find("expected NAME=PACK"), std::string::npos) << wrong;
  }
  EXPECT_EQ(run("sphere.far --against x=sphere.far --against x=sphere.far" + rest), 2);
  EXPECT_EQ(run("sphere.far --against x=absent.far" + rest), 1);
  EXPECT_FALSE(std::filesystem::exists(path("report")));
}

// Mean |a - b| over the pixels and channels of two pictures.
double meanDifference(const std::filesystem::path& a, const std::filesystem::path& b) {
  const auto first = readPng(a, 1 << 20), second = readPng(b, 1 << 20);
  if (!first || !second || first->pixels.size() != second->pixels.size()) {
    ADD_FAILURE() << a << " and " << b;
    return 0;
  }
  double sum = 0;
  for (size_t i = 0; i < first->pixels.size(); ++i) sum += std::abs(int(first->pixels[i]) - int(second->pixels[i]));
  return sum / static_cast<double>(first->pixels.size());
}

TEST_F(EvaluateProgram, APathHasErrorAndFlickerOfEachFrame) {
  writeCameras(R"({"name":"a","position":[140,210,310],"target":[100,200,300],"up":[0,0,1],"fovYDeg":40,"time":0},
                  {"name":"b","position":[139,213,310],"target":[100,200,300],"up":[0,0,1],"fovYDeg":40,"time":3})");
  ASSERT_EQ(run("sphere.far --path cameras.json --path orbit --path-frames 2 --renderers full-16spp --size 120x80 "
                "--reference-samples 16 -o report"),
            0)
      << textOf(path("stderr"));
  const Json json = report();
  EXPECT_EQ(json.at("entries").size(), 0u);
  ASSERT_EQ(json.at("paths").size(), 2u);
  const Json& drive = json.at("paths")[0];
  EXPECT_EQ(drive.at("name"), "cameras");
  EXPECT_EQ(drive.at("frames"), 2);
  ASSERT_EQ(drive.at("renderers").size(), 3u);
  const std::string stem = drive.at("stem");
  for (const Json& run : drive.at("renderers")) {
    const std::string name = "report/" + stem + "." + run.at("renderer").get<std::string>();
    const Json& frames = run.at("frames");
    EXPECT_NEAR(frames.at("ownChange")[1], meanDifference(path(name + ".worst-before.png"), path(name + ".worst.png")),
                0.3)
        << "pictures are rounded";
    EXPECT_GT(frames.at("ownChange")[1], 0.5);
    EXPECT_EQ(frames.at("flicker")[0], 0);
    EXPECT_EQ(run.at("summary").at("switchFrames"), 0) << "all frames draw every triangle";
    EXPECT_GT(frames.at("bytesRead")[0], 0);
    EXPECT_EQ(frames.at("bytesRead")[1], 0) << "pages stay";
  }
  const auto flicker = [&](size_t run) {
    return drive.at("renderers")[run].at("summary").at("meanFlicker").get<double>();
  };
  EXPECT_LT(flicker(1), flicker(0));
  EXPECT_LT(flicker(2), flicker(1));
  EXPECT_LT(flicker(2), drive.at("renderers")[2].at("summary").at("referenceChange"));
  const std::string lines = textOf(path("report/paths.csv"));
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 1 + 2 * 2 * 3);
  EXPECT_EQ(Json::parse(textOf(path("report/" + stem + ".cameras.json"))).at("cameras").size(), 2u);
}

TEST_F(EvaluateProgram, APathThatCannotBeIsAnErrorBeforeAnyWork) {
  writeCameras(R"({"name":"a","position":[140,210,310],"target":[100,200,300],"up":[0,0,1],"fovYDeg":40})");
  EXPECT_EQ(run("sphere.far --path cameras.json -o report"), 2);
  EXPECT_NE(textOf(path("stderr")).find("cameras.json: a path needs two cameras"), std::string::npos);
  EXPECT_EQ(run("sphere.far --path absent.json -o report"), 1);
  EXPECT_EQ(run("sphere.far --path orbit --path-frames 1 -o report"), 2);
  EXPECT_FALSE(std::filesystem::exists(path("report")));
}

TEST_F(EvaluateProgram, AnInterruptKeepsTheCamerasThatWereFinished) {
  // Far more cameras than can be measured before the second one's picture is noticed.
  const std::string command =
      "cd " + directory_.path().string() + " && { " + FARCELL_PROGRAMS_DIR +
      "/farcell-evaluate sphere.far --auto-cameras 500 --renderers full-1spp --size 40x30 --reference-samples 1 "
      "--frames 1 -o report > stdout 2> stderr & pid=$!; "
      "while kill -0 $pid && [ ! -e report/auto-02-0_5d.reference.png ]; do sleep .02; done; "
      "kill -TERM $pid; wait $pid; }";
  const int status = std::system(command.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 1) << textOf(path("stderr"));
  const Json json = report();
  EXPECT_EQ(json.at("complete"), false);
  EXPECT_GE(json.at("entries").size(), 2u);
  EXPECT_LT(json.at("entries").size(), 1000u);
  EXPECT_EQ(json.at("entries").size() % 2, 0u) << "whole cameras only";
}

}  // namespace
}  // namespace farcell
