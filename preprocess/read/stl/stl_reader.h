// Stereolithography files (3D Systems, 1989), text and binary. STL shares no vertices: each triangle brings its
// corners, so nothing of the file stays in memory.
//
// Facet normals are passed over: they say no more than the corners, where they are right at all.
#pragma once

#include <memory>

#include "cache/base/file.h"
#include "preprocess/mesh/mesh_reader.h"

namespace farcell {

// Whether the size is 84 bytes and 50 for each of the triangles that bytes 80 to 83 announce: what makes a file a
// binary STL, whatever its 80 bytes of header say (many begin with "solid", as text does).
bool hasBinaryStlSize(const InputFile& file);
// Whether the first word is "solid" in either case.
bool startsLikeTextStl(const InputFile& file);

// Reads the whole file once: text is counted and checked, of binary files only the colours are looked for.
Result<std::unique_ptr<MeshReader>> openStl(InputFile file);

}  // namespace farcell
