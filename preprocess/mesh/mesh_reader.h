// Mesh files as streams of triangles. Positions are double until the pipeline makes them cell-local.
//
// What counts as a triangle of the file: a polygon of n corners is n - 2 of them (none below three), as a fan around
// its first corner, concave or not; in a strip, every three indices in a row are one, every other one turned round, and
// those that only join two parts of a strip are left out as zeroArea. One bad index costs the triangles that use it.
//
// A file is opened in one reading (byte_stream.h): vertices are kept in a stated memory (vertices.h, read_memory.h)
// where they cannot be found again in the file, faces are counted and checked, so that a file that contradicts itself
// fails at once. Each pass then streams the faces again and hands them on through triangle_batch.h. (STL has no
// vertices apart from its faces: nothing is kept.)
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "cache/base/result.h"
#include "cache/schema/model.h"
#include "preprocess/mesh/texture_source.h"

namespace farcell {

struct InputTriangle {
  std::array<glm::dvec3, 3> positions;  // as in the file, model units
  std::array<uint32_t, 3> colours;      // 0x00BBGGRR; meaningful when MeshInfo::hasColours
  std::array<glm::vec3, 3> normals;     // as in the file, any length; meaningful when MeshInfo::hasNormals
  // Where a texture is named, its colour is multiplied with `colours`, channel by channel, in display values.
  uint32_t texture = kNoTexture;                // index into MeshReader::textures()
  std::array<glm::vec2, 3> textureCoordinates;  // u to the right, v up from the image's lowest row; with a texture only
};

// What the file's header or first pass tells.
struct MeshInfo {
  bool hasColours = false;  // also when a triangle may name a texture
  bool hasNormals = false;
  uint64_t declaredTriangles = 0;  // after triangulation, where the format declares it or a first pass counted it
  uint64_t vertices = 0;
  std::string format;        // for people: "PLY, ASCII"
  UpAxis up = UpAxis::z;     // as the format has it, or the file says
  double metresPerUnit = 1;  // likewise
};

// What a pass over the triangles found: accepted + sum of skipped == every triangle the file holds.
struct MeshCounts {
  uint64_t accepted = 0;
  std::map<std::string, uint64_t> skipped;  // triangles, by reason (names below)
};
// Reasons, shared by all formats.
inline constexpr const char* kSkippedNonFinite = "nonFinitePosition";  // NaN or infinity
inline constexpr const char* kSkippedZeroArea = "zeroArea";            // zero_area.h: exactly none; slivers are kept
inline constexpr const char* kSkippedBadIndex = "indexOutOfRange";

// An opened mesh. `forEachTriangle` may be called any number of times and gives the same triangles in the same order;
// after a file that was read changed, or scratch failed, an error. For one thread.
class MeshReader {
 public:
  virtual ~MeshReader() = default;
  virtual const MeshInfo& info() const = 0;
  // What InputTriangle::texture names; empty when the mesh has none.
  virtual std::span<const TextureSource> textures() const { return {}; }
  // Every file that triangles and their looks come from, the opened one first; each once.
  virtual std::vector<std::filesystem::path> files() const = 0;
  // Batches of at most 64 Ki accepted triangles, valid during the call. The sink's error ends the pass and is returned.
  using Sink = std::function<Result<>(std::span<const InputTriangle>)>;
  virtual Result<MeshCounts> forEachTriangle(const Sink& sink) = 0;
};

}  // namespace farcell
