// What of a baked model goes into its pack. Every view stays, or goes for one of a few reasons. Whatever goes, the
// runtime draws everything: a cell keeps all the views that somebody can get or none; without views a leaf is drawn as
// triangles, which are always kept, and an inner cell by its children.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cache/base/result.h"
#include "cache/pack/directory.h"

namespace farcell {

enum class ViewFate : uint8_t {
  kept,
  empty,                  // shows nothing
  notVisitable,           // nobody can get it (visitable.h): was not even baked
  sameAsChild,            // of a cell whose one child holds all of it
  cheaperAsTriangles,     // of a leaf: no time or error would be saved
  costsMoreThanItBrings,  // less worth a byte than ChooseSettings say
  packBudget,             // of what is worth keeping, the least worth a byte
};
inline constexpr size_t kViewFates = 7;
// As reports name it: "costsMoreThanItBrings".
const char* nameOf(ViewFate fate);

// One baked view. bytes: its coded stream; texels: of its cropped rectangle, 0: it shows nothing; covered: those with
// anything; edges: those of them that are covered in part.
struct ViewCost {
  uint32_t cell = 0;
  uint32_t view = 0;
  uint32_t bytes = 0;
  uint32_t texels = 0;
  uint32_t covered = 0;
  uint32_t edges = 0;
};

// The spans must outlive the call. Of a cell, all views that somebody can get are there.
struct ChooseInput {
  std::span<const CellRecord> cells;        // as a directory has them; pages not looked at
  std::span<const uint32_t> geometryBytes;  // per cell, its pages as stored; 0: none
  std::span<const ViewCost> views;          // by cell, then view, each at most once
};

// Modelled microseconds a frame and octave of distance that a byte has to bring. A full leaf's 42 views of 128^2 bring
// a hundred times as much; ten times more would leave out most of a city's impostors.
inline constexpr double kLeastWorthPerByte = 1e-4;

struct ChooseSettings {
  double leastWorthPerByte = kLeastWorthPerByte;
  std::optional<uint64_t> packBudgetBytes = std::nullopt;
  BudgetRule rule = BudgetRule::worth;
};

struct LeftOutCount {
  uint64_t views = 0;
  // That the pack would be larger by, with the pages' headers and records. Of views that were not baked: if
  // they were as large as the cell's others, without pages.
  uint64_t bytes = 0;
};

struct Choice {
  std::vector<ViewFate> views;  // of ChooseInput::views
  std::array<LeftOutCount, kViewFates> counts{};
  uint64_t packBytes = 0;  // at most
  double costUs = 0;       // of drawing the model, as worth.h has it: a frame, summed over octaves of distance
  // BuildReport::viewsLeftOut, of which reasons there are.
  std::map<std::string, uint64_t> viewsLeftOut() const;
};

// Deterministic, one thread, O(n log n); beside its result about 16 bytes a view. exhausted when not even the pack
// without any view fits the budget; the message says the least that would.
Result<Choice> chooseViews(const ChooseInput& input, const ChooseSettings& settings);

// Lines for people: what was left out, why, and what it saved; empty where nothing was.
std::vector<std::string> reportLines(const Choice& choice);

}  // namespace farcell
