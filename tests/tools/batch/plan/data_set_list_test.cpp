#include "tools/batch/plan/data_set_list.h"

#include <gtest/gtest.h>

namespace farcell {
namespace {

using Strings = std::vector<std::string>;

std::string messageOf(const std::string& text) {
  const auto sets = parseDataSets(text, "list.json");
  return sets ? "" : sets.error().message;
}
// Of a list of one data set.
std::string messageOfSet(const std::string& set) { return messageOf(fmt::format(R"({{"datasets":[{}]}})", set)); }

TEST(DataSetList, SaysWhatToBuildFromWhatAndHow) {
  const auto sets = parseDataSets(R"({"datasets":[
    {"name":"city","meshes":["a.ply","../b c.obj"],"output":"big.far",
     "options":{"views":42,"unit":"m","lighting":"relightable","quick":false,"samples":4,"scale":0.5}},
    {"name":"statue-2_x.y","meshes":["-s.ply"]}]})",
                                  "list.json");
  ASSERT_TRUE(sets) << sets.error().message;
  ASSERT_EQ(sets->size(), 2u);
  EXPECT_EQ((*sets)[0].name, "city");
  EXPECT_EQ((*sets)[0].meshes, (Strings{"a.ply", "../b c.obj"}));
  EXPECT_EQ((*sets)[0].output, "big.far");
  EXPECT_EQ((*sets)[0].options,
            (Strings{"--lighting=relightable", "--samples=4", "--scale=0.5", "--unit=m", "--views=42"}));
  EXPECT_EQ((*sets)[1].output, "statue-2_x.y.far");
  EXPECT_TRUE((*sets)[1].options.empty());
}

TEST(DataSetList, NamesStayInTheDirectory) {
  for (const char* name :
       {"", ".", "..", "../x", "a/b", "/etc/x", ".hidden", "-o", "a b", "a\\\\b", "a\\u0000b", "\\u00e9"})
    EXPECT_NE(
        messageOfSet(fmt::format(R"({{"name":"{}","meshes":["m"]}})", name)).find("list.datasets[0].name: expected"),
        std::string::npos)
        << name;
  for (const char* output : {"../x.far", "/tmp/x.far", "x/y.far", ".far", "x.json", "x", "-x.far"})
    EXPECT_NE(messageOfSet(fmt::format(R"({{"name":"n","meshes":["m"],"output":"{}"}})", output))
                  .find("list.datasets[0].output: expected"),
              std::string::npos)
        << output;
  EXPECT_NE(messageOfSet(fmt::format(R"({{"name":"{}","meshes":["m"]}})", std::string(201, 'a'))), "");
  EXPECT_EQ(messageOfSet(fmt::format(R"({{"name":"{}","meshes":["m"]}})", std::string(200, 'a'))), "");
}

TEST(DataSetList, NothingComesTwice) {
  const auto two = [](const char* a, const char* b) {
    return messageOf(fmt::format(R"({{"datasets":[{{"name":"a","meshes":["m"]{}}},{{"name":"{}","meshes":["m"]{}}}]}})",
                                 a, *b == ',' ? "b" : b, *b == ',' ? b : ""));
  };
  EXPECT_EQ(two("", "b"), "");
  EXPECT_NE(two("", "a").find("list.datasets[1]: expected a name of no other"), std::string::npos);
  EXPECT_NE(two("", "A").find("list.datasets[1]: expected a name of no other"), std::string::npos);
  EXPECT_NE(two("", R"(,"output":"a.far")").find("list.datasets[1]: expected an output"), std::string::npos);
  EXPECT_NE(messageOfSet(R"({"name":"a","name":"b","meshes":["m"]})").find("found \"name\" twice"), std::string::npos);
}

TEST(DataSetList, WhatIsNotKnownIsAnErrorWithItsPlace) {
  EXPECT_NE(messageOf("[]").find("list.json: list: expected an object"), std::string::npos);
  EXPECT_NE(messageOf("{}").find("'datasets'"), std::string::npos);
  EXPECT_NE(messageOf(R"({"datasets":[]})").find("datasets: expected"), std::string::npos);
  EXPECT_NE(messageOf(R"({"datasets":[{}],"x":1})").find("\"x\""), std::string::npos);
  EXPECT_NE(messageOf(R"({"datasets":[{"name":"a","meshes":["m"]})").find("offset"), std::string::npos);
  EXPECT_NE(messageOfSet("7").find("datasets[0]: expected"), std::string::npos);
  EXPECT_NE(messageOfSet(R"({"meshes":["m"]})").find("'name'"), std::string::npos);
  EXPECT_NE(messageOfSet(R"({"name":"a"})").find("'meshes'"), std::string::npos);
  EXPECT_NE(messageOfSet(R"({"name":"a","meshes":[]})").find("meshes: expected"), std::string::npos);
  EXPECT_NE(messageOfSet(R"({"name":"a","meshes":["m",1]})").find("meshes[1]: expected"), std::string::npos);
  EXPECT_NE(messageOfSet(R"({"name":"a","meshes":["m"],"colour":1})").find("\"colour\""), std::string::npos);
}

TEST(DataSetList, OptionsAreThoseThatSayHowToBuild) {
  const auto of = [](const std::string& options) {
    return messageOfSet(fmt::format(R"({{"name":"a","meshes":["m"],"options":{}}})", options));
  };
  EXPECT_EQ(of(R"({"work-dir":"/big"})"), "");
  for (const char* name :
       {"output", "json", "progress", "quiet", "help", "version", "print-reference", "o=x", "-o", "Views", "", "a b"})
    EXPECT_NE(of(fmt::format(R"({{"{}":"x"}})", name)).find("options: expected"), std::string::npos) << name;
  EXPECT_NE(of(R"({"views":[42]})").find("options.views: expected"), std::string::npos);
  EXPECT_NE(of(R"({"views":null})").find("options.views: expected"), std::string::npos);
  EXPECT_NE(of("[]").find("options: expected"), std::string::npos);
}

TEST(DataSetList, DeepDocumentsAreRefused) {
  EXPECT_NE(messageOf(std::string(1'000'000, '[')).find("nesting"), std::string::npos);
}

}  // namespace
}  // namespace farcell
