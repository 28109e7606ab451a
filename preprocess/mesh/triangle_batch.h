// Where every reader puts its triangles: classifies them, counts what is left out, hands on the rest in batches.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "preprocess/mesh/mesh_reader.h"
#include "preprocess/mesh/vertices.h"
#include "preprocess/mesh/zero_area.h"

namespace farcell {

class TriangleBatch {
 public:
  using Indices = std::array<uint64_t, 3>;  // a negative index of the file, cast, is out of range like any other
  struct FaceLook {
    uint32_t colour;  // of corners whose vertex has none
    uint32_t texture = kNoTexture;
    std::array<glm::vec2, 3> textureCoordinates{};
  };

  // Both must outlive the batch.
  TriangleBatch(const Vertices& vertices, const MeshReader::Sink& sink);
  // For triangles that bring their own corners.
  explicit TriangleBatch(const MeshReader::Sink& sink);

  // With what their vertices have, and no other look.
  void add(const Indices& corners) {
    InputTriangle& triangle = triangles_[used_];
    if (gather(corners, triangle)) accept();
  }
  // The colour of the look where a vertex has none.
  void add(const Indices& corners, const FaceLook& look) { add(corners, look, {}); }
  // The same; normals, where there are any, for those of the vertices.
  void add(const Indices& corners, const FaceLook& look, std::span<const glm::vec3> normals);
  // Corners and looks as they are; checks the positions only.
  void add(const InputTriangle& triangle);
  void skipBadIndex() { ++badIndex_; }  // a triangle whose vertices its reader did not find
  // Has the processor fetch the vertices of a triangle that is to come.
  void prefetch(const Indices& corners) const {
    for (const uint64_t corner : corners) vertices_->prefetch(corner);
  }
  // Then what is added is ignored.
  bool failed() const { return failure_.has_value() || (vertices_ && vertices_->failure()); }
  // Hands on what is left. The counts, or the error of the sink or of the vertices.
  Result<MeshCounts> finish();

 private:
  // What the vertices have of a triangle; false, and counted, when it must be left out.
  bool gather(const Indices& corners, InputTriangle& triangle) {
    if (corners[0] >= vertexCount_ || corners[1] >= vertexCount_ || corners[2] >= vertexCount_) {
      ++badIndex_;
      return false;
    }
    for (size_t i = 0; i < 3; ++i) vertices_->copyCorner(corners[i], i, triangle);
    return isUsable(triangle.positions);
  }
  bool isUsable(const std::array<glm::dvec3, 3>& positions) {
    return hasAreaPlainly(positions) || isUsableExactly(positions);
  }
  bool isUsableExactly(const std::array<glm::dvec3, 3>& positions);
  void accept() {
    ++accepted_;
    if (++used_ == triangles_.size()) flush();
  }
  void flush();

  const Vertices* vertices_;
  const MeshReader::Sink& sink_;
  const uint64_t vertexCount_;
  std::vector<InputTriangle> triangles_;
  size_t used_ = 0;
  uint64_t accepted_ = 0;
  uint64_t badIndex_ = 0;
  uint64_t nonFinite_ = 0;
  uint64_t zeroArea_ = 0;
  std::optional<Error> failure_;
};

}  // namespace farcell
