#include <fmt/format.h>

#include <cctype>

#include "tools/reference/reference.h"

namespace farcell {
namespace {

// Plain text in roff: backslashes and minus signs as such, no line that looks like a request, and lists without spaces
// broken where a line is full.
std::string roff(const std::string& text) {
  std::string escaped;
  bool lineBegins = true, afterComma = false;
  for (const char c : text) {
    if (afterComma && c != ' ') escaped += "\\:";
    if (lineBegins && (c == '.' || c == '\'')) escaped += "\\&";
    if (c == '\\')
      escaped += "\\e";
    else if (c == '-')
      escaped += "\\-";
    else
      escaped += c;
    lineBegins = c == '\n';
    afterComma = c == ',';
  }
  return escaped;
}

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

// The purpose continues a line: "farcell-build - builds a pack".
std::string lowerFirst(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

std::string synopsis(const CommandDescription& command) {
  if (!command.commands.empty()) return fmt::format(".B {}\n.I command\n.RI [ options ]\n", roff(command.typed));
  std::string text = fmt::format(".B {}\n.RI [ options ]\n", roff(command.typed));
  for (const OptionDescription& option : command.options)
    if (option.required) text += fmt::format(".BI {} \" {}\"\n", roff(option.names.front()), roff(option.value));
  for (const OptionDescription& argument : command.arguments) {
    const std::string name = roff(argument.names.front());
    text += argument.required ? ".I " + name + "\n" : ".RI [ " + name + " ]\n";
  }
  return text;
}

std::string entry(const OptionDescription& option) {
  std::vector<std::string> names;
  const bool dashed = option.names.front().front() == '-';
  for (const std::string& name : option.names) names.push_back((dashed ? "\\fB" : "\\fI") + roff(name) + "\\fR");
  std::string line = fmt::format(".TP\n{}", fmt::join(names, ", "));
  if (dashed && !option.value.empty()) line += fmt::format(" \\fI{}\\fR", roff(option.value));
  return line + "\n" + roff(option.meaning) + "\n";
}

std::string optionEntries(const CommandDescription& command) {
  std::string text;
  for (const OptionDescription& argument : command.arguments) text += entry(argument);
  for (const OptionDescription& option : command.options) text += entry(option);
  return text;
}

std::string verbatim(const std::vector<std::string>& lines) {
  std::string text = ".nf\n";
  for (const std::string& line : lines) text += roff(line) + "\n";
  return text + ".fi\n";
}

// A command that is a program has a page of its own; any other is told here.
std::string commandSection(const CommandDescription& command) {
  if (!command.program.empty())
    return fmt::format(".TP\n\\fB{}\\fR\n{}; see\n.BR {} (1).\n", roff(command.name), roff(command.purpose),
                       roff(command.program));
  std::string text = fmt::format(".SS {}\n{}.\n", roff(command.typed), roff(command.purpose));
  if (!command.details.empty()) text += ".PP\n" + roff(command.details) + "\n";
  text += ".PP\n" + synopsis(command) + optionEntries(command);
  for (const Note& note : command.notes) text += ".PP\n" + roff(note.title) + ":\n.PP\n" + verbatim(note.lines);
  for (const CommandDescription& sub : command.commands) text += commandSection(sub);
  return text;
}

std::string seeAlso(const CommandDescription& program) {
  std::string text;
  for (const CommandDescription& command : program.commands)
    if (!command.program.empty()) text += fmt::format("{}.BR {} (1)", text.empty() ? "" : ",\n", roff(command.program));
  if (text.empty() && program.name != "farcell") text = ".BR farcell (1)";
  return text.empty() ? "" : ".SH SEE ALSO\n" + text + "\n";
}

constexpr const char* kExitStatus =
    ".SH EXIT STATUS\n"
    ".TP\n0\nDone.\n"
    ".TP\n1\nFailed; a message on stderr says where, what was expected and what was found.\n"
    ".TP\n2\nMisused: the command line, or a value in it, means nothing.\n";

}  // namespace

std::string manualPage(const CommandDescription& program, const std::string& version, const std::string& date) {
  std::string text =
      fmt::format(".TH {} 1 {} \"farcell {}\" \"User Commands\"\n", roff(upper(program.name)), date, version);
  text += fmt::format(".SH NAME\n{} \\- {}\n", roff(program.name), roff(lowerFirst(program.purpose)));
  text += ".SH SYNOPSIS\n" + synopsis(program);
  text += fmt::format(".SH DESCRIPTION\n{}.\n", roff(program.purpose));
  if (!program.details.empty()) text += ".PP\n" + roff(program.details) + "\n";
  text += ".SH OPTIONS\n" + optionEntries(program);
  if (!program.commands.empty()) text += ".SH COMMANDS\n";
  for (const CommandDescription& command : program.commands) text += commandSection(command);
  text += kExitStatus;
  for (const Note& note : program.notes) text += ".SH " + roff(upper(note.title)) + "\n" + verbatim(note.lines);
  return text + seeAlso(program);
}

}  // namespace farcell
