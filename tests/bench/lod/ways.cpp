#include "tests/bench/lod/ways.h"

#include <meshoptimizer.h>

#include <numeric>

#include "preprocess/lod/collapse.h"
#include "preprocess/lod/mesh_distance.h"
#include "preprocess/lod/output.h"

namespace farcell::bench {
namespace {

using lod::Reduction;
using lod::WeldedMesh;

Result<SimplifiedCell> finished(const WeldedMesh& mesh, const Reduction& reduction, double childrenErrorSteps) {
  const lod::Surface full{mesh.places, mesh.triangles}, reduced{reduction.places, reduction.triangles};
  std::vector<uint32_t> same(mesh.places.size());
  std::iota(same.begin(), same.end(), 0u);
  SimplifiedCell cell{lod::outputMesh(mesh, reduction), 0, {}};
  const double there = lod::greatestDistanceSteps(full, reduced, reduction.targets);
  cell.errorSteps = childrenErrorSteps + lod::greatestDistanceSteps(reduced, full, same, there);
  cell.figures.childTriangles = mesh.triangles.size();
  return cell;
}

// Collapses alone, down to the target.
Reduction collapsed(const WeldedMesh& mesh, uint64_t target) {
  lod::Collapser collapser(mesh);
  const std::vector<float> unlimited(mesh.places.size(), INFINITY);
  while (collapser.triangles().size() > target && collapser.pass(target, unlimited)) {
  }
  return {mesh.places, collapser.triangles(), collapser.origins(), collapser.targets()};
}

// meshoptimizer gives no origins: a corner takes the first triangle of its place.
Reduction ofIndices(const WeldedMesh& mesh, std::span<const unsigned> indices) {
  std::vector<uint32_t> triangleOf(mesh.places.size());
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (const uint32_t place : mesh.triangles[t]) triangleOf[place] = t;
  Reduction reduction{mesh.places, {}, {}, {}};
  for (size_t i = 0; i < indices.size(); i += 3) {
    reduction.triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
    reduction.origins.push_back(triangleOf[indices[i]]);
  }
  reduction.targets.resize(mesh.places.size());
  std::iota(reduction.targets.begin(), reduction.targets.end(), 0u);
  return reduction;
}

Reduction byMeshoptimizer(const WeldedMesh& mesh, uint64_t target, bool sloppy) {
  std::vector<glm::vec3> positions;
  for (const GridPoint& place : mesh.places) positions.emplace_back(place - mesh.box.min);
  target = std::min<uint64_t>(target, mesh.triangles.size());  // it aborts where there is nothing to do
  std::vector<unsigned> result(3 * mesh.triangles.size());
  const unsigned* indices = mesh.triangles[0].data();
  if (sloppy)
    result.resize(meshopt_simplifySloppy(result.data(), indices, result.size(), &positions[0].x, positions.size(),
                                         sizeof(glm::vec3), 3 * target, 1.0f, nullptr));
  else
    result.resize(meshopt_simplify(result.data(), indices, result.size(), &positions[0].x, positions.size(),
                                   sizeof(glm::vec3), 3 * target, 1.0f, 0, nullptr));
  return ofIndices(mesh, result);
}

template <class Reduce>
Way way(const std::string& name, const Reduce& reduce) {
  return {name,
          [reduce](const Grid& grid, const CellKey& cell, std::span<const LodMesh> children, double error,
                   uint64_t target) -> Result<SimplifiedCell> {
            FARCELL_ASSIGN(const WeldedMesh mesh, lod::weld(cellBox(grid, cell), children));
            return finished(mesh, reduce(mesh, target), error);
          }};
}

Way product(const std::string& name, Simplifier simplifier) {
  return {name, [simplifier](const Grid& grid, const CellKey& cell, std::span<const LodMesh> children, double error,
                             uint64_t target) {
            LodSettings settings;
            settings.targetTriangles = target;
            settings.simplifier = simplifier;
            return simplifyCell(grid, cell, children, error, settings);
          }};
}

}  // namespace

std::vector<Way> ways() {
  return {product("farcell", Simplifier::collapse), product("openmesh", Simplifier::openmesh),
          way("collapses only", collapsed),
          way("meshopt_simplify",
              [](const WeldedMesh& mesh, uint64_t target) { return byMeshoptimizer(mesh, target, false); }),
          way("meshopt_simplifySloppy",
              [](const WeldedMesh& mesh, uint64_t target) { return byMeshoptimizer(mesh, target, true); })};
}

}  // namespace farcell::bench
