// Object File Format of Geomview (The Geometry Center, 1992): OFF with any of the prefixes ST, C and N, as text.
//
// A vertex or a face a line. Texture coordinates are passed over (the format names no image), and so are indices into
// Geomview's own colour map. Colours are numbers of 0 to 255 or of 0 to 1: a row with a point or an exponent in it is
// of the second kind, one of whole numbers is, too, unless one such row of the file (of its vertices, of its faces) has
// a number above 1.
#pragma once

#include <memory>

#include "cache/base/file.h"
#include "preprocess/mesh/mesh_reader.h"
#include "preprocess/mesh/read_memory.h"

namespace farcell {

// Whether the first word is a header of any kind of OFF file, those included that are not read.
bool startsLikeOff(const InputFile& file);

// Reads the whole file once (vertices are kept, faces counted and checked). unsupported, by name, for binary files and
// those of other dimensions (4OFF, nOFF).
Result<std::unique_ptr<MeshReader>> openOff(InputFile file, const std::shared_ptr<ReadMemory>& memory);

}  // namespace farcell
