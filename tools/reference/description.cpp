#include "tools/reference/description.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace farcell {
namespace {

// What CLI11 knows of a value, taken from "TYPE:{a,b}" or "TYPE:INT in [0 - 8]", the only form in which it tells.
struct ValueType {
  std::string name;
  std::vector<std::string> choices;
  std::string range;
};

ValueType valueTypeOf(const CLI::Option& option) {
  const std::string text = option.get_type_name();
  ValueType type{text.substr(0, text.find(':')), {}, ""};
  const std::string checks = text.substr(type.name.size());
  if (const size_t open = checks.find('{'), close = checks.rfind('}');
      open != std::string::npos && close != std::string::npos)
    type.choices = CLI::detail::split(checks.substr(open + 1, close - open - 1), ',');
  if (const size_t open = checks.find(" in ["); open != std::string::npos)
    type.range =
        CLI::detail::find_and_replace(checks.substr(open + 5, checks.find(']', open) - open - 5), " - ", " to ");
  return type;
}

// CLI11's own words for types say what C++ holds, ours what a person types.
std::string placeholder(const ValueType& type) {
  if (type.name == "INT" || type.name == "UINT") return "N";
  if (type.name == "FLOAT") return "NUMBER";
  if (type.name == "TEXT") return type.choices.empty() ? "FILE" : "WORD";
  return type.name;
}

Completion completionOf(const ValueType& type, const std::string& value) {
  if (!type.choices.empty()) return Completion::choices;
  if (value == "FILE") return Completion::files;
  return value == "DIR" ? Completion::directories : Completion::nothing;
}

// "text [one of 1, 4, 16; default 4]"
std::string meaningOf(const CLI::Option& option, const ValueType& type) {
  std::vector<std::string> facts;
  if (!type.choices.empty()) facts.push_back("one of " + CLI::detail::join(type.choices, ", "));
  if (!type.range.empty()) facts.push_back(type.range);
  if (option.get_expected_max() > 1) facts.emplace_back("may be repeated");
  for (const CLI::Option* other : option.get_excludes()) facts.push_back("not with " + other->get_name());
  if (option.get_required()) facts.emplace_back("required");
  if (!option.get_default_str().empty()) facts.push_back("default " + option.get_default_str());
  if (facts.empty()) return option.get_description();
  return fmt::format("{} [{}]", option.get_description(), CLI::detail::join(facts, "; "));
}

OptionDescription describeOption(const CLI::Option& option) {
  OptionDescription described;
  if (option.get_positional()) {
    described.names.push_back(option.get_name(true));
  } else {
    for (const std::string& name : option.get_snames()) described.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) described.names.push_back("--" + name);
  }
  const ValueType type = valueTypeOf(option);
  if (option.get_items_expected_max() > 0) described.value = placeholder(type);
  described.meaning = meaningOf(option, type);
  described.choices = type.choices;
  described.completion = completionOf(type, described.value);
  described.required = option.get_required();
  return described;
}

std::vector<Note> notesOf(const std::string& footer) {
  std::vector<Note> notes;
  std::istringstream lines(footer);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty()) continue;
    if (line.front() != ' ' && line.back() == ':')
      notes.push_back({line.substr(0, line.size() - 1), {}});
    else if (!notes.empty())
      notes.back().lines.push_back(line.substr(std::min({line.find_first_not_of(' '), line.size(), size_t{2}})));
  }
  return notes;
}

// `farcell-generate` is typed `farcell generate`.
std::string typedName(const CLI::App& app) {
  if (const CLI::App* parent = app.get_parent()) return typedName(*parent) + " " + app.get_name();
  std::string name = app.get_name();
  if (const size_t dash = name.find('-'); dash != std::string::npos) name[dash] = ' ';
  return name;
}

void describeWords(const CLI::App& app, CommandDescription& command) {
  const std::string text = app.get_description();
  const size_t end = std::min(text.find('\n'), text.size());
  command.purpose = text.substr(0, end);
  if (!command.purpose.empty() && command.purpose.back() == '.') command.purpose.pop_back();
  command.details = text.substr(std::min(end + 1, text.size()));
  command.notes = notesOf(app.get_footer());
}

}  // namespace

CommandDescription describe(const CLI::App& app) {
  CommandDescription command;
  command.name = app.get_name();
  command.typed = typedName(app);
  describeWords(app, command);
  if (app.get_prefix_command() && app.get_parent() != nullptr)
    command.program = app.get_parent()->get_name() + "-" + app.get_name();
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;
    (option->get_positional() ? command.arguments : command.options).push_back(describeOption(*option));
  }
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; }))
    command.commands.push_back(describe(*sub));
  return command;
}

}  // namespace farcell
