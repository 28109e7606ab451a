#include "preprocess/lod/reduction.h"

#include <cmath>
#include <numeric>

#include "preprocess/lod/collapse.h"
#include "preprocess/lod/parts.h"

namespace farcell::lod {
namespace {

// A part keeps its shape up to this share of the root of its area, at first: then parts have to go.
constexpr double kFirstShapeShare = 0.06;
constexpr double kLastShapeShare = 16;
// Parts of less area than this many squares of the error go.
constexpr double kPartErrors = 60;

Reduction unchanged(const WeldedMesh& mesh) {
  Reduction result{mesh.places, mesh.triangles, std::vector<uint32_t>(mesh.triangles.size()),
                   std::vector<uint32_t>(mesh.places.size())};
  std::iota(result.origins.begin(), result.origins.end(), 0u);
  std::iota(result.targets.begin(), result.targets.end(), 0u);
  return result;
}

}  // namespace

Reduction reduce(const WeldedMesh& mesh, size_t target) {
  if (mesh.triangles.size() <= target) return unchanged(mesh);
  Collapser collapser(mesh);
  Parts parts(mesh);
  double share = kFirstShapeShare;
  std::vector<float> limits = parts.limitsSteps(share);
  while (collapser.triangles().size() > target) {
    if (collapser.pass(target, limits)) {
      const double partSteps = kPartErrors * collapser.errorSteps() * collapser.errorSteps();
      if (parts.anyFree() && collapser.triangles().size() > target) parts.thin(collapser, partSteps, target);
      continue;
    }
    // All that is left would lose its shape: parts go, as few as can be, and then shapes.
    if (parts.anyFree() && parts.thin(collapser, INFINITY, target)) continue;
    if (share >= kLastShapeShare) break;
    share *= 2;
    limits = parts.limitsSteps(share);
  }
  Reduction result{parts.enlarged(collapser.triangles()),
                   collapser.triangles(),
                   collapser.origins(),
                   collapser.targets(),
                   parts.count(),
                   parts.taken()};
  return result;
}

}  // namespace farcell::lod
