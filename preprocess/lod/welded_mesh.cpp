#include "preprocess/lod/welded_mesh.h"

#include <algorithm>
#include <bit>

namespace farcell::lod {
namespace {

constexpr uint32_t kNone = UINT32_MAX;
constexpr size_t kMaxVertices = size_t{1} << 30;  // of all children

uint64_t mixed(uint64_t value) {
  value ^= value >> 32;
  value *= 0x9e3779b97f4a7c15ull;
  return value ^ value >> 29;
}

// Numbers keys in the order they come; open addressing.
template <class Key, class Hash>
class Numbering {
 public:
  explicit Numbering(size_t most) : slots_(std::bit_ceil(2 * most + 2), kNone) { keys_.reserve(most); }

  uint32_t number(const Key& key) {
    for (size_t slot = Hash()(key) & (slots_.size() - 1);; slot = (slot + 1) & (slots_.size() - 1)) {
      uint32_t& entry = slots_[slot];
      if (entry == kNone) {
        entry = static_cast<uint32_t>(keys_.size());
        keys_.push_back(key);
        return entry;
      }
      if (keys_[entry] == key) return entry;
    }
  }
  std::vector<Key> take() { return std::move(keys_); }

 private:
  std::vector<uint32_t> slots_;
  std::vector<Key> keys_;
};

struct PointHash {
  size_t operator()(const GridPoint& p) const {
    return mixed(static_cast<uint64_t>(p.x) ^ static_cast<uint64_t>(p.y) << 20 ^ static_cast<uint64_t>(p.z) << 40);
  }
};

struct Vertex {
  uint32_t place, colour, normal;
  bool operator==(const Vertex&) const = default;
};
struct VertexHash {
  size_t operator()(const Vertex& v) const {
    return mixed(v.place ^ mixed(v.colour | static_cast<uint64_t>(v.normal) << 32));
  }
};

bool inside(const GridBox& box, GridPoint point) {
  for (int axis = 0; axis < 3; ++axis)
    if (point[axis] < box.min[axis] || point[axis] > box.max[axis]) return false;
  return true;
}

Result<> checkChild(const GridBox& box, const LodMesh& child, const LodMesh& first, size_t number) {
  const size_t vertices = child.positions.size();
  const auto attribute = [&](const char* name, size_t count, size_t countOfFirst) -> Result<> {
    if (count == (countOfFirst == 0 ? 0 : vertices)) return {};
    return fail(ErrorKind::invalidArgument, "child {}: expected {} {} as its siblings have, found {}", number,
                countOfFirst == 0 ? 0 : vertices, name, count);
  };
  FARCELL_TRY(attribute("colours", child.colours.size(), first.colours.size()));
  FARCELL_TRY(attribute("normals", child.normals.size(), first.normals.size()));
  if (!child.shown.empty() && child.shown.size() != child.triangles())
    return fail(ErrorKind::invalidArgument, "child {}: expected a colour for each of {} triangles, found {}", number,
                child.triangles(), child.shown.size());
  if (child.indices.size() % 3 != 0)
    return fail(ErrorKind::invalidArgument, "child {}: expected three indices a triangle, found {} in all", number,
                child.indices.size());
  for (const uint32_t index : child.indices)
    if (index >= vertices)
      return fail(ErrorKind::invalidArgument, "child {}: expected indices below {}, found {}", number, vertices, index);
  for (const GridPoint& p : child.positions)
    if (!inside(box, p))
      return fail(ErrorKind::invalidArgument, "child {}: expected positions inside the cell, found ({}, {}, {})",
                  number, p.x, p.y, p.z);
  return {};
}

Result<> checkChildren(const GridBox& box, std::span<const LodMesh> children) {
  const LodMesh none;
  const LodMesh* first = &none;
  size_t vertices = 0, triangles = 0;
  for (size_t i = 0; i < children.size(); ++i) {
    if (children[i].positions.empty() && children[i].indices.empty()) continue;
    if (first == &none) first = &children[i];
    FARCELL_TRY(checkChild(box, children[i], *first, i));
    vertices += children[i].positions.size();
    triangles += children[i].triangles();
  }
  if (vertices > kMaxVertices || triangles > kMaxVertices)
    return fail(ErrorKind::exhausted,
                "expected at most {} vertices and triangles in a cell's children, found {} and {}", kMaxVertices,
                vertices, triangles);
  return {};
}

uint8_t facesOf(const GridBox& box, GridPoint point) {
  int faces = 0;
  for (int axis = 0; axis < 3; ++axis)
    faces |= (point[axis] == box.min[axis] ? 1 : 0) << 2 * axis | (point[axis] == box.max[axis] ? 2 : 0) << 2 * axis;
  return static_cast<uint8_t>(faces);
}

}  // namespace

Result<WeldedMesh> weld(const GridBox& box, std::span<const LodMesh> children) {
  FARCELL_TRY(checkChildren(box, children));
  size_t inputVertices = 0, inputTriangles = 0;
  bool colours = false, normals = false;
  for (const LodMesh& child : children) {
    inputVertices += child.positions.size();
    inputTriangles += child.triangles();
    colours |= !child.colours.empty();
    normals |= !child.normals.empty();
  }
  WeldedMesh mesh;
  mesh.box = box;
  mesh.triangles.reserve(inputTriangles);
  mesh.corners.reserve(inputTriangles);
  Numbering<GridPoint, PointHash> places(inputVertices);
  Numbering<Vertex, VertexHash> vertices(inputVertices);
  std::vector<uint32_t> placeOf, vertexOf;  // of a child's vertices
  for (const LodMesh& child : children) {
    placeOf.clear();
    vertexOf.clear();
    for (size_t i = 0; i < child.positions.size(); ++i) {
      placeOf.push_back(places.number(child.positions[i]));
      vertexOf.push_back(
          vertices.number({placeOf[i], colours ? child.colours[i] & 0xffffff : 0, normals ? child.normals[i] : 0}));
    }
    for (size_t i = 0; i < child.indices.size(); i += 3) {
      const uint32_t a = child.indices[i], b = child.indices[i + 1], c = child.indices[i + 2];
      if (placeOf[a] == placeOf[b] || placeOf[b] == placeOf[c] || placeOf[c] == placeOf[a]) continue;
      mesh.triangles.push_back({placeOf[a], placeOf[b], placeOf[c]});
      mesh.corners.push_back({vertexOf[a], vertexOf[b], vertexOf[c]});
      mesh.shown.push_back(child.shown.empty() ? kAsCorners : child.shown[i / 3]);
    }
  }
  mesh.places = places.take();
  for (const GridPoint& place : mesh.places) mesh.faces.push_back(facesOf(box, place));
  for (const Vertex& vertex : vertices.take()) {
    mesh.placeOfVertex.push_back(vertex.place);
    if (colours) mesh.colours.push_back(vertex.colour);
    if (normals) mesh.normals.push_back(vertex.normal);
  }
  return mesh;
}

}  // namespace farcell::lod
