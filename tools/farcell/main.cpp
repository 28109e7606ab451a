// `farcell <verb> ...` runs `farcell-<verb>` beside itself, so that heavy libraries are mapped only by the verbs that
// need them.
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace {

struct Verb {
  std::string_view name;
  std::string_view purpose;
};
constexpr std::array kVerbs = {
    Verb{"generate", "make a procedural model of any size"},
    Verb{"build", "build a pack from a mesh file"},
    Verb{"info", "say what a pack or a mesh file holds"},
    Verb{"verify", "check every byte of a pack"},
    Verb{"render", "draw a picture of a pack"},
    Verb{"extract", "write the views of a pack as pictures"},
    Verb{"evaluate", "measure pictures of a pack against the full geometry"},
};

int usage(std::FILE* out, int code) {
  std::fputs("usage: farcell <verb> [options]   (farcell <verb> --help for its options)\n\nverbs:\n", out);
  for (const Verb& verb : kVerbs)
    std::fprintf(out, "  %-10s %s\n", std::string(verb.name).c_str(), std::string(verb.purpose).c_str());
  return code;
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

}  // namespace

int main(int argc, char** argv) {
  const std::string_view word = argc > 1 ? argv[1] : "";
  if (word == "--help" || word == "-h" || word == "help") return usage(stdout, 0);
  if (word == "--version") return std::printf("farcell %s\n", FARCELL_VERSION) < 0;
  for (const Verb& verb : kVerbs)
    if (verb.name == word) return runVerb(std::string(word), argv + 1);
  if (!word.empty()) std::fprintf(stderr, "farcell: unknown verb '%s'\n", argv[1]);
  return usage(stderr, 2);
}
