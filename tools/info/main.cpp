// farcell-info: what a pack or a mesh file holds.
#include <cstdio>

#include "cache/pack/layout.h"
#include "preprocess/read/open_mesh.h"
#include "tools/cli/cli.h"
#include "tools/info/info.h"
#include "tools/report/build_report_json.h"

namespace farcell {
namespace {

// By content, so that a pack is known whatever its name.
Result<bool> startsLikePack(const std::string& path) {
  FARCELL_ASSIGN(const InputFile file, InputFile::open(path));
  if (file.sizeBytes() < kHeaderMagic.size()) return false;
  std::array<char, kHeaderMagic.size()> start{};
  FARCELL_TRY(file.readAt(0, std::as_writable_bytes(std::span(start))));
  return start == kHeaderMagic;
}

Result<nlohmann::ordered_json> infoOf(const std::string& path) {
  FARCELL_ASSIGN(const bool isPack, startsLikePack(path));
  if (isPack) {
    FARCELL_ASSIGN(const PackFile pack, PackFile::open(path));
    return packInfoJson(pack);
  }
  FARCELL_ASSIGN(const std::unique_ptr<MeshReader> mesh, openMesh(path));
  return meshInfoJson(*mesh);
}

Result<> run(const std::string& path, bool asJson) {
  FARCELL_ASSIGN(const nlohmann::ordered_json info, infoOf(path));
  const std::string text = asJson ? jsonText(info) + "\n" : infoText(info);
  std::fputs(text.c_str(), stdout);
  return {};
}

}  // namespace
}  // namespace farcell

int main(int argc, char** argv) {
  CLI::App app(
      "Says what a pack or a mesh file holds.\n"
      "A pack is known by its content, a mesh by the ending of its name; a mesh is read to its end, so that the counts "
      "are those a build would see.",
      "farcell-info");
  app.footer(
      "Examples:\n"
      "  farcell info city.far\n"
      "  farcell info city.ply --json\n");
  std::string path;
  bool asJson = false;
  app.add_option("input", path, "pack, or mesh file (.ply, .obj)")->required();
  app.add_flag("--json", asJson, "print JSON on stdout");
  return farcell::runProgram(app, argc, argv, [&] { return farcell::run(path, asJson); });
}
