#include <random>

#include "cache/base/process.h"
#include "tests/preprocess/read/read_support.h"

namespace farcell::test {
namespace {

const std::string kWhole =
    R"({"up":"y","unit":"cm","files":[{"path":"t.obj","translation":[1,2,3],"rotation":[0,0,0,1],"scale":2},)"
    R"({"path":"t.obj","rotation":{"axis":[0,0,1],"angleDeg":45},"instances":[{"scale":[1,2,3]},{"translation":[1,0,0]}]}]})";

class HostileScene : public testing::Test {
 protected:
  HostileScene() { directory_.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"); }
  void expectRefusedScene(const BadFile& bad) const { expectRefused(directory_, "bad.json", bad); }

  TempDirectory directory_;
};

// A scene of one file with these members besides its path.
BadFile badMember(const std::string& members, const std::string& says) {
  return {R"({"files":[{"path":"t.obj",)" + members + "}]}", "bad.json: files[0]" + says};
}

TEST_F(HostileScene, RefusesWhatIsNoJson) {
  EXPECT_EQ(readGood(directory_.write("scene.json", kWhole)).triangles.size(), 3u);
  for (const BadFile& bad :
       std::vector<BadFile>{{"", "bad.json: offset 0: expected JSON, found"},
                            {"{", "bad.json: offset 1: expected JSON, found"},
                            {"solid nothing", "bad.json: offset 0: expected JSON"},
                            {kWhole + "x", fmt::format("bad.json: offset {}: expected JSON", kWhole.size())},
                            {kWhole + kWhole, "expected JSON"},
                            {R"({"files":[{"path":"t.obj","scale":NaN}]})", "bad.json: offset 34: expected JSON"},
                            {R"({"files":[{"path":"t.obj","scale":1e999}]})", "expected JSON"},
                            {R"({"files":[{"path":"t.obj",}]})", "expected JSON"},
                            {R"({'files':[]})", "bad.json: offset 1: expected JSON"},
                            {"{\"files\":[{\"path\":\"\xff\xfe\"}]}", "expected JSON"},
                            {"// a comment\n" + kWhole, "bad.json: offset 0: expected JSON"}})
    expectRefusedScene(bad);
}

TEST_F(HostileScene, RefusesWhatIsNoSceneAndSaysWhere) {
  for (const BadFile& bad : std::vector<BadFile>{
           {"[]", "bad.json: scene: expected an object, found an array of 0 elements"},
           {"null", "scene: expected an object, found null"},
           {"{}", "scene: expected a member files, found an object of 0 members"},
           {R"({"files":{}})",
            "bad.json: files: expected an array of at least one object, found an object of 0 members"},
           {R"({"files":[]})", "files: expected an array of at least one object, found an array of 0 elements"},
           {R"({"files":["t.obj"]})", R"(files[0]: expected an object, found "t.obj")"},
           {R"({"files":[{}]})", "files[0]: expected a member path, found an object of 0 members"},
           {R"({"files":[{"path":7}]})", "files[0].path: expected a string that is not empty, found 7"},
           {R"({"files":[{"path":""}]})", R"(files[0].path: expected a string that is not empty, found "")"},
           {R"({"files":[{"path":"t.obj\u0000.ply"}]})", R"(files[0].path: expected a string that is not empty)"},
           {R"({"files":[{"path":"t.obj"}],"units":"m"})",
            R"(scene: expected no members but up, unit, files, found "units")"},
           {R"({"files":[{"path":"t.obj"}],"\u001b[31m":1})", R"(found "\u001b[31m")"},
           {R"({"files":[{"path":"t.obj"}],"up":"w"})", R"(up: expected x, y or z, found "w")"},
           {R"({"files":[{"path":"t.obj"}],"up":1})", "up: expected a string that is not empty, found 1"},
           {R"({"files":[{"path":"t.obj"}],"unit":"parsec"})",
            R"(unit: expected mm, cm, m, km, in, ft or a positive number of metres, found "parsec")"},
           {R"({"files":[{"path":"t.obj"}],"unit":0})", "unit: expected mm, cm, m, km, in, ft or a positive number"},
           {R"({"files":[{"path":"t.obj"}],"unit":-1})", "found -1"},
           {R"({"files":[{"path":"t.obj"}],"unit":[]})", "unit: expected"},
           {R"({"files":[{"path":"t.obj"}],"files":[{"path":"t.obj"}]})",
            R"(expected each member of an object once, found "files" twice)"},
           {R"({"files":[{"path":"t.obj","scale":1,"scale":2}]})", R"(found "scale" twice)"}})
    expectRefusedScene(bad);
}

TEST_F(HostileScene, RefusesPlacesThatAreNone) {
  const std::string factor = "expected a factor of 1e-12 to 1000000000000 in magnitude, found ";
  for (const BadFile& bad : std::vector<BadFile>{
           badMember(R"("Scale":1)",
                     R"(: expected no members but path, translation, rotation, scale, instances, found "Scale")"),
           badMember(R"("scale":0)", ".scale: " + factor + "0"),
           badMember(R"("scale":-0.0)", ".scale: " + factor + "-0.0"),
           badMember(R"("scale":1e-13)", ".scale: " + factor + "1e-13"),
           badMember(R"("scale":-2e12)", ".scale: " + factor + "-2000000000000.0"),
           badMember(R"("scale":[1,0,1])", ".scale[1]: " + factor + "0"),
           badMember(R"("scale":[1,1])", ".scale: expected an array of 3 numbers, found an array of 2 elements"),
           badMember(R"("scale":null)", ".scale: expected a finite number, found null"),
           badMember(R"("scale":"2")", R"(.scale: expected a finite number, found "2")"),
           badMember(R"("translation":5)", ".translation: expected an array of 3 numbers, found 5"),
           badMember(R"("translation":[1,2])",
                     ".translation: expected an array of 3 numbers, found an array of 2 elements"),
           badMember(R"("translation":[1,2,"3"])", R"(.translation[2]: expected a finite number, found "3")"),
           badMember(R"("translation":[1,[2],3])", ".translation[1]: expected a finite number, found an array of 1"),
           badMember(R"("rotation":45)",
                     ".rotation: expected four numbers (a quaternion) or an object of axis and angleDeg, found 45"),
           badMember(R"("rotation":[0,0,1])",
                     ".rotation: expected an array of 4 numbers, found an array of 3 elements"),
           badMember(R"("rotation":[0,0,0,0])",
                     ".rotation: expected a quaternion that is not zero, found [0, 0, 0, 0]"),
           badMember(R"("rotation":[0,0,0,true])", ".rotation[3]: expected a finite number, found true"),
           badMember(R"("rotation":{"axis":[0,0,1]})", ".rotation: expected four numbers"),
           badMember(R"("rotation":{"axis":[0,0,0],"angleDeg":1})",
                     ".rotation.axis: expected a vector that is not zero"),
           badMember(R"("rotation":{"axis":[0,0,1],"angleDeg":"1"})", ".rotation.angleDeg: expected a finite number"),
           badMember(R"("rotation":{"axis":[0,0,1],"angleDeg":1,"angle":1})",
                     R"(.rotation: expected no members but axis, angleDeg, found "angle")"),
           badMember(R"("instances":[])", ".instances: expected an array of at least one object"),
           badMember(R"("instances":3)", ".instances: expected an array of at least one object, found 3"),
           badMember(R"("instances":[{},[]])", ".instances[1]: expected an object, found an array of 0 elements"),
           badMember(R"("instances":[{"path":"t.obj"}])",
                     R"(.instances[0]: expected no members but translation, rotation, scale, found "path")"),
           badMember(R"("instances":[{"scale":0}])", ".instances[0].scale: " + factor + "0"),
           badMember(R"("instances":[{"instances":[]}])", ".instances[0]: expected no members but")})
    expectRefusedScene(bad);
}

TEST_F(HostileScene, RefusesFilesThatCannotBeReadByTheirOwnName) {
  directory_.write("inner.json", kWhole);
  directory_.write("bad.obj", "v 0 0\n");
  for (const auto& [name, kind] : {std::pair{"missing.ply", ErrorKind::notFound},
                                   {"inner.json", ErrorKind::unsupported},
                                   {"bad.json", ErrorKind::unsupported},  // itself
                                   {"bad.obj", ErrorKind::corrupt},
                                   {".", ErrorKind::io},
                                   {"t.txt", ErrorKind::notFound}}) {
    const auto result = readMesh(
        directory_.write("bad.json", fmt::format(R"({{"files":[{{"path":"t.obj"}},{{"path":"{}"}}]}})", name)));
    ASSERT_FALSE(result) << name;
    EXPECT_EQ(result.error().kind, kind) << result.error().message;
    EXPECT_NE(result.error().message.find((directory_.path() / name).string()), std::string::npos)
        << result.error().message;
  }
}

std::string repeated(const std::string& item, size_t count) {
  std::string text;
  for (size_t i = 0; i < count; ++i) text += (i > 0 ? "," : "") + item;
  return text;
}

TEST_F(HostileScene, BoundsFilesInstancesNestingAndSize) {
  const ErrorKind exhausted = ErrorKind::exhausted;
  expectRefusedScene({R"({"files":[)" + repeated(R"({"path":"t.obj"})", 1001) + "]}",
                      "files: expected at most 1000 elements, found 1001", exhausted});
  expectRefusedScene({R"({"files":[{"path":"t.obj","instances":[{}]},{"path":"t.obj","instances":[)" +
                          repeated("{}", 1'000'000) + "]}]}",
                      "files[1].instances: expected at most 999999 elements, found 1000000", exhausted});
  const std::string deep(4'000'000, '[');
  expectRefusedScene({deep, "expected at most 8 levels of nesting"});
  expectRefusedScene(
      {R"({"files":)" + deep + std::string(deep.size(), ']') + "}", "expected at most 8 levels of nesting"});
  std::string objects;
  for (int i = 0; i < 1'000'000; ++i) objects += R"({"a":)";
  expectRefusedScene({objects + "1" + std::string(1'000'000, '}'), "expected at most 8 levels of nesting"});
  expectRefusedScene({kWhole + std::string(size_t{17} << 20, ' '), "expected at most 16777216 bytes", exhausted});
}

TEST_F(HostileScene, IsAnErrorAtEveryTruncation) {
  for (size_t length = 0; length < kWhole.size(); ++length) expectRefusedScene({kWhole.substr(0, length), ""});
}

TEST_F(HostileScene, SurvivesAnyChangedBytes) {
  constexpr uint32_t kSeed = 2010;
  SCOPED_TRACE(fmt::format("seed {}", kSeed));
  std::mt19937 random(kSeed);
  int readable = 0;
  for (int round = 0; round < 3000; ++round) {
    std::string bytes = kWhole;
    for (uint32_t i = 0; i <= random() % 2; ++i) bytes[random() % bytes.size()] = static_cast<char>(32 + random() % 96);
    readable += readMesh(directory_.write("changed.json", bytes)).has_value();
  }
  EXPECT_GT(readable, 10);
}

}  // namespace
}  // namespace farcell::test
