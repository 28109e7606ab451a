#include <fmt/format.h>

#include "tools/reference/reference.h"

namespace farcell {
namespace {

std::string functionOf(const std::string& program) { return "_" + CLI::detail::find_and_replace(program, "-", "_"); }

// A word in single quotes, where the shell leaves everything as it is.
std::string inQuotes(const std::string& text) { return "'" + CLI::detail::find_and_replace(text, "'", "'\\''") + "'"; }

std::string allNames(const CommandDescription& command) {
  std::vector<std::string> names;
  for (const OptionDescription& option : command.options)
    names.insert(names.end(), option.names.begin(), option.names.end());
  return inQuotes(CLI::detail::join(names, " "));
}

std::string offer(const OptionDescription& option) {
  switch (option.completion) {
    case Completion::choices:
      return fmt::format("COMPREPLY=($(compgen -W {} -- \"$cur\"))", inQuotes(CLI::detail::join(option.choices, " ")));
    case Completion::files:
      return "compopt -o filenames; mapfile -t COMPREPLY < <(compgen -f -- \"$cur\")";
    case Completion::directories:
      return "compopt -o filenames; mapfile -t COMPREPLY < <(compgen -d -- \"$cur\")";
    case Completion::nothing:
      break;
  }
  return ":";
}

// The values of the options of `command`, reached by `path` ("/city"); empty for the program itself.
std::string valueCases(const CommandDescription& command, const std::string& path) {
  std::string text;
  for (const OptionDescription& option : command.options) {
    if (option.value.empty()) continue;
    std::vector<std::string> patterns;
    for (const std::string& name : option.names) patterns.push_back(path + ":" + name);
    text += fmt::format("    {}) {}; return ;;\n", fmt::join(patterns, " | "), offer(option));
  }
  for (const CommandDescription& sub : command.commands)
    if (sub.program.empty()) text += valueCases(sub, path + "/" + sub.name);
  return text;
}

// What stands where no option's value does: options after a dash, else commands or the first argument's kind.
std::string wordCases(const CommandDescription& command, const std::string& path) {
  std::string text = fmt::format("    {}:-*) COMPREPLY=($(compgen -W {} -- \"$cur\")) ;;\n", path, allNames(command));
  std::vector<std::string> names;
  for (const CommandDescription& sub : command.commands) names.push_back(sub.name);
  if (!names.empty())
    text += fmt::format("    {}:*) COMPREPLY=($(compgen -W {} -- \"$cur\")) ;;\n", path,
                        inQuotes(CLI::detail::join(names, " ")));
  else if (!command.arguments.empty())
    text += fmt::format("    {}:*) {} ;;\n", path, offer(command.arguments.front()));
  for (const CommandDescription& sub : command.commands)
    if (sub.program.empty()) text += wordCases(sub, path + "/" + sub.name);
  return text;
}

std::string pathCases(const CommandDescription& command, const std::string& path) {
  std::string text;
  for (const CommandDescription& sub : command.commands) {
    if (!sub.program.empty()) continue;
    const std::string below = path + "/" + sub.name;
    text += fmt::format("      {}) path={} ;;\n", below, below);
    text += pathCases(sub, below);
  }
  return text;
}

// Gives the line, without its first word, to the program that is the command; its script lies beside this one.
std::string handOver(const CommandDescription& program) {
  std::vector<std::string> names;
  for (const CommandDescription& command : program.commands)
    if (!command.program.empty()) names.push_back(command.name);
  if (names.empty()) return "";
  return fmt::format(
      "  case $COMP_CWORD:${{COMP_WORDS[1]}} in\n"
      "    1:*) ;;\n"
      "    *:{0})\n"
      "      local program={1}-${{COMP_WORDS[1]}}\n"
      "      declare -F \"_${{program//-/_}}\" >/dev/null || . \"${{BASH_SOURCE[0]%/*}}/$program\" || return\n"
      "      COMP_WORDS=(\"$program\" \"${{COMP_WORDS[@]:2}}\") COMP_CWORD=$((COMP_CWORD - 1))\n"
      "      \"_${{program//-/_}}\"\n"
      "      return ;;\n"
      "    *) return ;;\n"
      "  esac\n",
      fmt::join(names, " | *:"), program.name);
}

}  // namespace

std::string bashCompletion(const CommandDescription& program) {
  const std::string function = functionOf(program.name);
  std::string text = fmt::format("# bash completion for {}\n{}() {{\n{}", program.name, function, handOver(program));
  text +=
      "  local cur=${COMP_WORDS[COMP_CWORD]} option=${COMP_WORDS[COMP_CWORD-1]} path= word\n"
      "  # --option=value comes as three words.\n"
      "  if [[ $cur == = ]]; then\n"
      "    cur=\n"
      "  elif [[ $option == = ]]; then\n"
      "    option=${COMP_WORDS[COMP_CWORD-2]}\n"
      "  fi\n";
  if (const std::string paths = pathCases(program, ""); !paths.empty())
    text += "  for word in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n    case $path/$word in\n" + paths +
            "    esac\n  done\n";
  text += "  case $path:$option in\n" + valueCases(program, "") + "  esac\n";
  text += "  case $path:$cur in\n" + wordCases(program, "") + "  esac\n";
  return text + "}\n" + fmt::format("complete -F {} {}\n", function, program.name);
}

}  // namespace farcell
