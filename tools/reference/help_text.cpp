#include <fmt/format.h>

#include <sstream>

#include "tools/reference/reference.h"

namespace farcell {
namespace {

constexpr size_t kTextColumn = 28;

// The words of `text` in lines of at most kHelpColumns, all but the first indented by `indent`, which the first is too.
std::string wrapped(const std::string& text, size_t indent) {
  std::string lines;
  size_t column = indent;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (column > indent && column + 1 + word.size() > kHelpColumns) {
      lines += "\n" + std::string(indent, ' ');
      column = indent;
    }
    if (column > indent) lines += ' ', ++column;
    lines += word;
    column += word.size();
  }
  return lines + "\n";
}

// "  -o, --output FILE     text": the text moves to the next line where the left part is too wide.
std::string entry(const std::string& left, const std::string& text) {
  std::string line = "  " + left;
  if (line.size() + 2 > kTextColumn) line += "\n" + std::string(kTextColumn, ' ');
  if (line.size() < kTextColumn) line.resize(kTextColumn, ' ');
  return line + wrapped(text, kTextColumn);
}

std::string leftOf(const OptionDescription& option) {
  const bool shortFirst = option.names.front().size() == 2;
  const std::string indent = option.names.front().front() == '-' && !shortFirst ? "    " : "";
  return fmt::format("{}{}{}{}", indent, fmt::join(option.names, ", "), option.value.empty() ? "" : " ", option.value);
}

std::string usage(const CommandDescription& command) {
  std::string line = "usage: " + command.typed;
  if (!command.commands.empty()) return line + " <command> [options]\n";
  line += " [options]";
  for (const OptionDescription& option : command.options)
    if (option.required) line += fmt::format(" {} {}", option.names.front(), option.value);
  for (const OptionDescription& argument : command.arguments)
    line += (argument.required ? " <" : " [<") + argument.names.front() + (argument.required ? ">" : ">]");
  return line + "\n";
}

}  // namespace

std::string helpText(const CommandDescription& command) {
  std::string text = wrapped(command.purpose + ". " + command.details, 0) + "\n" + usage(command);
  if (!command.commands.empty()) text += "\nCommands:\n";
  for (const CommandDescription& sub : command.commands) text += entry(sub.name, sub.purpose);
  if (!command.arguments.empty()) text += "\nArguments:\n";
  for (const OptionDescription& argument : command.arguments) text += entry(argument.names.front(), argument.meaning);
  if (!command.options.empty()) text += "\nOptions:\n";
  for (const OptionDescription& option : command.options) text += entry(leftOf(option), option.meaning);
  for (const Note& note : command.notes) {
    text += "\n" + note.title + ":\n";
    for (const std::string& line : note.lines) text += "  " + line + "\n";
  }
  return text;
}

}  // namespace farcell
