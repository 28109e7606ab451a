#include "preprocess/lod/simplify_cell.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "preprocess/lod/mesh_distance.h"
#include "preprocess/lod/openmesh.h"
#include "preprocess/lod/output.h"
#include "preprocess/lod/reduction.h"
#include "preprocess/lod/seams.h"
#include "preprocess/lod/shown.h"
#include "preprocess/lod/welded_mesh.h"

namespace farcell {
namespace {

// Of the target: what is not locked may have as much, however much is locked. With less, shapes that cannot go would be
// crushed to make room for what has to stay.
constexpr uint64_t kLeastFreeDivisor = 2;

Result<> checkArguments(const Grid& grid, const CellKey& cell, double childrenErrorSteps) {
  if (static_cast<int>(cell.level) >= grid.bits)
    return fail(ErrorKind::invalidArgument, "expected a cell above level {}, found {}", grid.bits, cell.level);
  if (!(childrenErrorSteps >= 0 && std::isfinite(childrenErrorSteps)))
    return fail(ErrorKind::invalidArgument, "expected an error of at least 0 steps, found {}", childrenErrorSteps);
  return {};
}

double areaOf(const lod::Surface& surface) {
  double sum = 0;
  for (const lod::Triangle& t : surface.triangles) {
    const glm::dvec3 a(surface.places[t[0]]);
    sum += glm::length(glm::cross(glm::dvec3(surface.places[t[1]]) - a, glm::dvec3(surface.places[t[2]]) - a));
  }
  return sum;
}

uint64_t lockedTriangles(const lod::WeldedMesh& mesh) {
  uint64_t count = 0;
  for (const lod::Triangle& t : mesh.triangles) {
    const uint8_t a = mesh.faces[t[0]], b = mesh.faces[t[1]], c = mesh.faces[t[2]];
    count += (a & b) != 0 || (b & c) != 0 || (c & a) != 0;
  }
  return count;
}

double errorSteps(const lod::Surface& children, const lod::Surface& result, const lod::Reduction& reduction) {
  if (result.triangles.size() == children.triangles.size()) return 0;  // none was collapsed or taken away
  std::vector<uint32_t> same(reduction.places.size());
  std::iota(same.begin(), same.end(), 0u);
  const double there = lod::greatestDistanceSteps(children, result, reduction.targets);
  return lod::greatestDistanceSteps(result, children, same, there);
}

}  // namespace

Result<SimplifiedCell> simplifyCell(const Grid& grid, const CellKey& cell, std::span<const LodMesh> children,
                                    double childrenErrorSteps, const LodSettings& settings) {
  FARCELL_TRY(checkArguments(grid, cell, childrenErrorSteps));
  FARCELL_ASSIGN(lod::WeldedMesh mesh, lod::weld(cellBox(grid, cell), children));
  lod::closeSeams(mesh);
  const uint64_t locked = lockedTriangles(mesh);
  const uint64_t target = std::max(settings.targetTriangles, locked + settings.targetTriangles / kLeastFreeDivisor);
  std::optional<lod::Reduction> byOpenMesh;
  if (settings.simplifier == Simplifier::openmesh) byOpenMesh = lod::reduceByOpenMesh(mesh, target);
  const lod::Reduction reduction = byOpenMesh ? std::move(*byOpenMesh) : lod::reduce(mesh, target);
  const lod::Surface full{mesh.places, mesh.triangles}, reduced{reduction.places, reduction.triangles};
  SimplifiedCell result{
      lod::outputMesh(mesh, reduction), childrenErrorSteps + errorSteps(full, reduced, reduction), {}};
  if (settings.sun && mesh.normals.empty()) result.mesh.shown = lod::shownColours(mesh, reduction, *settings.sun);
  result.figures.childTriangles = mesh.triangles.size();
  result.figures.lockedTriangles = locked;
  result.figures.parts = reduction.parts;
  result.figures.partsTaken = reduction.partsTaken;
  if (const double area = areaOf(full); area > 0) result.figures.areaKept = areaOf(reduced) / area;
  result.figures.fellBack = settings.simplifier == Simplifier::openmesh && !byOpenMesh;
  result.figures.aboveTarget = reduction.triangles.size() > settings.targetTriangles;
  return result;
}

}  // namespace farcell
