#include "preprocess/read/gltf/primitive.h"

#include <tiny_gltf.h>

#include "preprocess/read/gltf/draco_mesh.h"

namespace farcell {
namespace {

constexpr const char* kDracoExtension = "KHR_draco_mesh_compression";

std::optional<Topology> topologyOf(int mode) {
  if (mode == TINYGLTF_MODE_TRIANGLES) return Topology::triangles;
  if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) return Topology::strip;
  if (mode == TINYGLTF_MODE_TRIANGLE_FAN) return Topology::fan;
  return std::nullopt;
}

// Null where there is none, or this build leaves it: then the accessors may have bytes of their own.
const tinygltf::Value* dracoOf(const tinygltf::Primitive& primitive) {
  const auto found = primitive.extensions.find(kDracoExtension);
  return kHasDraco && found != primitive.extensions.end() ? &found->second : nullptr;
}

// Reads one primitive of the model into `out`.
class PrimitiveCheck {
 public:
  PrimitiveCheck(const GltfPlace& place, const tinygltf::Primitive& from, const GltfAccessors& accessors,
                 GltfPrimitive& out)
      : place_(place), from_(from), accessors_(accessors), draco_(dracoOf(from)), out_(out) {}

  Result<> checkFallback();
  Result<> checkAttributes();
  Result<> checkCorners();
  Result<> checkDraco(const GltfBuffers& buffers);

 private:
  Result<GltfAttribute> attribute(const std::string& name, const AccessorUse& use) const;

  const GltfPlace& place_;
  const tinygltf::Primitive& from_;
  const GltfAccessors& accessors_;
  const tinygltf::Value* draco_;
  GltfPrimitive& out_;
};

Result<GltfAttribute> PrimitiveCheck::attribute(const std::string& name, const AccessorUse& use) const {
  GltfAttribute attribute;
  const auto found = from_.attributes.find(name);
  if (found == from_.attributes.end()) return attribute;
  attribute.accessor = static_cast<uint32_t>(found->second);
  if (draco_ && draco_->Get("attributes").Has(name))
    attribute.dracoId = static_cast<uint32_t>(draco_->Get("attributes").Get(name).GetNumberAsInt());
  const GltfPlace at = place_.in("attributes").in(name);
  FARCELL_ASSIGN(const GltfAccessor* accessor, attribute.dracoId ? accessors_.checkedType(at, attribute.accessor, use)
                                                                 : accessors_.checked(at, attribute.accessor, use));
  if (out_.position.exists() && accessor->count != out_.vertices)
    return at.bad(fmt::format("{} elements, as POSITION has", out_.vertices), std::to_string(accessor->count));
  return attribute;
}

// The bytes that this build cannot read may be all there is.
Result<> PrimitiveCheck::checkFallback() {
  if (draco_ || !from_.extensions.contains(kDracoExtension)) return {};
  for (const auto& [name, accessor] : from_.attributes)
    if (!accessors_.hasBytes(static_cast<uint64_t>(accessor)))
      return place_.failed(ErrorKind::unsupported, "a build with libdraco", kDracoExtension);
  return {};
}

Result<> PrimitiveCheck::checkAttributes() {
  FARCELL_ASSIGN(out_.position, attribute("POSITION", kPositionUse));
  FARCELL_ASSIGN(const GltfAccessor* position, accessors_.checkedType(place_, out_.position.accessor, kPositionUse));
  out_.vertices = position->count;
  FARCELL_ASSIGN(out_.normal, attribute("NORMAL", kNormalUse));
  FARCELL_ASSIGN(out_.colour, attribute("COLOR_0", kColourUse));
  if (!out_.look.hasImage) return {};
  const std::string set = fmt::format("TEXCOORD_{}", out_.look.textureCoordinates);
  FARCELL_ASSIGN(out_.textureCoordinates, attribute(set, kTextureCoordinatesUse));
  return {};
}

Result<> PrimitiveCheck::checkCorners() {
  out_.corners = out_.vertices;
  if (from_.indices >= 0) {
    out_.indices = static_cast<uint32_t>(from_.indices);
    FARCELL_ASSIGN(const GltfAccessor* indices,
                   draco_ ? accessors_.checkedType(place_.in("indices"), out_.indices, kIndicesUse)
                          : accessors_.checked(place_.in("indices"), out_.indices, kIndicesUse));
    out_.corners = indices->count;
  }
  if (out_.topology == Topology::triangles && out_.corners % 3 != 0)
    return place_.bad("three corners for each triangle", fmt::format("{} corners", out_.corners));
  const uint64_t along = out_.corners < 3 ? 0 : out_.corners - 2;
  out_.triangles = out_.topology == Topology::triangles ? out_.corners / 3 : along;
  return {};
}

Result<> PrimitiveCheck::checkDraco(const GltfBuffers& buffers) {
  if (!draco_) return {};
  const GltfPlace at = place_.in("extensions").in(kDracoExtension);
  if (out_.topology != Topology::triangles)
    return at.failed(ErrorKind::unsupported, "mode 4, triangles", "strips or fans");
  if (!out_.position.dracoId || out_.indices == kNoAccessor)
    return at.bad("POSITION among its attributes, and indices", "none");
  out_.dracoView = static_cast<uint64_t>(draco_->Get("bufferView").GetNumberAsInt());
  FARCELL_TRY(buffers.checkedView(at.in("bufferView"), *out_.dracoView));
  return {};
}

// REQUIRES: Draco has decoded it.
const Elements& findDecoded(const DracoMesh& mesh, const GltfAttribute& attribute) {
  const auto found = std::find_if(mesh.attributes.begin(), mesh.attributes.end(),
                                  [&](const DracoAttribute& decoded) { return decoded.id == attribute.dracoId; });
  FARCELL_CHECK(found != mesh.attributes.end());
  return found->elements;
}

Result<DracoMesh> decode(const GltfPlace& place, const GltfPrimitive& primitive, GltfBuffers& buffers,
                         const GltfAccessors& accessors) {
  DracoMesh mesh;
  mesh.points = primitive.vertices;
  mesh.faces = primitive.triangles;
  for (const GltfAttribute& attribute :
       {primitive.position, primitive.normal, primitive.colour, primitive.textureCoordinates})
    if (attribute.dracoId) mesh.attributes.push_back({*attribute.dracoId, accessors.typeOnly(attribute.accessor)});
  FARCELL_ASSIGN(const ByteRange coded, buffers.bytes(*primitive.dracoView));
  FARCELL_TRY(decodeDraco(place.in("extensions").in(kDracoExtension), coded, buffers, mesh));
  return mesh;
}

}  // namespace

