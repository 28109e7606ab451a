#include <fmt/format.h>

#include "tools/reference/reference.h"

namespace farcell {
namespace {

std::string inQuotes(const std::string& text) {
  const std::string slashes = CLI::detail::find_and_replace(text, "\\", "\\\\");
  return "'" + CLI::detail::find_and_replace(slashes, "'", "\\'") + "'";
}

// "complete -c farcell-generate -n '...'": when the command at `path` is being typed, and none of its own.
std::string lineStart(const std::string& program, const CommandDescription& command,
                      const std::vector<std::string>& path) {
  std::vector<std::string> conditions;
  for (const std::string& word : path) conditions.push_back("__fish_seen_subcommand_from " + word);
  std::vector<std::string> below;
  for (const CommandDescription& sub : command.commands) below.push_back(sub.name);
  if (!below.empty()) conditions.push_back("not __fish_seen_subcommand_from " + CLI::detail::join(below, " "));
  std::string line = "complete -c " + program;
  if (!conditions.empty()) line += " -n " + inQuotes(CLI::detail::join(conditions, "; and "));
  return line;
}

std::string optionLine(const std::string& start, const OptionDescription& option) {
  std::string line = start;
  for (const std::string& name : option.names)
    line += name.size() == 2 ? " -s " + name.substr(1) : " -l " + name.substr(2);
  if (option.completion == Completion::choices)
    line += " -x -a " + inQuotes(CLI::detail::join(option.choices, " "));
  else if (option.completion == Completion::files)
    line += " -r -F";
  else if (option.completion == Completion::directories)
    line += " -x -a '(__fish_complete_directories)'";
  else if (!option.value.empty())
    line += " -x";
  return line + " -d " + inQuotes(option.meaning) + "\n";
}

std::string lines(const std::string& program, const CommandDescription& command, std::vector<std::string> path) {
  const std::string start = lineStart(program, command, path);
  std::string text;
  for (const OptionDescription& option : command.options) text += optionLine(start, option);
  for (const CommandDescription& sub : command.commands)
    text += fmt::format("{} -f -a {} -d {}\n", start, sub.name, inQuotes(sub.purpose));
  if (command.commands.empty() && command.arguments.empty()) text += start + " -f\n";
  for (const CommandDescription& sub : command.commands) {
    path.push_back(sub.name);
    if (sub.program.empty()) text += lines(program, sub, path);
    path.pop_back();
  }
  return text;
}

// What the program that is the command would offer, were it typed in the place of `farcell <command>`.
std::string handOver(const CommandDescription& program) {
  std::vector<std::string> names;
  for (const CommandDescription& command : program.commands)
    if (!command.program.empty()) names.push_back(command.name);
  if (names.empty()) return "";
  const std::string function = "__" + program.name + "_hand_over";
  return fmt::format(
      "function {0}\n"
      "    set -l words (commandline -opc)\n"
      "    set -l current (commandline -ct)\n"
      "    complete -C \"{1}-$words[2] $(string escape -- $words[3..] | string join ' ') $current\"\n"
      "end\n"
      "complete -c {1} -n '__fish_seen_subcommand_from {2}' -f -a '({0})'\n",
      function, program.name, CLI::detail::join(names, " "));
}

}  // namespace

std::string fishCompletion(const CommandDescription& program) {
  return fmt::format("# fish completion for {}\n", program.name) + lines(program.name, program, {}) + handOver(program);
}

}  // namespace farcell
