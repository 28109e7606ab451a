// The facets of an STL file that is text.
#pragma once

#include <functional>

#include "preprocess/mesh/mesh_reader.h"
#include "preprocess/mesh/text_lines.h"

namespace farcell {

// Calls `take` with the corners of each facet, of any number of solids one after the other, until it returns false.
// Line breaks are blanks like any other, except that the name of a solid ends with its line.
Result<> forEachTextFacet(const InputFile& file, const std::function<bool(const std::array<glm::dvec3, 3>&)>& take);

}  // namespace farcell
