// The programs as they were built, asked from outside: what they print is all that is known of them here.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <filesystem>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace farcell {

struct Printed {
  int code = -1;
  std::string text;
};

// What a shell's command prints on stdout.
inline Printed printed(const std::string& command) {
  Printed result;
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return result;
  char buffer[4096];
  for (size_t count; (count = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) result.text.append(buffer, count);
  const int status = ::pclose(pipe);
  if (WIFEXITED(status)) result.code = WEXITSTATUS(status);
  return result;
}

inline std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// An option as --help shows it: "  -o, --output FILE   text", the text joined from its lines.
struct HelpOption {
  std::vector<std::string> names;
  std::string value;
  std::string text;

  // After "one of", up to the next fact.
  std::vector<std::string> choices() const {
    std::smatch found;
    std::vector<std::string> list;
    if (!std::regex_search(text, found, std::regex("\\[one of ([^;\\]]*)"))) return list;
    std::istringstream words(found[1].str());
    for (std::string word; words >> word;) list.push_back(word.back() == ',' ? word.substr(0, word.size() - 1) : word);
    return list;
  }
};

// A program or a command of one, by its own --help.
struct HelpPage {
  std::string program;  // "farcell-generate"
  std::string words;    // " city"
  std::string help;
  std::vector<HelpOption> options;
  std::vector<std::string> commands;
  bool takesArguments = false;
};

inline HelpPage helpPage(const std::string& program, const std::string& words) {
  HelpPage page{program, words, printed(FARCELL_PROGRAMS_DIR "/" + program + words + " --help").text, {}, {}, false};
  const std::regex option("^  (?:    |(-\\w), )(--[a-z0-9-]+)(?: (\\S+))?(?:  +(.*))?$");
  const std::regex command("^  (\\S+)  +.*$");
  std::string section;
  for (const std::string& line : linesOf(page.help)) {
    std::smatch found;
    if (!line.empty() && line[0] != ' ') section = line;
    page.takesArguments |= section == "Arguments:";
    if (section == "Commands:" && std::regex_match(line, found, command)) page.commands.push_back(found[1]);
    if (section != "Options:") continue;
    if (std::regex_match(line, found, option)) {
      page.options.push_back({{found[2]}, found[3], found[4]});
      if (found[1].matched) page.options.back().names.push_back(found[1]);
    } else if (!page.options.empty()) {
      page.options.back().text.append(1, ' ').append(line, std::min(line.find_first_not_of(' '), line.size()));
    }
  }
  return page;
}

// Every program of the build and every command of theirs; the verbs of `farcell` are programs themselves.
inline std::vector<HelpPage> allHelpPages() {
  std::vector<HelpPage> pages;
  std::istringstream programs(FARCELL_PROGRAM_NAMES);
  for (std::string program; programs >> program;) {
    pages.push_back(helpPage(program, ""));
    if (program == "farcell") continue;
    for (size_t i = pages.size() - 1; i < pages.size(); ++i)
      for (const std::string& command : std::vector<std::string>(pages[i].commands))
        pages.push_back(helpPage(program, pages[i].words + " " + command));
  }
  return pages;
}

}  // namespace farcell
