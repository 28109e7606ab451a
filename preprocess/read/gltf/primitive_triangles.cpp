#include "preprocess/read/gltf/primitive_triangles.h"

#include <cstring>
#include <limits>

namespace farcell {
namespace {

// Corners without indices are read once for all instances, a window at a time: soup may be any size.
constexpr uint64_t kWindowVertices = 3 * 16384;

// Puts triangles of vertex numbers into the batch, as they stand in the world.
class TriangleEmitter {
 public:
  TriangleEmitter(const PrimitiveVertices& vertices, const GltfTransform& worldFromMesh, uint32_t texture,
                  TriangleBatch& batch)
      : vertices_(vertices),
        worldFromMesh_(worldFromMesh),
        normalMatrix_(worldFromMesh.normalMatrix()),
        isPlaced_(!worldFromMesh.isIdentity()),
        isMirrored_(worldFromMesh.isMirrored()),
        batch_(batch) {
    triangle_.texture = texture;
    triangle_.colours.fill(vertices.colour);
    triangle_.normals.fill(glm::vec3(0));
    triangle_.textureCoordinates.fill(glm::vec2(0));
  }

  void add(uint64_t a, uint64_t b, uint64_t c) {
    const uint64_t count = vertices_.vertices.count();
    if (a >= count || b >= count || c >= count) {
      batch_.skipBadIndex();
      return;
    }
    setCorner(0, a);
    // A mirror turns what was counter-clockwise; glTF asks for it to face as before.
    setCorner(isMirrored_ ? 2 : 1, b);
    setCorner(isMirrored_ ? 1 : 2, c);
    if (!vertices_.vertices.failure()) batch_.add(triangle_);
  }
  bool failed() const { return batch_.failed() || vertices_.vertices.failure(); }

 private:
  void setCorner(size_t corner, uint64_t vertex) {
    vertices_.vertices.copyCorner(vertex, corner, triangle_);
    const glm::dvec3 position = triangle_.positions[corner] / vertices_.divisor;
    triangle_.positions[corner] = isPlaced_ ? worldFromMesh_.linear * position + worldFromMesh_.offset : position;
    if (isPlaced_ && vertices_.vertices.shape().hasNormals)
      triangle_.normals[corner] = turned(triangle_.normals[corner]);
  }
  // Of length 1 where the transform is not none: cofactors of large scales would not fit a float.
  glm::vec3 turned(glm::vec3 normal) const {
    const glm::dvec3 out = normalMatrix_ * glm::dvec3(normal);
    const double length = glm::length(out);
    return length > 0 ? glm::vec3(out / length) : glm::vec3(0);
  }

  const PrimitiveVertices& vertices_;
  const GltfTransform& worldFromMesh_;
  const glm::dmat3 normalMatrix_;
  const bool isPlaced_;
  const bool isMirrored_;
  TriangleBatch& batch_;
  InputTriangle triangle_;
};

// Makes triangles of corners (glTF 2.0, 3.7.2.1).
class Assembler {
 public:
  Assembler(Topology topology, TriangleEmitter& emitter) : topology_(topology), emitter_(emitter) {}

  void corner(uint64_t vertex) {
    if (topology_ == Topology::triangles) {
      if (++length_ == 3) {
        emitter_.add(first_, last_, vertex);
        length_ = 0;
      }
      first_ = last_;
      last_ = vertex;
      return;
    }
    if (length_ >= 2 && length_ % 2 == 1 && topology_ == Topology::strip)
      emitter_.add(last_, first_, vertex);
    else if (length_ >= 2)
      emitter_.add(first_, last_, vertex);
    if (length_ == 0 || topology_ == Topology::strip) first_ = length_ == 0 ? vertex : last_;
    last_ = vertex;
    ++length_;
  }

