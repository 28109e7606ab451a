// farcell-info: what a pack or mesh files hold.
#include <cstdio>

#include "cache/pack/layout.h"
#include "preprocess/read/open_mesh.h"
#include "tools/cli/cli.h"
#include "tools/info/info.h"
#include "tools/report/build_report_json.h"

namespace farcell {
namespace {

// By content, so that a pack is known whatever its name.
Result<bool> startsLikePack(const std::filesystem::path& path) {
  FARCELL_ASSIGN(const InputFile file, InputFile::open(path));
  if (file.sizeBytes() < kHeaderMagic.size()) return false;
  std::array<char, kHeaderMagic.size()> start{};
  FARCELL_TRY(file.readAt(0, std::as_writable_bytes(std::span(start))));
  return start == kHeaderMagic;
}

Result<nlohmann::ordered_json> infoOf(std::span<const std::filesystem::path> paths) {
  FARCELL_ASSIGN(const bool isPack, startsLikePack(paths[0]));
  if (isPack && paths.size() == 1) {
    FARCELL_ASSIGN(const PackFile pack, PackFile::open(paths[0]));
    return packInfoJson(pack);
  }
  FARCELL_ASSIGN(const std::unique_ptr<MeshReader> mesh, openMeshes(paths));
  return meshInfoJson(*mesh);
}

Result<> run(std::span<const std::filesystem::path> paths, bool asJson) {
  FARCELL_ASSIGN(const nlohmann::ordered_json info, infoOf(paths));
  const std::string text = asJson ? jsonText(info) + "\n" : infoText(info);
  std::fputs(text.c_str(), stdout);
  return {};
}

}  // namespace
}  // namespace farcell

int main(int argc, char** argv) {
  CLI::App app(
      "Says what a pack or mesh files hold.\n"
      "A pack is known by its content, a mesh by its content or the ending of its name; a mesh is read to its end, so "
      "that the counts are those a build would see.",
      "farcell-info");
  app.footer(
      "Examples:\n"
      "  farcell info city.far\n"
      "  farcell info city.ply --json\n");
  std::vector<std::filesystem::path> paths;
  bool asJson = false;
  app.add_option("input", paths, "pack, or mesh files as for farcell build")->required();
  app.add_flag("--json", asJson, "print JSON on stdout");
  return farcell::runProgram(app, argc, argv, [&] { return farcell::run(paths, asJson); });
}
