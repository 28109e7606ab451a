// The parts of meshes that are triangles: what they consist of, checked before anything is read.
#pragma once

#include <optional>

#include "preprocess/read/gltf/accessors.h"
#include "preprocess/read/gltf/looks.h"

namespace tinygltf {
struct Primitive;
}

namespace farcell {

enum class Topology : uint8_t { triangles, strip, fan };

struct GltfAttribute {
  uint32_t accessor = kNoAccessor;
  std::optional<uint32_t> dracoId;  // where its bytes are in the Draco part

  bool exists() const { return accessor != kNoAccessor; }
  bool operator==(const GltfAttribute&) const = default;
};

struct GltfPrimitive {
  uint32_t mesh = 0;
  uint32_t number = 0;  // in the mesh
  Topology topology = Topology::triangles;
  bool hasMaterial = false;
  GltfLook look;
  uint32_t plainColour = 0;  // 0x00BBGGRR, display values: of vertices without a colour of their own
  GltfAttribute position;
  GltfAttribute normal;
  GltfAttribute colour;
  GltfAttribute textureCoordinates;  // of the look's texture; without them it has the plain one
  uint32_t indices = kNoAccessor;
  std::optional<uint64_t> dracoView;
  uint64_t vertices = 0;
  uint64_t corners = 0;    // indices, or vertices where there are none
  uint64_t triangles = 0;  // that the corners make
};

// None for points and lines, which no mesh reader declares as triangles, and for what has no positions, which glTF
// says is not drawn.
Result<std::optional<GltfPrimitive>> readPrimitive(const GltfPlace& place, const tinygltf::Primitive& primitive,
                                                   const GltfBuffers& buffers, const GltfAccessors& accessors,
                                                   GltfLooks& looks);

// Where the bytes of a primitive lie; decoded by Draco where they must be.
struct PrimitiveElements {
  Elements position;
  std::optional<Elements> normal;
  std::optional<Elements> colour;
  std::optional<Elements> textureCoordinates;
  std::optional<Elements> indices;
};
Result<PrimitiveElements> elementsOf(const GltfPlace& place, const GltfPrimitive& primitive, GltfBuffers& buffers,
                                     GltfAccessors& accessors);

}  // namespace farcell
