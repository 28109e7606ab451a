// The program from outside: exit codes, what is on stdout, what is on disk.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "cache/base/file.h"

namespace farcell {
namespace {

struct ProgramRun {
  int exitCode = -1;
  std::string out;
};

ProgramRun generate(const std::string& arguments) {
  const std::string command = std::string(FARCELL_PROGRAMS_DIR) + "/farcell-generate " + arguments + " 2>/dev/null";
  ProgramRun run;
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (!pipe) return run;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) run.out.push_back(static_cast<char>(c));
  const int status = ::pclose(pipe);
  run.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return run;
}

class GenerateTest : public testing::Test {
 protected:
  GenerateTest() {
    std::string name = (std::filesystem::temp_directory_path() / "farcell-generate.XXXXXX").string();
    directory_ = ::mkdtemp(name.data());
  }
  ~GenerateTest() override { std::filesystem::remove_all(directory_); }
  std::filesystem::path directory_;
};

TEST_F(GenerateTest, WritesACityAndTellsItsCounts) {
  const auto path = directory_ / "city.ply";
  const ProgramRun run = generate("city --triangles 20k --seed 5 --json -o " + path.string());
  ASSERT_EQ(run.exitCode, 0);
  const auto report = nlohmann::json::parse(run.out, nullptr, false);
  ASSERT_TRUE(report.is_object()) << run.out;
  EXPECT_EQ(report["bytes"].get<uint64_t>(), std::filesystem::file_size(path));
  EXPECT_GE(report["triangles"].get<uint64_t>(), 19'000u);
  EXPECT_LE(report["triangles"].get<uint64_t>(), 20'000u);
  EXPECT_GE(report["seconds"].get<double>(), 0);
  const auto text = readTextFile(path, uint64_t{1} << 30);
  ASSERT_TRUE(text);
  EXPECT_NE(text->find(fmt::format("element face {}\n", report["triangles"].get<uint64_t>())), std::string::npos);
  EXPECT_NE(text->find(fmt::format("element vertex {}\n", report["vertices"].get<uint64_t>())), std::string::npos);
}

TEST_F(GenerateTest, WritesAStatueOfItsOwnOrFromAMesh) {
  const auto path = directory_ / "statue.ply";
  const ProgramRun own = generate("statue --triangles 30k --json -o " + path.string());
  ASSERT_EQ(own.exitCode, 0);
  const auto report = nlohmann::json::parse(own.out, nullptr, false);
  ASSERT_TRUE(report.is_object()) << own.out;
  EXPECT_EQ(report["bytes"].get<uint64_t>(), std::filesystem::file_size(path));
  EXPECT_NEAR(report["triangles"].get<double>(), 30'000, 1'500);

  const auto mesh = directory_ / "tetrahedron.obj";
  ASSERT_TRUE(writeTextFile(mesh, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"));
  const ProgramRun grown =
      generate("statue --from " + mesh.string() + " --triangles 10k --roughness 0.6 --json -o " + path.string());
  ASSERT_EQ(grown.exitCode, 0);
  const auto counts = nlohmann::json::parse(grown.out, nullptr, false);
  EXPECT_EQ(counts["baseTriangles"].get<int>(), 4);
  EXPECT_NEAR(counts["triangles"].get<double>(), 10'000, 500);
  EXPECT_EQ(counts["vertices"].get<int>(), 2 + counts["triangles"].get<int>() / 2);
}

TEST_F(GenerateTest, TellsMisuseFromFailure) {
  const std::string path = (directory_ / "city.ply").string();
  EXPECT_EQ(generate("").exitCode, 2);
  EXPECT_EQ(generate("village -o " + path).exitCode, 2);
  EXPECT_EQ(generate("city").exitCode, 2);
  EXPECT_EQ(generate("city --triangles many -o " + path).exitCode, 2);
  EXPECT_EQ(generate("city --triangles 10 -o " + path).exitCode, 2);
  EXPECT_EQ(generate("city --triangles 10k -o " + (directory_ / "missing" / "city.ply").string()).exitCode, 1);
  EXPECT_EQ(generate("statue --triangles 10 -o " + path).exitCode, 2);
  EXPECT_EQ(generate("statue --roughness 3 -o " + path).exitCode, 2);
  EXPECT_EQ(generate("statue --triangles 20G -o " + path).exitCode, 1);
  EXPECT_EQ(generate("statue --from missing.obj -o " + path).exitCode, 1);
  EXPECT_EQ(generate("--help").exitCode, 0);
  EXPECT_TRUE(std::filesystem::is_empty(directory_));
}

}  // namespace
}  // namespace farcell
