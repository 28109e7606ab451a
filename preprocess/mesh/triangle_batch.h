// Where every reader puts its triangles: classifies them, counts what is left out, hands on the rest in batches.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "preprocess/mesh/mesh_reader.h"
#include "preprocess/mesh/vertices.h"

namespace farcell {

class TriangleBatch {
 public:
  using Indices = std::array<uint64_t, 3>;  // a negative index of the file, cast, is out of range like any other

  // Both must outlive the batch.
  TriangleBatch(const Vertices& vertices, const MeshReader::Sink& sink);
  // For triangles that are complete: no index names a vertex.
  explicit TriangleBatch(const MeshReader::Sink& sink);

  // Normals are those of the same indices. After failed() triangles are ignored.
  void add(const Indices& positions) { add(positions, positions, defaultColour_); }
  // Normal indices out of range give a zero normal; faceColour is for corners whose vertex has none.
  void add(const Indices& positions, const Indices& normals, uint32_t faceColour);
  void add(const InputTriangle& triangle);  // complete
  void skipBadIndex() { ++badIndex_; }      // a triangle whose vertices its reader did not find
  bool failed() const { return failure_.has_value(); }
  // Hands on what is left. The counts, or the error of the sink.
  Result<MeshCounts> finish();

 private:
  bool gather(const Indices& positions, std::array<glm::dvec3, 3>& out);
  bool isUsable(const std::array<glm::dvec3, 3>& positions, bool areFinite);
  void take();
  void flush();

  const Vertices& vertices_;
  const MeshReader::Sink& sink_;
  const uint64_t vertexCount_;
  const uint32_t defaultColour_;
  std::vector<InputTriangle> triangles_;
  size_t used_ = 0;
  uint64_t accepted_ = 0;
  uint64_t badIndex_ = 0;
  uint64_t nonFinite_ = 0;
  uint64_t zeroArea_ = 0;
  std::optional<Error> failure_;
};

}  // namespace farcell
