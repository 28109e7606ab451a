// The pack that is evaluated, and others of the same model to compare it with.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "cache/pack/pack_file.h"
#include "tools/evaluate/plan/renderers.h"

namespace farcell {

// "paper=city-flat.far": a name of letters, digits, '-', '_' and '.', and a path.
struct OtherPack {
  std::string name;
  std::filesystem::path path;
};
// invalidArgument: another form, or a name given twice.
Result<std::vector<OtherPack>> parseOtherPacks(const std::vector<std::string>& words);

class Packs {
 public:
  // invalidArgument, with both values, for another pack that was not built from the same files (their hash, and the
  // triangles taken from them) or with another up axis, which a
  // sun depends on.
  static Result<Packs> open(const std::filesystem::path& own, const std::vector<OtherPack>& others);

  const PackFile& own() const { return own_; }
  const std::map<std::string, PackFile>& others() const { return others_; }
  // REQUIRES: a plan of one of these packs.
  const PackFile& of(const RendererPlan& plan) const { return plan.pack.empty() ? own_ : others_.at(plan.pack); }

 private:
  explicit Packs(PackFile own) : own_(std::move(own)) {}
  PackFile own_;
  std::map<std::string, PackFile> others_;
};

}  // namespace farcell
