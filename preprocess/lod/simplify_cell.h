// The mesh of an inner cell, from the meshes of its children. Levels of detail are made bottom-up: the life of one is
//   1. weld (welded_mesh.h): the children, whose shared faces have the same vertices bit for bit, become one mesh, and
//      where children of different depth meet it is closed (seams.h);
//   2. reduce: passes of edge collapses by quadrics (collapse.h); once their error is as large as separate parts, of
//   the
//      small parts some are kept, and enlarged so that the picture grows no thinner (parts.h);
//   3. measure (mesh_distance.h): how far the result is from the children's meshes, both ways.
//
// Vertices on the faces of the cell's own cube stay, and so do the edges between them: whatever cells a cut is made of,
// neighbours fit without a crack, without a rule at run time. They become free in the ancestor whose inside they lie
// in. Where they hold more than half of the target, it is exceeded, which the figures tell: what is inside has half of
// it.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "cache/base/result.h"
#include "cache/schema/model.h"
#include "preprocess/lod/lod_mesh.h"

namespace farcell {

struct LodSettings {
  uint64_t targetTriangles = 16384;  // exceeded by what is locked beyond half of it
  Simplifier simplifier = Simplifier::collapse;
  // Unit, world axes: triangles of flat faces show the mean of what they stand for in this light. Without: the colours
  // of their corners, in any.
  std::optional<glm::vec3> sun{};
};

struct LodFigures {
  uint64_t childTriangles = 0;
  uint64_t lockedTriangles = 0;  // with an edge in a face of the cube: never removed
  uint64_t parts = 0;            // separate ones in the children; 0 when nothing had to go
  uint64_t partsTaken = 0;       // of which others stand for
  double areaKept = 1;           // area of the result / area of the children
  bool aboveTarget = false;
  bool fellBack = false;  // not simplified by OpenMesh, which cannot hold such a mesh
};

struct SimplifiedCell {
  LodMesh mesh;  // vertices in the order of their first use
  // Upper bound of the distance, in grid steps, from the mesh to the full geometry and back, measured at samples
  // (mesh_distance.h): that from the children's meshes plus theirs.
  double errorSteps = 0;
  LodFigures figures;
};

// children: the meshes of the cell's children, in the order of their octants; empty ones may be left out.
// childrenErrorSteps: the largest of their errors; 0 for leaves. Depends on nothing else: not on threads or time.
// invalidArgument for meshes that contradict themselves, each other or the cell's cube.
Result<SimplifiedCell> simplifyCell(const Grid& grid, const CellKey& cell, std::span<const LodMesh> children,
                                    double childrenErrorSteps, const LodSettings& settings);

}  // namespace farcell
