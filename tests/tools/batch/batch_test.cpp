// farcell-batch as a person or a script runs it, beside the real farcell-build or one that the test makes.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <csignal>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <regex>
#include <thread>

#include "cache/base/file.h"
#include "tests/preprocess/read/read_support.h"
#include "tools/batch/plan/build_record.h"

namespace farcell::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

struct Outcome {
  int code = -1;
  std::string out;
  std::string err;
};

class BatchTest : public testing::Test {
 protected:
  BatchTest() {
    fs::create_directory(directory_.path() / "bin");
    fs::copy_file(fs::path(FARCELL_PROGRAMS_DIR) / "farcell-batch", program());
    directory_.write("a.off", kTriangle);
    directory_.write("b.off", kTriangle);
    for (const char* name : {"a.off", "b.off"}) past(name);
  }

  fs::path program() const { return directory_.path() / "bin" / "farcell-batch"; }
  fs::path packs() const { return directory_.path() / "packs"; }

  // As a model has stood for a while.
  void past(const std::string& name) const {
    const fs::path path = directory_.path() / name;
    fs::last_write_time(path, fs::last_write_time(path) - std::chrono::seconds(10));
  }
  void realBuild() const {
    fs::create_symlink(fs::path(FARCELL_PROGRAMS_DIR) / "farcell-build", directory_.path() / "bin" / "farcell-build");
  }
  // A build that keeps its arguments, "dies" where the mesh is named so, "waits" likewise, and else writes a pack.
  void madeUpBuild() const {
    const fs::path path = directory_.path() / "bin" / "farcell-build";
    std::ofstream(path) << R"(#!/bin/sh
for a; do case $a in --output=*) pack=${a#--output=};; esac; mesh=$a; done
echo "$@" >>calls
echo '{"event":"begin","stage":"bake"}' >&2
case $mesh in
  dies*) kill -SEGV $$ ;;
  fails*) echo "farcell-build: no such luck" >&2; exit 1 ;;
  lies*) echo "done"; exit 0 ;;
  waits*) trap 'echo told >>calls; exit 1' INT; touch waiting; while :; do sleep 0.05; done ;;
esac
echo pack >"$pack"
echo '{"input":{"triangles":5},"bytes":{"pack":5},"files":["'"$mesh"'"]}'
)";
    fs::permissions(path, fs::perms::owner_all);
  }
  // Data sets by name, each of one mesh file.
  void list(const std::vector<std::pair<std::string, std::string>>& sets, const std::string& options = "{}") const {
    Json json;
    for (const auto& [name, mesh] : sets)
      json["datasets"].push_back({{"name", name}, {"meshes", Json::array({mesh})}, {"options", Json::parse(options)}});
    directory_.write("list.json", json.dump());
  }

  std::string text(const char* name) const { return readTextFile(directory_.path() / name, 1 << 20).value_or(""); }
  std::string commandOf(const std::string& arguments) const {
    return fmt::format("'{}' '{}/list.json' -o '{}' {} >'{}/out' 2>'{}/err'", program().string(),
                       directory_.path().string(), packs().string(), arguments, directory_.path().string(),
                       directory_.path().string());
  }
  Outcome run(const std::string& arguments = "") const {
    const int status = std::system(commandOf(arguments).c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text("out"), text("err")};
  }
  size_t calls() const {
    const std::string made = text("calls");
    return static_cast<size_t>(std::count(made.begin(), made.end(), '\n'));
  }
  // "ok", "failed", ... of each, in order.
  static std::vector<std::string> outcomes(const std::string& out) {
    std::vector<std::string> list;
    const Json report = Json::parse(out);
    for (const Json& set : report.at("datasets")) list.push_back(set.at("outcome"));
    return list;
  }

  static constexpr const char* kTriangle = "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  TempDirectory directory_;
};

using Strings = std::vector<std::string>;

TEST_F(BatchTest, BuildsPacksAndThenFindsThemCurrentUntilAFileOrAnOptionChanges) {
  realBuild();
  list({{"a", "a.off"}, {"b", "b.off"}}, R"({"views":12,"image-size":16})");
  const Outcome first = run("--json");
  ASSERT_EQ(first.code, 0) << first.err << first.out;
  EXPECT_EQ(outcomes(first.out), (Strings{"ok", "ok"}));
  const Json set = Json::parse(first.out)["datasets"][0];
  EXPECT_EQ(set["triangles"], 1);
  EXPECT_EQ(set["packBytes"], fs::file_size(packs() / "a.far"));
  EXPECT_GT(set["peakRssBytes"], 1'000'000);
  EXPECT_EQ(outcomes(run("--json").out), (Strings{"skipped as current", "skipped as current"}));
  directory_.write("b.off", fmt::format("{}\n", kTriangle));
  past("b.off");
  EXPECT_EQ(outcomes(run("--json").out), (Strings{"skipped as current", "ok"}));
  fs::remove(packs() / "a.far");
  EXPECT_EQ(outcomes(run("--json").out), (Strings{"ok", "skipped as current"}));
  list({{"a", "a.off"}, {"b", "b.off"}}, R"({"views":20,"image-size":16})");
  EXPECT_EQ(outcomes(run("--json").out), (Strings{"ok", "ok"}));
}

