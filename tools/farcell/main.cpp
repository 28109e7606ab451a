// `farcell <verb> ...` runs `farcell-<verb>` beside itself, so that heavy libraries are mapped only by the verbs that
// need them.
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include "tools/cli/cli.h"

namespace farcell {
namespace {

struct Verb {
  std::string_view name;
  std::string_view purpose;
};
constexpr std::array kVerbs = {
    Verb{"generate", "make a procedural model of any size"},
    Verb{"build", "build a pack from a mesh file"},
    Verb{"batch", "build the packs of a list of data sets"},
    Verb{"repack", "write a pack again in fewer bytes"},
    Verb{"info", "say what a pack or a mesh file holds"},
    Verb{"verify", "check every byte of a pack"},
    Verb{"render", "draw a picture of a pack"},
    Verb{"view", "walk through a pack in a window"},
    Verb{"extract", "write the views of a pack as pictures"},
    Verb{"evaluate", "measure pictures of a pack against the full geometry"},
};

bool isVerb(std::string_view word) {
  return std::any_of(kVerbs.begin(), kVerbs.end(), [&](const Verb& verb) { return verb.name == word; });
}

int runVerb(const std::string& verb, char** arguments) {
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::string program = (self.parent_path() / ("farcell-" + verb)).string();
  std::string name = "farcell-" + verb;
  arguments[0] = name.data();
  ::execv(program.c_str(), arguments);
  std::fprintf(stderr, "farcell: cannot run %s: %s\n", program.c_str(), std::strerror(errno));
  return 1;
}

// The verbs as commands that are programs: the one list behind --help, the manual page and completion.
void addVerbs(CLI::App& app) {
  for (const Verb& verb : kVerbs)
    app.add_subcommand(std::string(verb.name), std::string(verb.purpose))->prefix_command();
  app.require_subcommand(1);
  app.footer(
      "Examples:\n"
      "  farcell generate city --triangles 5M --seed 1 -o city.ply\n"
      "  farcell build city.ply -o city.far\n"
      "  farcell verify city.far\n"
      "  farcell render city.far --size 1280x720 -o city.png\n"
      "  farcell evaluate city.far --auto-cameras 2 -o report/\n"
      "Files:\n"
      "  *.ply, *.obj    models\n"
      "  *.far           packs: the cells of a model, their triangles and impostors\n"
      "  cameras.json    {\"cameras\": [{\"name\": \"a\", \"position\": [0, -9, 5],\n"
      "                    \"target\": [0, 0, 0], \"up\": [0, 0, 1], \"fovYDeg\": 40}]}\n"
      "                  in the model's own coordinates\n"
      "Environment:\n"
      "  LIBGL_ALWAYS_SOFTWARE=1   Mesa draws with the processor, not the GPU\n");
}

}  // namespace
}  // namespace farcell

int main(int argc, char** argv) {
  const std::string word = argc > 1 ? argv[1] : "";
  if (farcell::isVerb(word)) return farcell::runVerb(word, argv + 1);
  std::string help = "--help";
  if (const std::string verb = argc > 2 ? argv[2] : ""; (word == "help" || word == help) && farcell::isVerb(verb)) {
    argv[2] = help.data();
    return farcell::runVerb(verb, argv + 1);
  }
  CLI::App app(
      "Walks through models larger than memory, with the error of every picture known.\n"
      "A model is built into a pack once; pictures are drawn from the pack. Each verb is a program of its own, whose "
      "options `farcell <verb> --help` tells.",
      "farcell");
  farcell::addVerbs(app);
  app.failure_message([&](const CLI::App* self, const CLI::Error& error) {
    if (error.get_name() == "ValidationError") return "farcell: " + std::string(error.what()) + "\n";
    return (word.empty() ? word : "farcell: unknown verb '" + word + "'\n") + self->help();
  });
  if (word == "help") argv[1] = help.data();
  return farcell::runProgram(app, argc, argv, [] { return farcell::Result<>{}; });
}
