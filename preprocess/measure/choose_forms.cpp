#include "preprocess/measure/choose_forms.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "cache/base/check.h"

namespace farcell {
namespace {

constexpr size_t kEdges = kPictureEdges.size();
constexpr size_t kSizes = kCandidateSizes.size();
constexpr size_t kPoints = 16;  // of the Pareto set

size_t sizeOf(size_t candidate) { return candidate / kCandidateViews.size(); }

struct Sums {
  uint64_t cells = 0;
  std::array<ErrorSum, kEdges> single{}, triangles{};
  std::array<CandidateErrors, kCandidates> forms{};

  void add(const CellCandidates& cell) {
    ++cells;
    for (size_t edge = 0; edge < kEdges; ++edge) {
      single[edge].add(cell.single[edge]);
      triangles[edge].add(cell.triangles[edge]);
      for (size_t i = 0; i < kCandidates; ++i) {
        forms[i].depthCorrected[edge].add(cell.forms[i].depthCorrected[edge]);
        forms[i].blended[edge].add(cell.forms[i].blended[edge]);
      }
    }
    for (size_t i = 0; i < kCandidates; ++i) forms[i].bytes += cell.forms[i].bytes;
  }

  FormMeans means() const {
    FormMeans means;
    for (size_t edge = 0; edge < kEdges; ++edge) {
      const double unit = single[edge].mean();
      const auto ratio = [&](const ErrorSum& sum) { return unit > 0 ? sum.mean() / unit : 0; };
      means.triangles[edge] = ratio(triangles[edge]);
      for (size_t i = 0; i < kCandidates; ++i) {
        means.candidates[i][edge] = ratio(forms[i].depthCorrected[edge]);
        means.blended[i][edge] = ratio(forms[i].blended[edge]);
      }
    }
    for (size_t i = 0; i < kCandidates; ++i) means.bytes[i] = forms[i].bytes / static_cast<double>(cells);
    return means;
  }
};

// What a box covers, mean over directions, up to a factor (Cauchy).
double areaOf(const GridBox& box) {
  const glm::dvec3 size(box.max - box.min);
  return size.x * size.y + size.y * size.z + size.z * size.x;
}

// Of whole octaves, each by the mean of its ends: up to so many pixels along the edge a kind is drawn by its views from
// where its parents' reach ends.
double errorOfViews(const FormMeans& means, size_t candidate, int fromPixels) {
  double sum = 0;
  for (size_t edge = 0; edge + 1 < kEdges; ++edge)
    if (kPictureEdges[edge] >= fromPixels && 2 * kPictureEdges[edge + 1] <= kCandidateSizes[sizeOf(candidate)])
      sum += (means.candidates[candidate][edge] + means.candidates[candidate][edge + 1]) / 2;
  return sum;
}
double errorOfTriangles(const FormMeans& means, int fromPixels) {
  double sum = 0;
  for (size_t edge = 0; edge + 1 < kEdges; ++edge)
    if (kPictureEdges[edge] >= fromPixels) sum += (means.triangles[edge] + means.triangles[edge + 1]) / 2;
  return sum;
}

// The kinds of a level, which have the same parents.
struct Level {
  std::optional<size_t> inner, leaf;  // kinds
};

class Chooser {
 public:
  Chooser(std::vector<KindForms>& kinds, double budget) : kinds_(kinds), step_(budget / kByteSteps) {
    for (size_t i = 0; i < kinds.size(); ++i) {
      const FormKind& kind = kinds[i].kind;
      if (kind.level >= levels_.size()) levels_.resize(kind.level + 1);
      (kind.leaf ? levels_[kind.level].leaf : levels_[kind.level].inner) = i;
    }
    tables_.resize(levels_.size());
    for (size_t level = levels_.size(); level-- > 0;) fill(level);
  }

  // With so many steps of bytes.
  double error(size_t steps) const { return tables_[0][0][steps].error; }
  // Of every kind, into `chosen`.
  void take(size_t steps) {
    size_t reach = 0;
    for (size_t level = 0; level < levels_.size(); ++level) {
      const Best& best = tables_[level][reach][steps];
      const auto [inner, leaf] = levels_[level];
      if (leaf) kinds_[*leaf].chosen = best.leaf;
      if (!inner) return;
      kinds_[*inner].chosen = best.inner;
      steps -= stepsOf(inner, best.inner) + stepsOf(leaf, best.leaf);
      reach = sizeOf(best.inner);
    }
  }

 private:
  // Of this level and all below it.
  struct Best {
    double error = std::numeric_limits<double>::infinity();
    size_t inner = 0, leaf = 0;
  };
  using Table = std::array<std::vector<Best>, kSizes>;  // by the parents' image size, then steps

  static int fromPixels(size_t reach) { return kCandidateSizes[reach] / 4; }

  size_t stepsOf(std::optional<size_t> kind, size_t candidate) const {
    if (!kind) return 0;
    const double bytes = static_cast<double>(kinds_[*kind].cells) * kinds_[*kind].means.bytes[candidate];
    return static_cast<size_t>(std::min(std::ceil(bytes / step_), 4.0 * kByteSteps));
  }
  double innerError(size_t kind, size_t candidate, size_t reach) const {
    return kinds_[kind].share * errorOfViews(kinds_[kind].means, candidate, fromPixels(reach));
  }
  double leafError(size_t kind, size_t candidate, size_t reach) const {
    const int end = std::max(kCandidateSizes[sizeOf(candidate)] / 2, fromPixels(reach));
    return kinds_[kind].share *
           (errorOfViews(kinds_[kind].means, candidate, fromPixels(reach)) + errorOfTriangles(kinds_[kind].means, end));
  }

