// What bash, zsh and fish offer, asked of the shells themselves.
#include <set>

#include "tests/package/programs.h"

namespace farcell {
namespace {

namespace fs = std::filesystem;
using Words = std::set<std::string>;

// One of the shells, with the way to ask it.
class CompletionTest : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (printed("command -v " + shell()).code != 0) GTEST_SKIP() << shell() << " is not installed";
    std::string name = (fs::temp_directory_path() / "farcell-completion-test.XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    directory_ = name;
    printed("cd " + name + " && touch 'a city.ply' city.obj && mkdir sub");
  }
  void TearDown() override {
    if (!directory_.empty()) fs::remove_all(directory_);
  }

  std::string shell() const { return GetParam(); }

  // The words offered for the last one of the line, which may be empty: "farcell build ".
  Words offered(const std::string& line) const {
    const bool bash = shell() == "bash";
    std::string scripts = FARCELL_REFERENCE_DIR "/";
    scripts += bash ? "bash-completion/completions" : shell();
    // bash gets the line in words: a quoted empty one where it ends with a space.
    const std::string words = bash ? line + (line.back() == ' ' ? "''" : "") : "'" + line + "'";
    const std::string start = shell() == "fish" ? "fish --no-config" : shell();
    const Printed out = printed("cd " + directory_.string() + " && PATH=" FARCELL_PROGRAMS_DIR ":$PATH " + start +
                                " " FARCELL_SOURCE_DIR "/tests/package/ask." + shell() + " " + scripts + " " + words);
    const std::vector<std::string> lines = linesOf(out.text);
    return {lines.begin(), lines.end()};
  }

  fs::path directory_;
};

// A page as it is typed, by the program's own name and as a verb of farcell.
std::vector<std::string> typed(const HelpPage& page) {
  std::vector<std::string> lines = {page.program + page.words};
  if (page.program != "farcell") lines.push_back("farcell " + page.program.substr(8) + page.words);
  return lines;
}

TEST_P(CompletionTest, OffersEveryOptionOfHelpAndNoOther) {
  for (const HelpPage& page : allHelpPages()) {
    Words expected;
    for (const HelpOption& option : page.options) expected.insert(option.names.begin(), option.names.end());
    // "-h" beside "--help"
    expected.insert("-h");
    for (const std::string& line : typed(page)) EXPECT_EQ(offered(line + " -"), expected) << line;
  }
}

TEST_P(CompletionTest, OffersTheCommands) {
  for (const HelpPage& page : allHelpPages()) {
    if (page.commands.empty()) continue;
    for (const std::string& line : typed(page))
      EXPECT_EQ(offered(line + " "), Words(page.commands.begin(), page.commands.end())) << line;
  }
}

TEST_P(CompletionTest, OffersTheWordsThatAnOptionTakes) {
  int found = 0;
  for (const HelpPage& page : allHelpPages())
    for (const HelpOption& option : page.options)
      if (const std::vector<std::string> choices = option.choices(); !choices.empty()) {
        ++found;
        const std::string line = typed(page).back() + " " + option.names[0] + " ";
        EXPECT_EQ(offered(line), Words(choices.begin(), choices.end())) << line;
      }
  EXPECT_GE(found, 8);
}

TEST_P(CompletionTest, OffersFilesAndDirectories) {
  EXPECT_EQ(offered("farcell build city.o"), Words{"city.obj"});
  EXPECT_EQ(offered("farcell-render --camera city"), Words{"city.obj"});
  const Words directories = offered("farcell build --work-dir s");
  EXPECT_TRUE(directories == Words{"sub"} || directories == Words{"sub/"});
  EXPECT_EQ(offered("farcell build a").size(), 1u);  // the space in "a city.ply" does not make two of it
}

TEST_P(CompletionTest, OffersNothingForANumberOrAfterAnUnknownVerb) {
  EXPECT_EQ(offered("farcell generate city --seed "), Words());
  if (shell() == "bash") {
    EXPECT_EQ(offered("farcell bake "), Words());
  }
}

TEST_P(CompletionTest, OffersTheWordsAfterAnEqualsSign) {
  // bash hands over three words.
  const bool bash = shell() == "bash";
  const Words words = offered(bash ? "farcell render a.far --mode = f" : "farcell render a.far --mode=f");
  EXPECT_TRUE(words == Words{"full"} || words == Words{"--mode=full"});
}

INSTANTIATE_TEST_SUITE_P(Shells, CompletionTest, testing::Values("bash", "zsh", "fish"),
                         [](const auto& shell) { return shell.param; });

TEST(WrongWords, AreExitTwoAndTheMessageListsTheRightOnes) {
  int found = 0;
  for (const HelpPage& page : allHelpPages())
    for (const HelpOption& option : page.options)
      if (const std::vector<std::string> choices = option.choices(); !choices.empty()) {
        ++found;
        const Printed out =
            printed(FARCELL_PROGRAMS_DIR "/" + page.program + page.words + " " + option.names[0] + " other 2>&1");
        EXPECT_EQ(out.code, 2) << option.names[0];
        EXPECT_NE(out.text.find(option.names[0] + ": other"), std::string::npos) << out.text;
        for (const std::string& choice : choices) EXPECT_NE(out.text.find(choice), std::string::npos) << out.text;
      }
  EXPECT_GE(found, 8);
}

}  // namespace
}  // namespace farcell
