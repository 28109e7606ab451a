// Help and manual page of every program: complete, readable, and without a complaint of the tools that check pages.
#include <cctype>

#include "tests/package/programs.h"

namespace farcell {
namespace {

std::string pageFile(const std::string& program) { return FARCELL_REFERENCE_DIR "/man/man1/" + program + ".1.gz"; }

// Without the escapes of roff.
std::string pageText(const std::string& program) {
  const std::string text = printed("gzip -dc " + pageFile(program)).text;
  return std::regex_replace(std::regex_replace(text, std::regex("\\\\f[BIR]|\\\\:"), ""), std::regex("\\\\-"), "-");
}

bool installed(const std::string& command) { return printed("command -v " + command).code == 0; }

TEST(Reference, HelpFitsInAHundredColumns) {
  for (const HelpPage& page : allHelpPages()) {
    EXPECT_FALSE(page.options.empty()) << page.program << page.words;
    for (const std::string& line : linesOf(page.help)) EXPECT_LE(line.size(), 100u) << page.program << ": " << line;
  }
}

TEST(Reference, EachOptionOfANumberTellsItsUnitRangeOrDefault) {
  for (const HelpPage& page : allHelpPages())
    for (const HelpOption& option : page.options) {
      EXPECT_FALSE(option.text.empty()) << page.program << page.words << " " << option.names[0];
      if (option.value != "N" && option.value != "NUMBER" && option.value != "COUNT" && option.value != "MIB") continue;
      EXPECT_TRUE(std::any_of(option.text.begin(), option.text.end(), [](unsigned char c) { return std::isdigit(c); }))
          << page.program << page.words << " " << option.names[0] << ": " << option.text;
    }
}

TEST(Reference, EveryOptionOfHelpIsInTheManualPage) {
  for (const HelpPage& page : allHelpPages()) {
    const std::string text = pageText(page.program);
    ASSERT_FALSE(text.empty()) << pageFile(page.program);
    std::string typed = page.program + page.words;
    if (const size_t dash = typed.find('-'); dash != std::string::npos) typed[dash] = ' ';
    // A command's options follow its own heading.
    const size_t begin = page.words.empty() ? text.find(".SH OPTIONS") : text.find(".SS " + typed + "\n");
    ASSERT_NE(begin, std::string::npos) << typed;
    const std::string section = text.substr(begin, text.find("\n.S", begin + 1) - begin);
    for (const HelpOption& option : page.options)
      EXPECT_TRUE(std::regex_search(section, std::regex("\n(-\\w, )?" + option.names[0] +
                                                        (option.value.empty() ? "" : " " + option.value) + "\n")))
          << typed << " " << option.names[0] << " in\n"
          << section;
    for (const std::string& command : page.commands)
      EXPECT_NE(text.find(command), std::string::npos) << typed << " " << command;
  }
}

TEST(Reference, ManualPagesGiveTheVersionAndTheExitCodes) {
  for (const HelpPage& page : allHelpPages()) {
    const std::string text = pageText(page.program);
    EXPECT_NE(text.find("\"farcell " FARCELL_VERSION "\""), std::string::npos) << page.program;
    EXPECT_NE(text.find(".SH EXIT STATUS"), std::string::npos) << page.program;
    EXPECT_EQ(printed(FARCELL_PROGRAMS_DIR "/" + page.program + " --version").text,
              page.program + " " FARCELL_VERSION "\n");
  }
}

TEST(Reference, ManualPagesOfTheProgramsAreThoseThatFarcellNames) {
  const std::string text = pageText("farcell");
  for (const HelpPage& page : allHelpPages()) {
    if (page.program == "farcell") continue;
    EXPECT_NE(text.find(".BR " + page.program + " (1)"), std::string::npos) << page.program;
  }
}

TEST(Reference, ManHasNoWarnings) {
  if (!installed("man")) GTEST_SKIP() << "man is not installed";
  for (const HelpPage& page : allHelpPages()) {
    const Printed warnings =
        printed("LC_ALL=C MANWIDTH=80 man --warnings -l " + pageFile(page.program) + " 2>&1 >/dev/null");
    EXPECT_EQ(warnings.code, 0);
    EXPECT_EQ(warnings.text, "") << page.program;
  }
}

TEST(Reference, MandocHasNoWarnings) {
  if (!installed("mandoc")) GTEST_SKIP() << "mandoc is not installed";
  for (const HelpPage& page : allHelpPages())
    EXPECT_EQ(printed("mandoc -T lint -W warning " + pageFile(page.program)).text, "") << page.program;
}

}  // namespace
}  // namespace farcell
