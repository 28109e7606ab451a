#include "cache/pack/connectivity.h"

#include <algorithm>
#include <array>

#include "cache/base/check.h"
#include "cache/pack/words.h"

namespace farcell {
namespace {

using Triangle = std::array<uint32_t, 3>;

// The edges met last; age 0 is the newest.
class EdgeList {
 public:
  struct Edge {
    uint32_t from = 0;
    uint32_t to = 0;
    uint32_t opposite = 0;  // the third corner of the triangle it was met in
  };

  uint32_t size() const { return size_; }
  const Edge& at(uint32_t age) const { return edges_[(newest_ - age) % kEdgeListSize]; }

  // The code of the newest edge that the triangle has, or kNoSharedEdge.
  uint8_t find(const Triangle& corners) const {
    for (uint32_t age = 0; age < size_; ++age)
      for (uint32_t rotation = 0; rotation < 3; ++rotation)
        if (at(age).from == corners[rotation] && at(age).to == corners[(rotation + 1) % 3])
          return static_cast<uint8_t>(3 * age + rotation);
    return kNoSharedEdge;
  }

  // `corners` starts with the shared edge, if there is one.
  void add(const Triangle& corners, bool shared) {
    if (!shared) push({corners[1], corners[0], corners[2]});
    push({corners[2], corners[1], corners[0]});
    push({corners[0], corners[2], corners[1]});
  }

 private:
  void push(Edge edge) {
    edges_[++newest_ % kEdgeListSize] = edge;
    size_ = std::min(size_ + 1, kEdgeListSize);
  }

  std::array<Edge, kEdgeListSize> edges_;
  uint32_t newest_ = kEdgeListSize;
  uint32_t size_ = 0;
};

// Position i of the result is corner i + rotation of the triangle.
Triangle rotated(const Triangle& corners, uint32_t rotation) {
  return {corners[rotation], corners[(rotation + 1) % 3], corners[(rotation + 2) % 3]};
}

Triangle triangleAt(std::span<const uint32_t> indices, size_t first) {
  return {indices[first], indices[first + 1], indices[first + 2]};
}

Parallelogram across(const EdgeList::Edge& edge) { return {edge.from, edge.to, edge.opposite}; }

uint32_t rotationOf(uint8_t code) { return code == kNoSharedEdge ? 0 : code % 3; }

}  // namespace

ConnectivityCodes codedTriangles(std::span<const uint32_t> indices, size_t vertexCount) {
  FARCELL_CHECK(indices.size() % 3 == 0);
  ConnectivityCodes codes;
  codes.triangles.reserve(indices.size() / 3);
  codes.corners.reserve(indices.size());
  codes.parallelograms.resize(vertexCount);
  EdgeList edges;
  uint32_t next = 0;
  for (size_t first = 0; first < indices.size(); first += 3) {
    const uint8_t code = edges.find(triangleAt(indices, first));
    const bool shared = code != kNoSharedEdge;
    const Triangle corners = rotated(triangleAt(indices, first), rotationOf(code));
    codes.triangles.push_back(code);
    if (shared && corners[2] == next) codes.parallelograms[next] = across(edges.at(code / 3u));
    for (size_t i = shared ? 2 : 0; i < 3; ++i) {
      codes.corners.push_back(zigzag(next - corners[i], 32));
      next = std::max(next, corners[i] + 1);
    }
    edges.add(corners, shared);
  }
  return codes;
}

Result<size_t> cornerCount(std::span<const std::byte> triangleCodes) {
  size_t count = 0;
  for (const std::byte code : triangleCodes) {
    if (code > std::byte{kNoSharedEdge})
      return fail(ErrorKind::corrupt, "expected triangle codes up to {}, found {}", kNoSharedEdge,
                  std::to_integer<uint32_t>(code));
    count += code == std::byte{kNoSharedEdge} ? 3 : 1;
  }
  return count;
}

Result<DecodedTriangles> decodedTriangles(std::span<const std::byte> triangleCodes, std::span<const uint32_t> corners,
                                          uint32_t vertexCount) {
  DecodedTriangles result{std::vector<uint32_t>(3 * triangleCodes.size()), Parallelograms(vertexCount)};
  EdgeList edges;
  uint32_t next = 0;
  size_t used = 0;
  for (size_t t = 0; t < triangleCodes.size(); ++t) {
    const auto code = std::to_integer<uint8_t>(triangleCodes[t]);
    const bool shared = code != kNoSharedEdge;
    if (shared && code / 3u >= edges.size())
      return fail(ErrorKind::corrupt, "triangle {}: expected one of {} edges, found {}", t, edges.size(), code / 3);
    Triangle triangle{};
    if (shared) triangle = {edges.at(code / 3u).from, edges.at(code / 3u).to, 0};
    for (size_t i = shared ? 2 : 0; i < 3; ++i) {
      triangle[i] = next - unzigzag(corners[used++], 32);
      if (triangle[i] >= vertexCount)
        return fail(ErrorKind::corrupt, "triangle {}: expected a vertex below {}, found {}", t, vertexCount,
                    triangle[i]);
      if (shared && triangle[i] == next) result.parallelograms[next] = across(edges.at(code / 3u));
      next = std::max(next, triangle[i] + 1);
    }
    edges.add(triangle, shared);
    const Triangle original = rotated(triangle, (3 - rotationOf(code)) % 3);
    std::copy(original.begin(), original.end(), result.indices.begin() + static_cast<ptrdiff_t>(3 * t));
  }
  return result;
}

void rotateForCoding(std::span<uint32_t> indices) {
  EdgeList edges;
  for (size_t first = 0; first < indices.size(); first += 3) {
    const uint8_t code = edges.find(triangleAt(indices, first));
    const Triangle corners = rotated(triangleAt(indices, first), rotationOf(code));
    std::copy(corners.begin(), corners.end(), indices.begin() + static_cast<ptrdiff_t>(first));
    edges.add(corners, code != kNoSharedEdge);
  }
}

}  // namespace farcell