Result<std::optional<GltfPrimitive>> readPrimitive(const GltfPlace& place, const tinygltf::Primitive& from,
                                                   const GltfBuffers& buffers, const GltfAccessors& accessors,
                                                   GltfLooks& looks) {
  if (from.mode < TINYGLTF_MODE_POINTS || from.mode > TINYGLTF_MODE_TRIANGLE_FAN)
    return place.in("mode").bad("0 to 6", std::to_string(from.mode));
  const std::optional<Topology> topology = topologyOf(from.mode);
  if (!topology || !from.attributes.contains("POSITION")) return std::nullopt;
  GltfPrimitive primitive;
  primitive.topology = *topology;
  primitive.hasMaterial = from.material >= 0;
  FARCELL_ASSIGN(primitive.look, looks.look(place, from.material));
  primitive.plainColour = displayColour(primitive.look.factor);
  PrimitiveCheck check(place, from, accessors, primitive);
  FARCELL_TRY(check.checkFallback());
  FARCELL_TRY(check.checkAttributes());
  if (primitive.look.hasImage && !primitive.textureCoordinates.exists()) {
    FARCELL_ASSIGN(primitive.look.texture, looks.plainTexture(static_cast<size_t>(from.material)));
  }
  FARCELL_TRY(check.checkCorners());
  FARCELL_TRY(check.checkDraco(buffers));
  return primitive;
}

Result<PrimitiveElements> elementsOf(const GltfPlace& place, const GltfPrimitive& primitive, GltfBuffers& buffers,
                                     GltfAccessors& accessors) {
  DracoMesh mesh;
  if (primitive.dracoView) {
    FARCELL_ASSIGN(mesh, decode(place, primitive, buffers, accessors));
  }
  const auto find = [&](const GltfAttribute& attribute) -> Result<Elements> {
    if (attribute.dracoId) return findDecoded(mesh, attribute);
    return accessors.elements(attribute.accessor);
  };
  PrimitiveElements elements;
  FARCELL_ASSIGN(elements.position, find(primitive.position));
  if (primitive.normal.exists()) {
    FARCELL_ASSIGN(elements.normal, find(primitive.normal));
  }
  if (primitive.colour.exists()) {
    FARCELL_ASSIGN(elements.colour, find(primitive.colour));
  }
  if (primitive.textureCoordinates.exists()) {
    FARCELL_ASSIGN(elements.textureCoordinates, find(primitive.textureCoordinates));
  }
  if (primitive.dracoView) {
    elements.indices = mesh.indices;
  } else if (primitive.indices != kNoAccessor) {
    FARCELL_ASSIGN(elements.indices, accessors.elements(primitive.indices));
  }
  return elements;
}

}  // namespace farcell
