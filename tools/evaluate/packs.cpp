#include "tools/evaluate/packs.h"

#include <algorithm>

namespace farcell {
namespace {

bool isPlainName(const std::string& name) {
  return !name.empty() && name.size() <= 40 && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.';
  });
}

Result<> checkSameModel(const PackFile& own, const PackFile& other) {
  const Directory &expected = own.directory(), &found = other.directory();
  if (found.sourceHash != expected.sourceHash)
    return fail(ErrorKind::invalidArgument,
                "{}: not a pack of the same model as {}: its source '{}' has hash {:016x}, expected '{}' of {:016x}",
                other.path(), own.path(), found.sourceName, found.sourceHash, expected.sourceName, expected.sourceHash);
  if (found.report.inputTriangles != expected.report.inputTriangles)
    return fail(ErrorKind::invalidArgument, "{}: holds {} triangles of the model, expected {} as in {}", other.path(),
                found.report.inputTriangles, expected.report.inputTriangles, own.path());
  if (found.model.settings.up != expected.model.settings.up)
    return fail(ErrorKind::invalidArgument, "{}: built with another up axis than {}", other.path(), own.path());
  return {};
}

}  // namespace

Result<std::vector<OtherPack>> parseOtherPacks(const std::vector<std::string>& words) {
  std::vector<OtherPack> packs;
  for (const std::string& word : words) {
    const size_t equals = std::min(word.find('='), word.size());
    OtherPack pack{word.substr(0, equals), equals < word.size() ? word.substr(equals + 1) : ""};
    if (!isPlainName(pack.name) || pack.path.empty())
      return fail(ErrorKind::invalidArgument, "--against: expected NAME=PACK, found '{}'", word);
    if (std::any_of(packs.begin(), packs.end(), [&](const OtherPack& other) { return other.name == pack.name; }))
      return fail(ErrorKind::invalidArgument, "--against: the name '{}' is given twice", pack.name);
    packs.push_back(std::move(pack));
  }
  return packs;
}

Result<Packs> Packs::open(const std::filesystem::path& own, const std::vector<OtherPack>& others) {
  FARCELL_ASSIGN(PackFile pack, PackFile::open(own));
  Packs packs(std::move(pack));
  for (const OtherPack& other : others) {
    FARCELL_ASSIGN(PackFile file, PackFile::open(other.path));
    FARCELL_TRY(checkSameModel(packs.own_, file));
    packs.others_.emplace(other.name, std::move(file));
  }
  return packs;
}

}  // namespace farcell
