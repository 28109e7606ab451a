// What each triangle of a simplified mesh shows: the mean colour, lit, of the surface that it stands for. A triangle's
// own normal is that of a smoother shape, which is brighter or darker than the rough one it replaces.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "preprocess/lod/reduction.h"

namespace farcell::lod {

// One a triangle of the reduction, as in GeometryPage::shown. The mesh has flat faces; sun: unit, world axes.
std::vector<uint32_t> shownColours(const WeldedMesh& mesh, const Reduction& reduction, glm::vec3 sun);

}  // namespace farcell::lod
