#include "preprocess/choose/choose.h"

#include <algorithm>
#include <queue>

#include "cache/base/check.h"
#include "cache/pack/directory_codec.h"
#include "cache/pack/layout.h"
#include "cache/pack/pack_file.h"
#include "preprocess/choose/worth.h"

namespace farcell {
namespace {

// FORMAT.md; what of the directory depends on names and reasons is allowed for.
constexpr uint64_t kViewPageHeaderBytes = 8;
constexpr uint64_t kViewHeaderBytes = 32;
constexpr uint64_t kPartTriangles = 131072;  // of a mesh, a page
constexpr uint64_t kDirectoryAllowance = 8192;

constexpr std::array<const char*, kViewFates> kFateNames = {
    "kept", "empty", "notVisitable", "sameAsChild", "cheaperAsTriangles", "costsMoreThanItBrings", "packBudget"};

// A page in the file, with its record.
uint64_t pageCost(uint64_t storedBytes) { return storedBytes + kPageRecordBytes; }

// What the views of one cell are, together.
struct CellViews {
  uint64_t bytes = 0;  // in the pack
  uint64_t bare = 0;   // headers and streams, without what pages add
  uint32_t count = 0;  // not empty
};

class Chooser {
 public:
  Chooser(const ChooseInput& input, const ChooseSettings& settings)
      : input_(input),
        settings_(settings),
        cellViews_(input.cells.size()),
        meanTexels_(input.cells.size()),
        fates_(input.cells.size(), ViewFate::kept) {
    measureCells();
  }

  Result<Choice> run() {
    leaveOutWorthless();
    if (settings_.packBudgetBytes) FARCELL_TRY(spend(*settings_.packBudgetBytes));
    return choice();
  }

 private:
  void measureCells();
  void leaveOutWorthless();
  ViewFate fateOf(uint32_t cell, const Worth& worth) const;
  Result<> spend(uint64_t budget);
  void spendByTriangles(uint64_t left);
  void spendByWorth(uint64_t left);
  bool take(uint32_t cell, uint64_t& left);
  uint64_t bytesWithoutViews() const;
  uint64_t viewBytes() const;
  std::vector<uint32_t> candidates() const;
  Choice choice() const;

  const ChooseInput& input_;
  const ChooseSettings& settings_;
  std::vector<CellViews> cellViews_;
  std::vector<float> meanTexels_;
  std::vector<ViewFate> fates_;  // per cell, of its views that are not empty
};

void Chooser::measureCells() {
  for (size_t begin = 0, end = 0; begin < input_.views.size(); begin = end) {
    const uint32_t cell = input_.views[begin].cell;
    FARCELL_CHECK(cell < input_.cells.size());
    const Viewpoints& viewpoints = Viewpoints::of(input_.cells[cell].form.views);
    std::vector<uint64_t> groupBytes(static_cast<size_t>(viewpoints.groupCount()));
    uint64_t texels = 0;
    for (end = begin; end < input_.views.size() && input_.views[end].cell == cell; ++end) {
      const ViewCost& view = input_.views[end];
      if (view.texels == 0) continue;
      uint64_t& bytes = groupBytes[static_cast<size_t>(viewpoints.group(static_cast<int>(view.view)))];
      bytes += (bytes == 0 ? kViewPageHeaderBytes : 0) + kViewHeaderBytes + view.bytes;
      texels += view.texels;
      cellViews_[cell].bare += kViewHeaderBytes + view.bytes;
      ++cellViews_[cell].count;
    }
    for (const uint64_t bytes : groupBytes)
      if (bytes > 0) cellViews_[cell].bytes += pageCost(bytes);
    if (cellViews_[cell].count > 0)
      meanTexels_[cell] = static_cast<float>(static_cast<double>(texels) / cellViews_[cell].count);
  }
}

// From the leaves up: what a cell would be drawn by instead is then known. Its parent is taken to keep its views.
void Chooser::leaveOutWorthless() {
  Worth worth(input_.cells, meanTexels_);
  for (auto cell = static_cast<uint32_t>(input_.cells.size()); cell-- > 0;) {
    if (cellViews_[cell].count == 0) continue;
    fates_[cell] = fateOf(cell, worth);
    if (fates_[cell] == ViewFate::kept) worth.keep(cell);
  }
}

ViewFate Chooser::fateOf(uint32_t index, const Worth& worth) const {
  const CellRecord& cell = input_.cells[index];
  if (cell.childCount == 1 && input_.cells[cell.firstChild].content == cell.content &&
      cellViews_[cell.firstChild].count > 0 && fates_[cell.firstChild] == ViewFate::kept)
    return ViewFate::sameAsChild;
  const double value = worth.of(index, [&](uint32_t above) { return cellViews_[above].count > 0; });
  if (cell.childCount == 0 && value <= 0) return ViewFate::cheaperAsTriangles;
  const bool enough = value >= settings_.leastWorthPerByte * static_cast<double>(cellViews_[index].bytes);
  return enough ? ViewFate::kept : ViewFate::costsMoreThanItBrings;
}

uint64_t Chooser::bytesWithoutViews() const {
  uint64_t bytes = kHeaderBytes + kFooterBytes + kDirectoryAllowance + kCellRecordBytes * input_.cells.size();
  for (size_t cell = 0; cell < input_.cells.size(); ++cell) {
    if (input_.geometryBytes[cell] == 0) continue;
    const uint64_t morePages = input_.cells[cell].meshTriangles / kPartTriangles;
    bytes += pageCost(input_.geometryBytes[cell]) + morePages * kPageRecordBytes;
  }
  return bytes;
}

std::vector<uint32_t> Chooser::candidates() const {
  std::vector<uint32_t> cells;
  for (uint32_t cell = 0; cell < cellViews_.size(); ++cell)
    if (cellViews_[cell].count > 0 && fates_[cell] == ViewFate::kept) cells.push_back(cell);
  return cells;
}

uint64_t Chooser::viewBytes() const {
  uint64_t bytes = 0;
  for (const uint32_t cell : candidates()) bytes += cellViews_[cell].bytes;
  return bytes;
}

Result<> Chooser::spend(uint64_t budget) {
  const uint64_t least = bytesWithoutViews();
  if (budget < least)
    return fail(ErrorKind::exhausted,
                "pack budget: expected at least {} bytes, which the triangles alone take, found {}", least, budget);
  if (viewBytes() <= budget - least) return {};
  (settings_.rule == BudgetRule::worth) ? spendByWorth(budget - least) : spendByTriangles(budget - least);
  return {};
}

bool Chooser::take(uint32_t cell, uint64_t& left) {
  const bool fits = cellViews_[cell].bytes <= left;
  fates_[cell] = fits ? ViewFate::kept : ViewFate::packBudget;
  if (fits) left -= cellViews_[cell].bytes;
  return fits;
}

void Chooser::spendByTriangles(uint64_t left) {
  std::vector<uint32_t> order = candidates();
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t l, uint32_t r) { return input_.cells[l].triangles > input_.cells[r].triangles; });
  for (const uint32_t cell : order) take(cell, left);
}