  void fill(size_t level) {
    const auto [inner, leaf] = levels_[level];
    for (size_t reach = 0; reach < kSizes; ++reach) {
      std::vector<Best>& table = tables_[level][reach];
      table.resize(kByteSteps + 1);
      for (size_t i = 0; i < (inner ? kCandidates : 1); ++i)
        for (size_t j = 0; j < (leaf ? kCandidates : 1); ++j) {
          if ((inner && sizeOf(i) < reach) || (leaf && sizeOf(j) < reach)) continue;
          const double own = (inner ? innerError(*inner, i, reach) : 0) + (leaf ? leafError(*leaf, j, reach) : 0);
          const size_t taken = stepsOf(inner, i) + stepsOf(leaf, j);
          for (size_t steps = taken; steps <= kByteSteps; ++steps) {
            const bool deeper = inner && level + 1 < levels_.size();
            const double below = deeper ? tables_[level + 1][sizeOf(i)][steps - taken].error : 0;
            if (own + below < table[steps].error) table[steps] = {own + below, i, j};
          }
        }
    }
  }

  std::vector<KindForms>& kinds_;
  const double step_;
  std::vector<Level> levels_;
  std::vector<Table> tables_;
};

// Kinds, how many cells they have and what they share of the picture: at each level the leaves, and all that lies below
// the inner cells.
std::vector<KindForms> kindsOf(std::span<const CellRecord> cells, const std::vector<bool>& hasViews) {
  std::map<FormKind, std::pair<uint64_t, double>> sums;
  for (size_t i = 0; i < cells.size(); ++i) {
    if (!hasViews[i]) continue;
    auto& [count, area] = sums[kindOf(cells[i])];
    ++count;
    area += areaOf(cells[i].content);
  }
  std::vector<KindForms> kinds;
  double below = 1;
  for (const auto& [kind, sum] : sums) {
    const auto leaves = sums.find({kind.level, true});
    const double leafArea = leaves != sums.end() ? leaves->second.second : 0;
    if (kind.leaf) {
      const auto inner = sums.find({kind.level, false});
      const double all = leafArea + (inner != sums.end() ? inner->second.second : 0);
      kinds.push_back({.kind = kind, .cells = sum.first, .share = all > 0 ? below * leafArea / all : 0, .means = {}});
      below -= kinds.back().share;
    } else {
      const double all = leafArea + sum.second;
      kinds.push_back({.kind = kind, .cells = sum.first, .share = all > 0 ? below * sum.second / all : 0, .means = {}});
    }
  }
  return kinds;
}

// Of the kind itself; else of the nearest level, deeper before higher, of the same sort before the other.
const Sums& sumsLike(FormKind kind, const std::map<FormKind, Sums>& sums) {
  const auto distance = [&](const FormKind& other) {
    const int levels = static_cast<int>(other.level) - static_cast<int>(kind.level);
    return 4 * std::abs(levels) + (levels < 0 ? 2 : 0) + (other.leaf != kind.leaf ? 1 : 0);
  };
  return std::min_element(sums.begin(), sums.end(),
                          [&](const auto& a, const auto& b) { return distance(a.first) < distance(b.first); })
      ->second;
}

FormsPoint pointOf(const std::vector<KindForms>& kinds, const Chooser& chooser, size_t steps) {
  FormsPoint point{0, chooser.error(steps)};
  for (const KindForms& kind : kinds) point.bytes += static_cast<double>(kind.cells) * kind.means.bytes[kind.chosen];
  return point;
}

// All kinds of one form.
FormsPoint fixedPoint(const std::vector<KindForms>& kinds, size_t candidate) {
  FormsPoint point;
  for (const KindForms& kind : kinds) {
    const int from = kind.kind.level == 0 ? kPictureEdges[0] : kCandidateSizes[sizeOf(candidate)] / 4;
    point.bytes += static_cast<double>(kind.cells) * kind.means.bytes[candidate];
    point.error += kind.share * errorOfViews(kind.means, candidate, from);
    if (kind.kind.leaf)
      point.error += kind.share * errorOfTriangles(kind.means, kCandidateSizes[sizeOf(candidate)] / 2);
  }
  return point;
}

}  // namespace

ChosenForms chooseForms(const Model& model, std::span<const CellRecord> cells, const std::vector<bool>& hasViews,
                        const std::map<uint32_t, CellCandidates>& measured) {
  ChosenForms result;
  std::map<FormKind, Sums> sums;
  for (const auto& [cell, candidates] : measured) sums[kindOf(cells[cell])].add(candidates);
  if (sums.empty()) return result;
  size_t settings = 0;
  while (settings < kCandidates && candidateForm(settings) != model.settings.form) ++settings;
  FARCELL_CHECK(settings < kCandidates);
  result.kinds = kindsOf(cells, hasViews);
  for (KindForms& kind : result.kinds) {
    const auto own = sums.find(kind.kind);
    kind.measured = own != sums.end() ? own->second.cells : 0;
    kind.means = sumsLike(kind.kind, sums).means();
  }
  result.fixed = fixedPoint(result.kinds, settings);
  Chooser chooser(result.kinds, result.fixed.bytes);
  for (size_t point = 1; point <= kPoints; ++point) {
    const size_t steps = kByteSteps * point / kPoints;
    if (std::isinf(chooser.error(steps))) continue;
    chooser.take(steps);
    const FormsPoint found = pointOf(result.kinds, chooser, steps);
    if (result.pareto.empty() || found.error < result.pareto.back().error) result.pareto.push_back(found);
  }
  FARCELL_CHECK(!result.pareto.empty());
  result.chosen = result.pareto.back();
  return result;
}

}  // namespace farcell
