// What a program can be told, as one tree read from its CLI11 App: the source of --help, of the manual page and of
// shell completion, so that nothing lists an option twice.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace farcell {

enum class Completion { nothing, choices, files, directories };

// An option, or an argument without dashes.
struct OptionDescription {
  std::vector<std::string> names;  // "-o", "--output"; an argument: its one name
  std::string value;               // "FILE", "N", ...; empty: takes none
  std::string meaning;             // the App's text and what its checks say: range, choices, default, required
  std::vector<std::string> choices;
  Completion completion = Completion::nothing;
  bool required = false;
};

// Lines below the options: a title ("Examples") and lines kept as they are written.
struct Note {
  std::string title;
  std::vector<std::string> lines;
};

// A program, or a command of one: `farcell-generate` and its `city`.
struct CommandDescription {
  std::string name;     // "farcell-generate", "city"
  std::string typed;    // as a person types it: "farcell generate city"
  std::string purpose;  // one sentence, without its full stop
  std::string details;  // the rest of the App's description; may be empty
  std::vector<OptionDescription> arguments;
  std::vector<OptionDescription> options;
  std::vector<CommandDescription> commands;
  std::vector<Note> notes;
  std::string program;  // what is run in the command's place, and tells of it: "farcell-build"; mostly empty
};

// How CLI11 is read, besides names, texts, defaults and REQUIRED:
// - description: its first line is the purpose, the others are details;
// - type_name: FILE (also CLI11's own TEXT) completes to files, DIR to directories, everything else to nothing;
// - check(CLI::IsMember({...})) gives choices, check(CLI::Range(...)) the range; excludes() is told;
// - footer: lines that begin in the first column and end with a colon are titles of notes;
// - prefix_command(): the command is the program "<parent>-<name>".
// Options of an empty group are hidden.
CommandDescription describe(const CLI::App& app);

}  // namespace farcell
