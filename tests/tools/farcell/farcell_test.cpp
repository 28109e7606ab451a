#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace farcell {
namespace {

namespace fs = std::filesystem;

struct Outcome {
  int code = -1;
  std::string out;
  std::string err;
};

std::string readAll(const fs::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

// The status of the program as a shell runs it, arguments as written there.
int shell(const fs::path& program, const std::string& arguments, const fs::path& out, const fs::path& err) {
  std::ostringstream command;
  command << program << ' ' << arguments << " >" << out << " 2>" << err;
  return std::system(command.str().c_str());
}

// The program under test lies in a directory of its own, beside verbs that the test makes.
class FarcellTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "farcell-verb-test.XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    directory_ = name;
    fs::create_directory(directory_ / "bin dir");
    fs::copy_file(fs::path(FARCELL_PROGRAMS_DIR) / "farcell", program());
  }
  void TearDown() override { fs::remove_all(directory_); }

  fs::path program() const { return directory_ / "bin dir" / "farcell"; }

  void makeVerb(const std::string& verb, const std::string& script) const {
    const fs::path path = directory_ / "bin dir" / ("farcell-" + verb);
    std::ofstream(path) << "#!/bin/sh\n" << script << "\n";
    fs::permissions(path, fs::perms::owner_all);
  }

  Outcome run(const std::string& arguments) const {
    const fs::path out = directory_ / "out", err = directory_ / "err";
    const int status = shell(program(), arguments, out, err);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, readAll(out), readAll(err)};
  }

  fs::path directory_;
};

TEST_F(FarcellTest, HelpListsEveryVerbOnStdoutAndSucceeds) {
  for (const char* spelling : {"--help", "-h", "help"}) {
    const Outcome outcome = run(spelling);
    EXPECT_EQ(outcome.code, 0) << spelling;
    EXPECT_EQ(outcome.err, "");
    for (const char* verb :
         {"generate", "build", "batch", "repack", "info", "verify", "render", "view", "extract", "evaluate"})
      EXPECT_NE(outcome.out.find(std::string("  ") + verb + " "), std::string::npos) << verb;
  }
}

TEST_F(FarcellTest, VersionIsOnStdout) {
  const Outcome outcome = run("--version");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out, "farcell " FARCELL_VERSION "\n");
}

TEST_F(FarcellTest, AnUnknownVerbOrNoneIsMisuseAndStdoutStaysEmpty) {
  for (const char* arguments : {"", "''", "bake", "Build", "buil", "--verbose", "../bin", "build/x"}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_NE(outcome.err.find("usage:"), std::string::npos) << arguments;
  }
  EXPECT_NE(run("bake").err.find("unknown verb 'bake'"), std::string::npos);
}

TEST_F(FarcellTest, AVerbRunsBesideTheProgramWithItsArgumentsAsGivenAndItsExitCode) {
  makeVerb("build", "for a in \"$@\"; do echo \"[$a]\"; done; exit 7");
  const Outcome outcome = run("build 'a b.ply' -o '' --help '*'");
  EXPECT_EQ(outcome.code, 7);
  EXPECT_EQ(outcome.out, "[a b.ply]\n[-o]\n[]\n[--help]\n[*]\n");
}

TEST_F(FarcellTest, HelpOfAVerbIsTheVerbsOwn) {
  makeVerb("build", "echo \"$@\"");
  EXPECT_EQ(run("help build").out, "--help\n");
  EXPECT_EQ(run("--help build").out, "--help\n");
  EXPECT_EQ(run("help bake").code, 0);  // of farcell: there is no such verb
}

TEST_F(FarcellTest, AVerbThatIsNotInstalledIsAFailureThatNamesTheProgramMissing) {
  const Outcome outcome = run("render");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find((directory_ / "bin dir" / "farcell-render").string()), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("No such file"), std::string::npos) << outcome.err;
}

TEST_F(FarcellTest, CalledThroughALinkItStillFindsItsVerbs) {
  makeVerb("info", "echo found");
  fs::create_symlink(program(), directory_ / "link");
  EXPECT_EQ(shell(directory_ / "link", "info", directory_ / "out", directory_ / "err"), 0);
  EXPECT_EQ(readAll(directory_ / "out"), "found\n");
}

}  // namespace
}  // namespace farcell