 private:
  const Topology topology_;
  TriangleEmitter& emitter_;
  uint64_t length_ = 0;
  uint64_t first_ = 0;  // of a fan; of strips and triangles the corner before the last
  uint64_t last_ = 0;
};

template <class T>
Result<> emitIndices(const GltfPlace& place, const Elements& indices, Assembler& assembler,
                     const TriangleEmitter& emitter) {
  uint64_t taken = 0;
  bool restarts = false;
  FARCELL_TRY(forEachElement(indices.bytes, indices.count, indices.stride, sizeof(T), [&](const std::byte* at) {
    T index;
    std::memcpy(&index, at, sizeof(T));
    restarts = index == std::numeric_limits<T>::max();
    if (restarts) return false;
    assembler.corner(index);
    ++taken;
    return !emitter.failed();
  }));
  if (restarts)
    return place.in("indices").bad(fmt::format("indices below {}", std::numeric_limits<T>::max()),
                                   fmt::format("that value, which would restart a strip, as index {}", taken));
  return {};
}

Result<> emitIndexed(const GltfPlace& place, const Elements& indices, Topology topology, TriangleEmitter& emitter) {
  Assembler assembler(topology, emitter);
  if (indices.type == ComponentType::uint8) return emitIndices<uint8_t>(place, indices, assembler, emitter);
  if (indices.type == ComponentType::uint16) return emitIndices<uint16_t>(place, indices, assembler, emitter);
  return emitIndices<uint32_t>(place, indices, assembler, emitter);
}

void emitWindows(const GltfPrimitive& primitive, const PrimitiveVertices& vertices,
                 std::span<const GltfTransform> instances, TriangleBatch& batch) {
  const bool isWhole = primitive.topology != Topology::triangles;
  const uint64_t step = isWhole ? std::max<uint64_t>(1, primitive.vertices) : kWindowVertices;
  for (uint64_t first = 0; first < primitive.vertices && !batch.failed(); first += step) {
    const uint64_t end = first + std::min(step, primitive.vertices - first);
    for (const GltfTransform& instance : instances) {
      TriangleEmitter emitter(vertices, instance, primitive.look.texture, batch);
      Assembler assembler(primitive.topology, emitter);
      for (uint64_t i = first; i < end && !emitter.failed(); ++i) assembler.corner(i);
    }
  }
}

// Whether the vertices of the two are alike in all that primitiveVertices() makes of them.
bool haveSameVertices(const GltfPrimitive& a, const GltfPrimitive& b) {
  return !a.dracoView && !b.dracoView && a.position == b.position && a.normal == b.normal && a.colour == b.colour &&
         a.textureCoordinates == b.textureCoordinates && a.look.factor == b.look.factor &&
         a.look.transform == b.look.transform && a.plainColour == b.plainColour;
}

}  // namespace

void VertexCache::makeRoomFor(const GltfPrimitive& primitive) {
  if (loaded_ && haveSameVertices(*loaded_, primitive)) return;
  loaded_.reset();
  vertices_.reset();
}

Result<const PrimitiveVertices*> VertexCache::load(const PrimitiveElements& elements, const GltfPrimitive& primitive) {
  makeRoomFor(primitive);
  if (loaded_) return &*vertices_;
  FARCELL_ASSIGN(vertices_, primitiveVertices(elements, primitive, memory_));
  loaded_ = primitive;
  return &*vertices_;
}

Result<> emitTriangles(const GltfPlace& place, const GltfPrimitive& primitive, const PrimitiveElements& elements,
                       std::span<const GltfTransform> instances, VertexCache& cache, TriangleBatch& batch) {
  FARCELL_ASSIGN(const PrimitiveVertices* vertices, cache.load(elements, primitive));
  if (!elements.indices) emitWindows(primitive, *vertices, instances, batch);
  for (const GltfTransform& instance : elements.indices ? instances : std::span<const GltfTransform>()) {
    TriangleEmitter emitter(*vertices, instance, primitive.look.texture, batch);
    FARCELL_TRY(emitIndexed(place, *elements.indices, primitive.topology, emitter));
    if (emitter.failed()) break;
  }
  if (vertices->vertices.failure()) return tl::unexpected<Error>(*vertices->vertices.failure());
  return {};
}

}  // namespace farcell
