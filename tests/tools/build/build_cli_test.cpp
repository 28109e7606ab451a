// farcell-build, and farcell-info of what it was given, as a person or a script runs them.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "cache/base/file.h"
#include "tests/preprocess/read/read_support.h"

namespace farcell::test {
namespace {

using Json = nlohmann::json;

class BuildProgram : public testing::Test {
 protected:
  struct Outcome {
    int code = -1;
    std::string out;
    std::string err;
  };

  BuildProgram() {
    directory_.write("a.off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    directory_.write("b.obj", "v 0 0 1\nv 1 0 1\nv 0 1 1\nf 1 2 3\nf 1 1 2\n");
    directory_.write("scene.json", R"({"up":"x","unit":"cm","files":[{"path":"a.off"},
      {"path":"b.obj","instances":[{"translation":[0,0,2]},{"translation":[0,0,4]}]}]})");
  }

  // Arguments are of this directory.
  Outcome run(const std::string& program, const std::string& arguments) const {
    const std::string command = fmt::format("cd '{}' && '{}/{}' {} >out.txt 2>err.txt", directory_.path().string(),
                                            FARCELL_PROGRAMS_DIR, program, arguments);
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text("out.txt"), text("err.txt")};
  }
  std::string text(const char* name) const { return readTextFile(directory_.path() / name, 1 << 20).value_or(""); }

  // The model of the pack that these arguments build.
  Json modelOf(const std::string& arguments) const {
    const Outcome built = run("farcell-build", "-o x.far --quiet --views 12 --image-size 16 " + arguments);
    EXPECT_EQ(built.code, 0) << built.err;
    return Json::parse(run("farcell-info", "--json x.far").out, nullptr, false)["model"];
  }

  TempDirectory directory_;
};

TEST_F(BuildProgram, TakesUpAndUnitFromTheCommandLineElseFromTheModel) {
  EXPECT_EQ(modelOf("a.off")["up"], "z");
  EXPECT_EQ(modelOf("b.obj")["up"], "y");
  EXPECT_EQ(modelOf("b.obj a.off")["up"], "y");
  const Json scene = modelOf("scene.json");
  EXPECT_EQ(scene["source"], "scene.json");
  EXPECT_EQ(scene["up"], "x");
  EXPECT_EQ(scene["metresPerUnit"], 0.01);
  const Json told = modelOf("scene.json --up z --unit ft");
  EXPECT_EQ(told["up"], "z");
  EXPECT_EQ(told["metresPerUnit"], 0.3048);
  EXPECT_EQ(modelOf("a.off --unit 2.5")["metresPerUnit"], 2.5);
}

TEST_F(BuildProgram, TakesLightingAndSun) {
  const auto settingsOf = [&](const std::string& arguments) {
    const Outcome built = run("farcell-build", "a.off -o x.far --quiet --views 12 --image-size 16 " + arguments);
    EXPECT_EQ(built.code, 0) << built.err;
    return Json::parse(run("farcell-info", "--json x.far").out, nullptr, false)["settings"];
  };
  EXPECT_EQ(settingsOf("")["lighting"], "baked");
  const Json told = settingsOf("--lighting relightable --sun -120,30");
  EXPECT_EQ(told["lighting"], "relightable");
  EXPECT_NEAR(told["sun"][0].get<double>(), -120, 1e-9);
  EXPECT_NEAR(told["sun"][1].get<double>(), 30, 1e-9);
}

TEST_F(BuildProgram, BuildsSeveralFilesAsOneModel) {
  const Outcome built = run("farcell-build", "a.off b.obj -o x.far --json --quiet");
  ASSERT_EQ(built.code, 0) << built.err;
  EXPECT_EQ(Json::parse(built.out)["input"], Json::parse(R"({"triangles":2,"vertices":6,"skipped":{"zeroArea":1}})"));
}

TEST_F(BuildProgram, InfoSaysWhatAMeshASceneAndSeveralFilesHold) {
  const auto info = [&](const std::string& files) {
    return Json::parse(run("farcell-info", "--json " + files).out, nullptr, false);
  };
  EXPECT_EQ(info("a.off"), Json::parse(R"({"format":"OFF","files":1,"input":{"triangles":1,"vertices":3,"skipped":{}},
    "declaredTriangles":1,"bounds":{"min":[0,0,0],"max":[1,1,0]},"up":"z","metresPerUnit":1,"hasColours":false,
    "hasNormals":false,"textures":0})"));
  EXPECT_EQ(info("scene.json"), Json::parse(R"({"format":"scene","files":3,
    "input":{"triangles":3,"vertices":9,"skipped":{"zeroArea":2}},
    "declaredTriangles":5,"bounds":{"min":[0,0,0],"max":[1,1,5]},"up":"x","metresPerUnit":0.01,"hasColours":false,
    "hasNormals":false,"textures":0})"));
  EXPECT_EQ(info("b.obj a.off")["format"], "several files");
}

TEST_F(BuildProgram, SaysWhichFileIsWrongAndLeavesNoPack) {
  directory_.write("bad.json", R"({"files":[{"path":"a.off","scale":0}]})");
  const Outcome failed = run("farcell-build", "bad.json -o x.far --quiet");
  EXPECT_EQ(failed.code, 1);
  EXPECT_NE(failed.err.find("bad.json: files[0].scale: expected"), std::string::npos) << failed.err;
  EXPECT_FALSE(std::filesystem::exists(directory_.path() / "x.far"));
  EXPECT_EQ(run("farcell-build", "a.off missing.stl -o x.far").code, 1);
  EXPECT_EQ(run("farcell-build", "a.off -o x.far --up w").code, 2);
  EXPECT_EQ(run("farcell-build", "a.off -o x.far --unit parsec").code, 2);
  EXPECT_EQ(run("farcell-build", "-o x.far").code, 2);
  EXPECT_EQ(run("farcell-build", "a.off -o x.far --lighting none").code, 2);
  EXPECT_EQ(run("farcell-build", "a.off -o x.far --sun 0,91").code, 2);
}

}  // namespace
}  // namespace farcell::test
