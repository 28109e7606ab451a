#include "preprocess/mesh/triangle_batch.h"

#include <cmath>

#include "preprocess/mesh/zero_area.h"

namespace farcell {
namespace {
const Vertices kNoVertices;
constexpr size_t kBatchTriangles = 2048;  // 240 KiB: still in the cache when the sink reads them

bool isFinite(glm::dvec3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }
}  // namespace

TriangleBatch::TriangleBatch(const Vertices& vertices, const MeshReader::Sink& sink)
    : vertices_(vertices),
      sink_(sink),
      vertexCount_(vertices.count()),
      defaultColour_(defaultColour()),
      triangles_(kBatchTriangles) {}

TriangleBatch::TriangleBatch(const MeshReader::Sink& sink) : TriangleBatch(kNoVertices, sink) {}

// The corners' positions; false, and counted, when the triangle must be left out.
bool TriangleBatch::gather(const Indices& positions, std::array<glm::dvec3, 3>& out) {
  if (positions[0] >= vertexCount_ || positions[1] >= vertexCount_ || positions[2] >= vertexCount_) {
    ++badIndex_;
    return false;
  }
  for (size_t i = 0; i < 3; ++i) out[i] = vertices_.position(positions[i]);
  return isUsable(out, vertices_.allFinite);
}

bool TriangleBatch::isUsable(const std::array<glm::dvec3, 3>& positions, bool areFinite) {
  if (!areFinite && !(isFinite(positions[0]) && isFinite(positions[1]) && isFinite(positions[2]))) {
    ++nonFinite_;
    return false;
  }
  if (hasZeroArea(positions)) {
    ++zeroArea_;
    return false;
  }
  return true;
}

void TriangleBatch::add(const Indices& positions, const Indices& normals, uint32_t faceColour) {
  InputTriangle& triangle = triangles_[used_];
  if (failed() || !gather(positions, triangle.positions)) return;
  for (size_t i = 0; i < 3; ++i) {
    const uint32_t colour = vertices_.colours.empty() ? kNoColour : vertices_.colours[positions[i]];
    triangle.colours[i] = colour == kNoColour ? faceColour : colour;
    triangle.normals[i] = normals[i] < vertices_.normals.size() ? vertices_.normals[normals[i]] : glm::vec3(0);
  }
  take();
}

void TriangleBatch::add(const InputTriangle& triangle) {
  if (failed() || !isUsable(triangle.positions, false)) return;
  triangles_[used_] = triangle;
  take();
}

void TriangleBatch::take() {
  ++accepted_;
  if (++used_ == kBatchTriangles) flush();
}

void TriangleBatch::flush() {
  if (used_ == 0) return;
  if (Result<> taken = sink_(std::span(triangles_).first(used_)); !taken) failure_ = std::move(taken).error();
  used_ = 0;
}

Result<MeshCounts> TriangleBatch::finish() {
  if (!failed()) flush();
  if (failed()) return tl::unexpected<Error>(*failure_);
  MeshCounts counts;
  counts.accepted = accepted_;
  if (badIndex_ > 0) counts.skipped[kSkippedBadIndex] = badIndex_;
  if (nonFinite_ > 0) counts.skipped[kSkippedNonFinite] = nonFinite_;
  if (zeroArea_ > 0) counts.skipped[kSkippedZeroArea] = zeroArea_;
  return counts;
}

}  // namespace farcell
