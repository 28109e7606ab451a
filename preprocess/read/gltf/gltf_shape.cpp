#include "preprocess/read/gltf/gltf_shape.h"

#include <array>

namespace farcell {
namespace {

using Kind = JsonKind;
constexpr bool kRequired = true;
constexpr bool kOptional = false;
constexpr bool kList = true;

constexpr std::array kAssetMembers = {
    JsonMember{"version", Kind::string, kRequired},
    JsonMember{"minVersion", Kind::string},
};
constexpr JsonShape kAsset{kAssetMembers};

// Bytes

constexpr std::array kFallbackMembers = {JsonMember{"fallback", Kind::boolean}};
constexpr JsonShape kFallback{kFallbackMembers};
constexpr std::array kBufferExtensionMembers = {
    JsonMember{"EXT_meshopt_compression", Kind::object, kOptional, &kFallback}};
constexpr JsonShape kBufferExtensions{kBufferExtensionMembers};
constexpr std::array kBufferMembers = {
    JsonMember{"uri", Kind::string},
    JsonMember{"byteLength", Kind::size, kRequired},
    JsonMember{"extensions", Kind::object, kOptional, &kBufferExtensions},
};
constexpr JsonShape kBuffer{kBufferMembers};

constexpr std::array kMeshoptMembers = {
    JsonMember{"buffer", Kind::index, kRequired},
    JsonMember{"byteOffset", Kind::size},
    JsonMember{"byteLength", Kind::size, kRequired},
    JsonMember{"byteStride", Kind::index, kRequired},
    JsonMember{"count", Kind::size, kRequired},
    JsonMember{"mode", Kind::string, kRequired},
    JsonMember{"filter", Kind::string},
};
constexpr JsonShape kMeshopt{kMeshoptMembers};
constexpr std::array kViewExtensionMembers = {
    JsonMember{"EXT_meshopt_compression", Kind::object, kOptional, &kMeshopt}};
constexpr JsonShape kViewExtensions{kViewExtensionMembers};
constexpr std::array kViewMembers = {
    JsonMember{"buffer", Kind::index, kRequired},
    JsonMember{"byteOffset", Kind::size},
    JsonMember{"byteLength", Kind::size, kRequired},
    JsonMember{"byteStride", Kind::index},
    JsonMember{"extensions", Kind::object, kOptional, &kViewExtensions},
};
constexpr JsonShape kView{kViewMembers};

constexpr std::array kImageMembers = {
    JsonMember{"uri", Kind::string},
    JsonMember{"mimeType", Kind::string},
    JsonMember{"bufferView", Kind::index},
};
constexpr JsonShape kImage{kImageMembers};

// Accessors

constexpr std::array kSparseIndicesMembers = {
    JsonMember{"bufferView", Kind::index, kRequired},
    JsonMember{"byteOffset", Kind::index},
    JsonMember{"componentType", Kind::index, kRequired},
};
constexpr JsonShape kSparseIndices{kSparseIndicesMembers};
constexpr std::array kSparseValuesMembers = {
    JsonMember{"bufferView", Kind::index, kRequired},
    JsonMember{"byteOffset", Kind::index},
};
constexpr JsonShape kSparseValues{kSparseValuesMembers};
constexpr std::array kSparseMembers = {
    JsonMember{"count", Kind::index, kRequired},
    JsonMember{"indices", Kind::object, kRequired, &kSparseIndices},
    JsonMember{"values", Kind::object, kRequired, &kSparseValues},
};
constexpr JsonShape kSparse{kSparseMembers};
constexpr std::array kAccessorMembers = {
    JsonMember{"bufferView", Kind::index},
    JsonMember{"byteOffset", Kind::size},
    JsonMember{"componentType", Kind::index, kRequired},
    JsonMember{"count", Kind::size, kRequired},
    JsonMember{"type", Kind::string, kRequired},
    JsonMember{"normalized", Kind::boolean},
    JsonMember{"sparse", Kind::object, kOptional, &kSparse},
};
constexpr JsonShape kAccessor{kAccessorMembers};

// Meshes

constexpr std::array kDracoMembers = {
    JsonMember{"bufferView", Kind::index, kRequired},
    JsonMember{"attributes", Kind::indices, kRequired},
};
constexpr JsonShape kDraco{kDracoMembers};
constexpr std::array kPrimitiveExtensionMembers = {
    JsonMember{"KHR_draco_mesh_compression", Kind::object, kOptional, &kDraco}};
constexpr JsonShape kPrimitiveExtensions{kPrimitiveExtensionMembers};
constexpr std::array kPrimitiveMembers = {
    JsonMember{"attributes", Kind::indices, kRequired},
    JsonMember{"indices", Kind::index},
    JsonMember{"material", Kind::index},
    JsonMember{"mode", Kind::index},
    JsonMember{"extensions", Kind::object, kOptional, &kPrimitiveExtensions},
};
constexpr JsonShape kPrimitive{kPrimitiveMembers};
constexpr std::array kMeshMembers = {JsonMember{"primitives", Kind::object, kRequired, &kPrimitive, kList}};
constexpr JsonShape kMesh{kMeshMembers};

// Nodes

constexpr std::array kInstancingMembers = {JsonMember{"attributes", Kind::indices, kRequired}};
constexpr JsonShape kInstancing{kInstancingMembers};
constexpr std::array kNodeExtensionMembers = {
    JsonMember{"EXT_mesh_gpu_instancing", Kind::object, kOptional, &kInstancing}};
constexpr JsonShape kNodeExtensions{kNodeExtensionMembers};
constexpr std::array kNodeMembers = {
    JsonMember{"mesh", Kind::index},
    JsonMember{"children", Kind::index, kOptional, nullptr, kList},
    JsonMember{"matrix", Kind::number, kOptional, nullptr, kList, 16},
    JsonMember{"translation", Kind::number, kOptional, nullptr, kList, 3},
    JsonMember{"rotation", Kind::number, kOptional, nullptr, kList, 4},
    JsonMember{"scale", Kind::number, kOptional, nullptr, kList, 3},
    JsonMember{"extensions", Kind::object, kOptional, &kNodeExtensions},
};
constexpr JsonShape kNode{kNodeMembers};
constexpr std::array kSceneMembers = {JsonMember{"nodes", Kind::index, kOptional, nullptr, kList}};
constexpr JsonShape kScene{kSceneMembers};

// Materials

constexpr std::array kTransformMembers = {
    JsonMember{"offset", Kind::number, kOptional, nullptr, kList, 2},
    JsonMember{"rotation", Kind::number},
    JsonMember{"scale", Kind::number, kOptional, nullptr, kList, 2},
    JsonMember{"texCoord", Kind::index},
};
constexpr JsonShape kTransform{kTransformMembers};
constexpr std::array kTextureInfoExtensionMembers = {
    JsonMember{"KHR_texture_transform", Kind::object, kOptional, &kTransform}};
constexpr JsonShape kTextureInfoExtensions{kTextureInfoExtensionMembers};
constexpr std::array kTextureInfoMembers = {
    JsonMember{"index", Kind::index, kRequired},
    JsonMember{"texCoord", Kind::index},
    JsonMember{"extensions", Kind::object, kOptional, &kTextureInfoExtensions},
};
constexpr JsonShape kTextureInfo{kTextureInfoMembers};
constexpr std::array kBaseColourMembers = {
    JsonMember{"baseColorFactor", Kind::number, kOptional, nullptr, kList, 4},
    JsonMember{"baseColorTexture", Kind::object, kOptional, &kTextureInfo},
};
constexpr JsonShape kBaseColour{kBaseColourMembers};
constexpr std::array kMaterialMembers = {
    JsonMember{"pbrMetallicRoughness", Kind::object, kOptional, &kBaseColour},
    JsonMember{"alphaMode", Kind::string},
    JsonMember{"alphaCutoff", Kind::number},
    JsonMember{"doubleSided", Kind::boolean},
};
constexpr JsonShape kMaterial{kMaterialMembers};
constexpr std::array kTextureMembers = {JsonMember{"sampler", Kind::index}, JsonMember{"source", Kind::index}};
constexpr JsonShape kTexture{kTextureMembers};
constexpr std::array kSamplerMembers = {JsonMember{"wrapS", Kind::index}, JsonMember{"wrapT", Kind::index}};
constexpr JsonShape kSampler{kSamplerMembers};

constexpr std::array kRootMembers = {
    JsonMember{"asset", Kind::object, kRequired, &kAsset},
    JsonMember{"extensionsRequired", Kind::string, kOptional, nullptr, kList},
    JsonMember{"buffers", Kind::object, kOptional, &kBuffer, kList},
    JsonMember{"bufferViews", Kind::object, kOptional, &kView, kList},
    JsonMember{"images", Kind::object, kOptional, &kImage, kList},
    JsonMember{"accessors", Kind::object, kOptional, &kAccessor, kList},
    JsonMember{"meshes", Kind::object, kOptional, &kMesh, kList},
    JsonMember{"nodes", Kind::object, kOptional, &kNode, kList},
    JsonMember{"scenes", Kind::object, kOptional, &kScene, kList},
    JsonMember{"scene", Kind::index},
    JsonMember{"materials", Kind::object, kOptional, &kMaterial, kList},
    JsonMember{"textures", Kind::object, kOptional, &kTexture, kList},
    JsonMember{"samplers", Kind::object, kOptional, &kSampler, kList},
};
constexpr JsonShape kRoot{kRootMembers};

}  // namespace

const JsonShape& gltfShape() { return kRoot; }

}  // namespace farcell
