#include "preprocess/mesh/triangle_batch.h"

#include <algorithm>
#include <cmath>

namespace farcell {
namespace {
constexpr size_t kBatchTriangles = 1024;  // 152 KiB: still in the cache when the sink reads them

bool isFinite(glm::dvec3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

InputTriangle plain() {
  InputTriangle triangle{};
  triangle.colours.fill(defaultColour());
  return triangle;
}
}  // namespace

TriangleBatch::TriangleBatch(const Vertices& vertices, const MeshReader::Sink& sink)
    : vertices_(&vertices), sink_(sink), vertexCount_(vertices.count()), triangles_(kBatchTriangles, plain()) {}

TriangleBatch::TriangleBatch(const MeshReader::Sink& sink)
    : vertices_(nullptr), sink_(sink), vertexCount_(0), triangles_(kBatchTriangles, plain()) {}

bool TriangleBatch::isUsableExactly(const std::array<glm::dvec3, 3>& positions) {
  if (!(isFinite(positions[0]) && isFinite(positions[1]) && isFinite(positions[2]))) {
    ++nonFinite_;
    return false;
  }
  if (hasZeroAreaExactly(positions)) {
    ++zeroArea_;
    return false;
  }
  return true;
}

void TriangleBatch::add(const Indices& corners, const FaceLook& look, std::span<const glm::vec3> normals) {
  InputTriangle& triangle = triangles_[used_];
  triangle.colours.fill(kNoColour);
  if (!gather(corners, triangle)) return;
  for (uint32_t& colour : triangle.colours)
    if (colour == kNoColour) colour = look.colour;
  if (!normals.empty()) std::copy_n(normals.begin(), 3, triangle.normals.begin());
  triangle.texture = look.texture;
  if (look.texture != kNoTexture) triangle.textureCoordinates = look.textureCoordinates;
  accept();
}

void TriangleBatch::add(const InputTriangle& triangle) {
  if (!isUsable(triangle.positions)) return;
  triangles_[used_] = triangle;
  accept();
}

void TriangleBatch::flush() {
  if (used_ > 0 && !failed())
    if (Result<> taken = sink_(std::span(triangles_).first(used_)); !taken) failure_ = std::move(taken).error();
  used_ = 0;
}

Result<MeshCounts> TriangleBatch::finish() {
  flush();
  if (failure_) return tl::unexpected<Error>(*failure_);
  if (failed()) return tl::unexpected<Error>(*vertices_->failure());
  MeshCounts counts;
  counts.accepted = accepted_;
  if (badIndex_ > 0) counts.skipped[kSkippedBadIndex] = badIndex_;
  if (nonFinite_ > 0) counts.skipped[kSkippedNonFinite] = nonFinite_;
  if (zeroArea_ > 0) counts.skipped[kSkippedZeroArea] = zeroArea_;
  return counts;
}

}  // namespace farcell