TEST_F(BatchTest, GoesOnAfterAFailureAndTellsEach) {
  realBuild();
  list({{"a", "a.off"}, {"none", "missing.off"}, {"b", "b.off"}}, R"({"views":12,"image-size":16})");
  const Outcome outcome = run();
  EXPECT_EQ(outcome.code, 1);
  const std::regex lines(
      "a +ok, 1 triangles, pack [^\n]*, memory [^\n]*\nnone +failed[^\n]*missing.off[^\n]*\nb +ok, [^\n]*\n");
  EXPECT_TRUE(std::regex_match(outcome.out, lines)) << outcome.out;
  EXPECT_NE(outcome.err.find("1 of 3 data sets failed"), std::string::npos) << outcome.err;
  EXPECT_TRUE(fs::exists(packs() / "b.far"));
  EXPECT_FALSE(fs::exists(packs() / "none.json"));
}

TEST_F(BatchTest, ACrashIsAFailedLineThatSaysWhere) {
  madeUpBuild();
  list({{"a", "a.off"}, {"dead", "dies.off"}, {"odd", "lies.off"}, {"bad", "fails.off"}, {"b", "b.off"}});
  const Outcome outcome = run("--json --jobs 2");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcomes(outcome.out), (Strings{"ok", "failed", "failed", "failed", "ok"}));
  const Json sets = Json::parse(outcome.out)["datasets"];
  EXPECT_EQ(sets[1]["message"], "killed by signal 11 (Segmentation fault) in stage bake");
  EXPECT_EQ(sets[3]["message"], "farcell-build: no such luck");
  EXPECT_EQ(outcomes(run("--json").out),
            (Strings{"skipped as current", "failed", "failed", "failed", "skipped as current"}));
}

TEST_F(BatchTest, StopsAtAFailureWhenAskedTo) {
  madeUpBuild();
  list({{"a", "a.off"}, {"bad", "fails.off"}, {"b", "b.off"}});
  const Outcome outcome = run("--json --stop-on-failure");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcomes(outcome.out), (Strings{"ok", "failed", "not run"}));
}

TEST_F(BatchTest, DoubtMeansToBuildAgain) {
  madeUpBuild();
  list({{"a", "a.off"}});
  run();
  ASSERT_EQ(calls(), 1u);
  directory_.write("packs/a.json", "{\"version\":");
  run();
  EXPECT_EQ(calls(), 2u);
  // Written while it was read, or later.
  fs::last_write_time(directory_.path() / "a.off", fs::file_time_type::clock::now() + std::chrono::hours(1));
  run();
  run();
  EXPECT_EQ(calls(), 4u);
  past("a.off");
}

TEST_F(BatchTest, CtrlCIsPassedOnOnceAndNothingElseBegins) {
  madeUpBuild();
  list({{"a", "a.off"}, {"slow", "waits.off"}, {"b", "b.off"}});
  const std::string command = fmt::format("exec {}", commandOf("--json"));
  const pid_t batch = ::fork();
  if (batch == 0) {
    ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    ::_exit(127);
  }
  for (int i = 0; i < 3'000 && !fs::exists(directory_.path() / "waiting"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ASSERT_TRUE(fs::exists(directory_.path() / "waiting"));
  ::kill(batch, SIGINT);
  int status = 0;
  ASSERT_EQ(::waitpid(batch, &status, 0), batch);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 1) << status;
  EXPECT_EQ(outcomes(text("out")), (Strings{"ok", "not run", "not run"}));
  EXPECT_NE(text("err").find("interrupted"), std::string::npos);
  EXPECT_NE(text("calls").find("told\n"), std::string::npos);
  // Later it goes on.
  list({{"a", "a.off"}, {"slow", "b.off"}, {"b", "b.off"}});
  EXPECT_EQ(outcomes(run("--json").out), (Strings{"skipped as current", "ok", "ok"}));
}

TEST_F(BatchTest, AListThatIsWrongBuildsNothing) {
  madeUpBuild();
  directory_.write("list.json", R"({"datasets":[{"name":"a","meshes":["a.off"]},{"name":"../b","meshes":["b.off"]}]})");
  const Outcome outcome = run();
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("list.datasets[1].name"), std::string::npos) << outcome.err;
  EXPECT_EQ(calls(), 0u);
  EXPECT_FALSE(fs::exists(packs()));
}

}  // namespace
}  // namespace farcell::test
