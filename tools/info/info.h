// What `farcell info` says, as JSON and as text for people.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "cache/base/result.h"
#include "cache/pack/pack_file.h"
#include "preprocess/mesh/mesh_reader.h"

namespace farcell {

// The shared report (tools/report) and: format{version}, model{source, sourceHash, grid, bounds, up, metresPerUnit,
// hasColours, hasNormals}, settings{...}, levels[{level, leaf, inner, triangles, meshTriangles, geometricErrorMetres}],
// pages{geometry, views}.
// Bounds are in model units, world axes; null when the pack holds no triangle.
nlohmann::ordered_json packInfoJson(const PackFile& pack);

// format, files (their number), input{triangles, vertices, skipped}, declaredTriangles, bounds, up, metresPerUnit,
// hasColours, hasNormals, textures (their number). Reads the whole mesh.
Result<nlohmann::ordered_json> meshInfoJson(MeshReader& mesh);

// Nested keys as indented lines: "  key   value".
std::string infoText(const nlohmann::ordered_json& info);

}  // namespace farcell
