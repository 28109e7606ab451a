#include <fmt/format.h>

#include "tools/reference/reference.h"

namespace farcell {
namespace {

// `text` with a backslash before each of `special`, as the parts of a word of _arguments want it.
std::string escaped(const std::string& text, const std::string& special) {
  std::string result;
  for (const char c : text) {
    if (c == '\\' || special.find(c) != std::string::npos) result += '\\';
    result += c;
  }
  return result;
}

std::string inQuotes(const std::string& text) { return "'" + CLI::detail::find_and_replace(text, "'", "'\\''") + "'"; }

std::string action(const OptionDescription& option) {
  switch (option.completion) {
    case Completion::choices:
      return "(" + escaped(CLI::detail::join(option.choices, " "), ":()") + ")";
    case Completion::files:
      return "_files";
    case Completion::directories:
      return "_files -/";
    case Completion::nothing:
      break;
  }
  return " ";
}

// One word of _arguments a name: '(-o --output)-o[meaning]:FILE:_files'.
std::string optionWords(const OptionDescription& option) {
  std::string text;
  for (const std::string& name : option.names) {
    std::string word = fmt::format("({}){}", fmt::join(option.names, " "), name);
    if (!option.value.empty() && name.size() > 2) word += "=";
    word += "[" + escaped(option.meaning, "[]") + "]";
    if (!option.value.empty()) word += fmt::format(":{}:{}", escaped(option.value, ":"), action(option));
    text += " \\\n    " + inQuotes(word);
  }
  return text;
}

std::string commandWord(const CommandDescription& command) {
  std::string list;
  for (const CommandDescription& sub : command.commands)
    list += fmt::format(" {}\\:\"{}\"", sub.name, escaped(sub.purpose, ":()\""));
  return inQuotes("1:command:((" + list.substr(1) + "))");
}

// The function `name` completes the words of `command`; those of its commands are called `name`-<command>, the name of
// a program's function too.
std::string functionText(const std::string& name, const CommandDescription& command) {
  std::string text, cases;
  for (const CommandDescription& sub : command.commands) {
    if (sub.program.empty()) text += functionText(name + "-" + sub.name, sub);
    cases += fmt::format("    {}) {}-{} ;;\n", sub.name, name, sub.name);
  }
  text += name + "() {\n";
  if (!cases.empty()) text += "  local curcontext=$curcontext state line\n  typeset -A opt_args\n";
  text += cases.empty() ? "  _arguments -S" : "  _arguments -C";
  for (const OptionDescription& option : command.options) text += optionWords(option);
  for (size_t i = 0; i < command.arguments.size(); ++i)
    text += " \\\n    " + inQuotes(fmt::format("{}:{}:{}", i + 1, escaped(command.arguments[i].names.front(), ":"),
                                               action(command.arguments[i])));
  if (cases.empty()) return text + "\n}\n";
  text += " \\\n    " + commandWord(command) + " \\\n    '*::argument:->argument' && return\n";
  return text + "  [[ $state == argument ]] && case $words[1] in\n" + cases + "  esac\n}\n";
}

}  // namespace

std::string zshCompletion(const CommandDescription& program) {
  const std::string name = "_" + program.name;
  return fmt::format("#compdef {}\n{}{} \"$@\"\n", program.name, functionText(name, program), name);
}

}  // namespace farcell