// Greedy, and lazy: what a cell is worth falls as its relatives are taken, so that one whose worth, known anew, is
// still the highest is next (Minoux, Accelerated greedy algorithms for maximizing submodular set functions, 1978).
void Chooser::spendByWorth(uint64_t left) {
  struct Offer {
    double perByte;
    uint32_t cell;
    bool operator<(const Offer& other) const {
      return perByte != other.perByte ? perByte < other.perByte : cell > other.cell;
    }
  };
  Worth worth(input_.cells, meanTexels_);
  std::vector<bool> taken(input_.cells.size());
  const auto offer = [&](uint32_t cell) {
    const double value = worth.of(cell, [&](uint32_t above) { return taken[above]; });
    return Offer{value / static_cast<double>(cellViews_[cell].bytes), cell};
  };
  std::priority_queue<Offer> offers;
  for (const uint32_t cell : candidates()) offers.push(offer(cell));
  while (!offers.empty()) {
    const Offer now = offer(offers.top().cell);
    offers.pop();
    if (!offers.empty() && now < offers.top()) {
      offers.push(now);
      continue;
    }
    if (now.perByte < settings_.leastWorthPerByte) {
      fates_[now.cell] = ViewFate::costsMoreThanItBrings;
      continue;
    }
    if (!take(now.cell, left)) continue;
    taken[now.cell] = true;
    worth.keep(now.cell);
  }
}

Choice Chooser::choice() const {
  Choice result;
  result.packBytes = bytesWithoutViews() + viewBytes();
  Worth worth(input_.cells, meanTexels_);
  for (const uint32_t cell : candidates()) worth.keep(cell);
  result.costUs = worth.total();
  result.views.reserve(input_.views.size());
  std::vector<uint32_t> baked(input_.cells.size());
  for (const ViewCost& view : input_.views) {
    const ViewFate fate = view.texels == 0 ? ViewFate::empty : fates_[view.cell];
    result.views.push_back(fate);
    ++result.counts[static_cast<size_t>(fate)].views;
    ++baked[view.cell];
  }
  for (uint32_t cell = 0; cell < input_.cells.size(); ++cell) {
    const CellViews& views = cellViews_[cell];
    const auto all = static_cast<uint32_t>(input_.cells[cell].form.views);
    LeftOutCount& unseen = result.counts[static_cast<size_t>(ViewFate::notVisitable)];
    unseen.views += all - baked[cell];
    if (views.count == 0) continue;
    result.counts[static_cast<size_t>(fates_[cell])].bytes += views.bytes;
    unseen.bytes += views.bare * (all - baked[cell]) / views.count;
  }
  return result;
}

}  // namespace

const char* nameOf(ViewFate fate) { return kFateNames[static_cast<size_t>(fate)]; }

std::map<std::string, uint64_t> Choice::viewsLeftOut() const {
  std::map<std::string, uint64_t> result;
  for (size_t fate = 1; fate < kViewFates; ++fate)
    if (counts[fate].views > 0) result[kFateNames[fate]] = counts[fate].views;
  return result;
}

Result<Choice> chooseViews(const ChooseInput& input, const ChooseSettings& settings) {
  FARCELL_CHECK(input.geometryBytes.size() == input.cells.size());
  return Chooser(input, settings).run();
}

std::vector<std::string> reportLines(const Choice& choice) {
  std::vector<std::string> lines;
  for (size_t fate = 1; fate < kViewFates; ++fate)
    if (choice.counts[fate].views > 0)
      lines.push_back(fmt::format("left out: {} views, {:.1f} MB ({})", choice.counts[fate].views,
                                  static_cast<double>(choice.counts[fate].bytes) * 1e-6, kFateNames[fate]));
  return lines;
}

}  // namespace farcell
