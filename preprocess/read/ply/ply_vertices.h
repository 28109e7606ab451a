// The vertex element of a PLY file.
#pragma once

#include <memory>

#include "preprocess/mesh/vertices.h"
#include "preprocess/read/ply/ply_source.h"

namespace farcell {

// All rows of the element, starting at the source's place, which moves behind them. Rows of a binary file that are all
// of one size are left where they are and read when a pass asks for them. Explicitly instantiated for the three
// sources.
template <class Source>
Result<Vertices> readPlyVertices(Source& source, const std::shared_ptr<const InputFile>& file,
                                 const PlyElement& element, const std::shared_ptr<ReadMemory>& memory);

}  // namespace farcell
