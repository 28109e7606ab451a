// A sample program with every kind of option: what is told of it in help, manual page and completion.
#include "tools/reference/reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace farcell {
namespace {

// The values live as long as the App, which points to them.
struct Sample {
  CLI::App app{"Bakes cakes.\nSlowly: 'it' takes \\ time.\n.5 hours at least.", "farcell-bake"};
  std::filesystem::path input, output, directory;
  int layers = 4;
  double sugar = .5;
  std::string kind = "round", note;
  bool quiet = false;

  Sample() {
    app.add_option("recipe", input, "what to bake")->required();
    app.add_option("-o,--output", output, "where it goes")->required();
    app.add_option("--shelf", directory, "what's around")->type_name("DIR");
    app.add_option("--layers", layers, "how many")->check(CLI::IsMember({"1", "4", "16"}))->capture_default_str();
    auto* sweet = app.add_option("--sugar", sugar, "kg")->check(CLI::Range(0.25, 2.0))->capture_default_str();
    app.add_option("--kind", kind, "shape: of it")->check(CLI::IsMember({"round", "flat"}))->capture_default_str();
    app.add_option("--note", note, "a word")->type_name("NAME")->excludes(sweet);
    app.add_flag("-q,--quiet", quiet, "say nothing");
    app.add_option("--secret", note, "not told")->group("");
    CLI::App* ice = app.add_subcommand("ice", "Frosting.");
    ice->add_option("--colour", note, "of it")->check(CLI::IsMember({"pink"}));
    app.footer("Examples:\n  farcell bake a.txt -o b\n    .more\nFiles:\n  b  a 'cake'\n");
  }
  CommandDescription described() const { return describe(app); }
};

const OptionDescription& optionNamed(const CommandDescription& command, const std::string& name) {
  for (const auto& options : {&command.options, &command.arguments})
    for (const OptionDescription& option : *options)
      if (std::find(option.names.begin(), option.names.end(), name) != option.names.end()) return option;
  throw std::runtime_error("no option " + name);
}

TEST(Description, HoldsWhatCli11KnowsOfAnOption) {
  const CommandDescription command = Sample().described();
  EXPECT_EQ(command.typed, "farcell bake");
  EXPECT_EQ(command.purpose, "Bakes cakes");
  const OptionDescription& layers = optionNamed(command, "--layers");
  EXPECT_EQ(layers.choices, (std::vector<std::string>{"1", "4", "16"}));
  EXPECT_EQ(layers.meaning, "how many [one of 1, 4, 16; default 4]");
  EXPECT_EQ(layers.value, "N");
  EXPECT_EQ(optionNamed(command, "--sugar").meaning, "kg [0.25 to 2; not with --note; default 0.5]");
  EXPECT_EQ(optionNamed(command, "-o").meaning, "where it goes [required]");
  EXPECT_EQ(optionNamed(command, "--quiet").value, "");
  EXPECT_EQ(optionNamed(command, "--kind").value, "WORD");
}

TEST(Description, CompletesFilesDirectoriesChoicesAndNothingElse) {
  const CommandDescription command = Sample().described();
  EXPECT_EQ(optionNamed(command, "recipe").completion, Completion::files);
  EXPECT_EQ(optionNamed(command, "--output").completion, Completion::files);
  EXPECT_EQ(optionNamed(command, "--shelf").completion, Completion::directories);
  EXPECT_EQ(optionNamed(command, "--layers").completion, Completion::choices);
  EXPECT_EQ(optionNamed(command, "--note").completion, Completion::nothing);
  EXPECT_EQ(optionNamed(command, "--sugar").completion, Completion::nothing);
}

TEST(Description, TakesCommandsAndNotesAlong) {
  const CommandDescription command = Sample().described();
  ASSERT_EQ(command.commands.size(), 1u);
  EXPECT_EQ(command.commands[0].typed, "farcell bake ice");
  EXPECT_EQ(optionNamed(command.commands[0], "--colour").choices, std::vector<std::string>{"pink"});
  ASSERT_EQ(command.notes.size(), 2u);
  EXPECT_EQ(command.notes[0].title, "Examples");
  EXPECT_EQ(command.notes[0].lines, (std::vector<std::string>{"farcell bake a.txt -o b", "  .more"}));
}

TEST(Description, ACommandThatIsAProgramIsNamedAfterBoth) {
  CLI::App app("Does it.", "farcell");
  app.add_subcommand("bake", "bake it")->prefix_command();
  EXPECT_EQ(describe(app).commands.at(0).program, "farcell-bake");
}

TEST(HelpText, HoldsEveryOptionInLinesThatFit) {
  Sample sample;
  sample.app.add_option("--an-option-with-a-name-too-wide-for-its-column", sample.note, "still told");
  std::string words;
  for (int i = 0; i < 200; ++i) words += "word" + std::to_string(i) + " ";
  sample.app.add_option("--long", sample.note, words);
  const std::string help = helpText(sample.described());
  for (const char* name : {"-o, --output FILE", "--layers N", "-q, --quiet", "recipe", "word199", "still told", "ice"})
    EXPECT_NE(help.find(name), std::string::npos) << name << " in\n" << help;
  EXPECT_EQ(help.find("secret"), std::string::npos);
  std::istringstream lines(help);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), kHelpColumns) << line;
}

TEST(HelpText, AWordWiderThanTheScreenIsKeptWhole) {
  Sample sample;
  sample.app.add_option("--wide", sample.note, std::string(300, 'w'));
  EXPECT_NE(helpText(sample.described()).find(std::string(300, 'w')), std::string::npos);
}

TEST(ManualPage, EscapesWhatRoffWouldTakeForItself) {
  const std::string page = manualPage(Sample().described(), "1.2.3", "2020-02-02");
  EXPECT_EQ(page.find(".TH FARCELL\\-BAKE 1 2020-02-02 \"farcell 1.2.3\""), 0u) << page;
  EXPECT_NE(page.find("\\fB\\-o\\fR, \\fB\\-\\-output\\fR \\fIFILE\\fR\n"), std::string::npos) << page;
  EXPECT_NE(page.find("takes \\e time.\n\\&.5 hours"), std::string::npos) << page;
  EXPECT_EQ(page.find("secret"), std::string::npos);
  // No line begins as a request but those that are meant.
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || (line[0] != '.' && line[0] != '\'')) continue;
    EXPECT_NE(std::string(".TH .SH .SS .TP .PP .nf .fi .B .I .BI .RI .BR").find(line.substr(0, line.find(' '))),
              std::string::npos)
        << line;
  }
}

TEST(Completion, ScriptsNameTheirProgramAndQuoteWhatShellsWouldTakeForThemselves) {
  const CommandDescription program = Sample().described();
  EXPECT_NE(bashCompletion(program).find("complete -F _farcell_bake farcell-bake\n"), std::string::npos);
  EXPECT_EQ(zshCompletion(program).find("#compdef farcell-bake\n"), 0u);
  EXPECT_NE(zshCompletion(program).find("[what'\\''s around]"), std::string::npos) << zshCompletion(program);
  EXPECT_NE(fishCompletion(program).find("-l shelf -x -a '(__fish_complete_directories)' -d 'what\\'s around'"),
            std::string::npos)
      << fishCompletion(program);
  for (const std::string& script : {bashCompletion(program), zshCompletion(program), fishCompletion(program)})
    EXPECT_EQ(script.find("secret"), std::string::npos) << script;
}

}  // namespace
}  // namespace farcell
