#include "runtime/camera/camera.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <numbers>

#include "runtime/camera/overview.h"

namespace farcell {
namespace {

std::string with(const std::string& member, const std::string& value) {
  const std::array<std::pair<std::string, std::string>, 5> members = {
      {{"name", "\"a\""}, {"position", "[1, 2, 3]"}, {"target", "[4, 5, 6]"}, {"up", "[0, 0, 1]"}, {"fovYDeg", "40"}}};
  std::string json = "{\"cameras\": [{";
  bool first = true;
  for (const auto& [name, standard] : members) {
    const std::string& text = name == member ? value : standard;
    if (text.empty()) continue;
    json += (first ? "" : ", ") + ("\"" + name + "\": " + text);
    first = false;
  }
  return json + "}]}";
}

std::string messageOf(const std::string& json) {
  const auto result = parseCameras(json, "cams.json");
  return result ? "accepted" : result.error().message;
}

TEST(Cameras, aFullFileIsRead) {
  const auto cameras = parseCameras(
      R"({"cameras":[{"name":"a","position":[1e6,2.5,-3],"target":[4,5,6],"up":[0,0,1],"fovYDeg":40},
                     {"name":"b","position":[0,0,0],"target":[0,0,1],"up":[0,1,0],"fovYDeg":179.5}]})",
      "cams.json");
  ASSERT_TRUE(cameras) << cameras.error().message;
  ASSERT_EQ(cameras->size(), 2u);
  EXPECT_EQ((*cameras)[0].name, "a");
  EXPECT_EQ((*cameras)[0].position, glm::dvec3(1e6, 2.5, -3));
  EXPECT_EQ((*cameras)[0].target, glm::dvec3(4, 5, 6));
  EXPECT_EQ((*cameras)[0].up, glm::dvec3(0, 0, 1));
  EXPECT_DOUBLE_EQ((*cameras)[0].fovYRad, 40 * std::numbers::pi / 180);
  EXPECT_EQ((*cameras)[1].name, "b");
}

TEST(Cameras, messagesNameFileCameraAndMember) {
  EXPECT_EQ(messageOf(with("up", "")), "cams.json: camera 'a': member 'up' is missing");
  EXPECT_EQ(messageOf(with("name", "7")), "cams.json: camera 0: name: expected a string that is not empty");
  EXPECT_EQ(messageOf(with("position", "[1, 2]")),
            "cams.json: camera 'a': position: expected three numbers, found 2 elements");
  EXPECT_EQ(messageOf(with("target", "[1, 2, \"3\"]")),
            "cams.json: camera 'a': target[2]: expected a number, found string");
  EXPECT_EQ(messageOf(with("target", "[1, 2, 3]")),
            "cams.json: camera 'a': target: expected a point other than position");
  EXPECT_EQ(messageOf(with("up", "[0, 0, 0]")), "cams.json: camera 'a': up: expected a vector that is not zero");
  EXPECT_EQ(messageOf(with("fovYDeg", "180")),
            "cams.json: camera 'a': fovYDeg: expected more than 0 and less than 180, found 180");
}

TEST(Cameras, hostileTextIsAnError) {
  for (const std::string& json :
       {std::string(), std::string("null"), std::string("[]"), std::string("{\"cameras\": 3}"),
        std::string("{\"cameras\": []}"), std::string("{\"cameras\": [3]}"), std::string("{\"cameras\": [{}]}"),
        std::string("{\"cameras\""), with("fovYDeg", "0"), with("fovYDeg", "-1"), with("fovYDeg", "null"),
        with("fovYDeg", "NaN"), with("position", "[1, 2, 1e999]"), with("position", "{}"), with("name", "\"\""),
        with("name", "\"\xff\""), std::string(100000, '['), "{\"cameras\": " + std::string(100000, '{')}) {
    const auto result = parseCameras(json, "cams.json");
    ASSERT_FALSE(result) << json.substr(0, 80);
    EXPECT_EQ(result.error().kind, ErrorKind::invalidArgument);
    EXPECT_EQ(result.error().message.rfind("cams.json: ", 0), 0u) << result.error().message;
  }
  std::string twice = with("", "");
  twice.insert(twice.find(']', twice.size() - 3), ", " + twice.substr(13, twice.size() - 15));
  EXPECT_EQ(messageOf(twice), "cams.json: camera 'a': the name is used twice");
}

TEST(Cameras, anyTruncationIsAnErrorAndNeverACrash) {
  const std::string whole = with("", "");
  ASSERT_EQ(messageOf(whole), "accepted");
  for (size_t length = 0; length < whole.size(); ++length) EXPECT_NE(messageOf(whole.substr(0, length)), "accepted");
}

TEST(Cameras, moreThanAMebibyteIsRefused) {
  const auto result = parseCameras(with("", "") + std::string(1 << 20, ' '), "cams.json");
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, ErrorKind::exhausted);
}

void expectOrthonormal(const Camera& camera) {
  const CameraAxes axes = cameraAxes(camera);
  EXPECT_NEAR(glm::length(axes.right), 1, 1e-12);
  EXPECT_NEAR(glm::length(axes.up), 1, 1e-12);
  EXPECT_NEAR(glm::length(axes.back), 1, 1e-12);
  EXPECT_NEAR(glm::dot(axes.right, axes.up), 0, 1e-12);
  EXPECT_NEAR(glm::length(glm::cross(axes.right, axes.up) - axes.back), 0, 1e-12);
}

TEST(Cameras, axesAreRightUpAndBack) {
  const CameraAxes axes = cameraAxes({"a", {0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 1});
  EXPECT_EQ(axes.right, glm::dvec3(1, 0, 0));
  EXPECT_EQ(axes.up, glm::dvec3(0, 1, 0));
  EXPECT_EQ(axes.back, glm::dvec3(0, 0, 1));
}

TEST(Cameras, axesExistForAnyUpScaleAndDistance) {
  for (const glm::dvec3 target : {glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1), glm::dvec3(1, 2, 3),
                                  glm::dvec3(1e-300, 0, 0), glm::dvec3(1e308, -1e308, 0)})
    for (const glm::dvec3 up : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1), glm::dvec3(1e-200, 0, 0),
                                glm::dvec3(0, 0, -1e200), target})
      expectOrthonormal({"a", {0, 0, 0}, target, up, 1});
  expectOrthonormal({"a", {-1e308, 0, 0}, {1e308, 0, 0}, {0, 0, 1}, 1});
}

TEST(Cameras, anOverviewSeesEveryCornerOfTheBox) {
  for (const double aspect : {0.5, 1.0, 1.8})
    for (const double scale : {1e-6, 1.0, 1e6}) {
      const glm::dvec3 min = glm::dvec3(5, -3, 1) * scale, max = glm::dvec3(21, 1, 1.5) * scale;
      const Camera camera = overviewCamera(min, max, {0, 0, 1}, aspect);
      const CameraAxes axes = cameraAxes(camera);
      const double tanY = std::tan(camera.fovYRad / 2);
      for (int i = 0; i < 8; ++i) {
        const glm::dvec3 corner(i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z);
        const glm::dvec3 v = corner - camera.position;
        const double depth = -glm::dot(v, axes.back);
        EXPECT_GT(depth, 0);
        EXPECT_LE(std::abs(glm::dot(v, axes.up)), depth * tanY);
        EXPECT_LE(std::abs(glm::dot(v, axes.right)), depth * tanY * aspect);
      }
      EXPECT_GT(camera.position.z, max.z);
    }
}

}  // namespace
}  // namespace farcell
