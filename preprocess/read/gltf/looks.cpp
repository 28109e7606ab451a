#include "preprocess/read/gltf/looks.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "preprocess/mesh/vertices.h"
#include "preprocess/read/gltf/image_source.h"

namespace farcell {
namespace {

constexpr const char* kTransformExtension = "KHR_texture_transform";

glm::dvec2 pairOf(const tinygltf::Value& object, const char* name, glm::dvec2 otherwise) {
  if (!object.Has(name)) return otherwise;
  const tinygltf::Value& list = object.Get(name);
  return {list.Get(0).GetNumberAsDouble(), list.Get(1).GetNumberAsDouble()};
}

// Also where the extension names another set of coordinates.
void applyTransform(const tinygltf::Value& extension, GltfLook& look) {
  look.transform.scale = pairOf(extension, "scale", glm::dvec2(1));
  look.transform.offset = pairOf(extension, "offset", glm::dvec2(0));
  const double angleRad = extension.Has("rotation") ? extension.Get("rotation").GetNumberAsDouble() : 0;
  look.transform.cosine = std::cos(angleRad);
  look.transform.sine = std::sin(angleRad);
  if (extension.Has("texCoord"))
    look.textureCoordinates = static_cast<uint32_t>(extension.Get("texCoord").GetNumberAsInt());
}

Result<TextureWrap> wrapOf(const GltfPlace& place, int mode) {
  if (mode == TINYGLTF_TEXTURE_WRAP_REPEAT) return TextureWrap::repeat;
  if (mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return TextureWrap::mirror;
  if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return TextureWrap::clamp;
  return place.bad("10497, 33648 or 33071", std::to_string(mode));
}

Result<SurfaceKind> surfaceOf(const GltfPlace& place, const tinygltf::Material& material) {
  SurfaceKind surface;
  surface.doubleSided = material.doubleSided;
  if (material.alphaMode == "MASK") {
    surface.alpha = AlphaMode::mask;
    surface.cutoff = static_cast<float>(std::clamp(material.alphaCutoff, 0.0, 2.0));  // beyond 1 nothing is left
  } else if (material.alphaMode == "BLEND") {
    surface.alpha = AlphaMode::blend;
  } else if (material.alphaMode != "OPAQUE") {
    return place.in("alphaMode").bad("OPAQUE, MASK or BLEND", material.alphaMode);
  }
  return surface;
}

}  // namespace

// Angles turn counter-clockwise as seen with v down.
glm::dvec2 TextureTransform::apply(glm::dvec2 uv) const {
  const glm::dvec2 scaled = scale * uv;
  return glm::dvec2(cosine * scaled.x + sine * scaled.y, cosine * scaled.y - sine * scaled.x) + offset;
}

std::vector<GltfImage> imagesOf(const nlohmann::json& root) {
  std::vector<GltfImage> images;
  if (!root.contains("images")) return images;
  for (const nlohmann::json& object : root["images"]) {
    GltfImage& image = images.emplace_back();
    image.uri = object.value("uri", std::string());
    if (object.contains("bufferView")) image.view = object["bufferView"].get<uint64_t>();
  }
  return images;
}

double displayFromLinear(double linear) {
  if (!(linear > 0)) return 0;
  if (linear >= 1) return 1;
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

uint32_t displayColour(glm::dvec3 linear) {
  return packColour(displayFromLinear(linear.x), displayFromLinear(linear.y), displayFromLinear(linear.z));
}

Result<GltfLook> GltfLooks::look(const GltfPlace& user, int material) {
  GltfLook look;
  if (material < 0) return look;
  const auto index = static_cast<size_t>(material);
  if (index >= model_.materials.size())
    return user.in("material")
        .bad(fmt::format("one of {} materials", model_.materials.size()), std::to_string(material));
  const tinygltf::PbrMetallicRoughness& base = model_.materials[index].pbrMetallicRoughness;
  const std::vector<double>& factor = base.baseColorFactor;
  look.factor = {factor[0], factor[1], factor[2]};
  const tinygltf::TextureInfo& info = base.baseColorTexture;
  if (info.index >= 0) {
    FARCELL_ASSIGN(look.texture, texture(index));
  }
  look.hasImage = look.texture != kNoTexture;
  if (!look.hasImage) {
    FARCELL_ASSIGN(look.texture, plainTexture(index));
  }
  look.textureCoordinates = static_cast<uint32_t>(info.texCoord);
  if (const auto found = info.extensions.find(kTransformExtension); found != info.extensions.end())
    applyTransform(found->second, look);
  return look;
}

Result<GltfLooks::Known> GltfLooks::withoutImage(size_t material) const {
  const tinygltf::Material& from = model_.materials[material];
  Known wanted;
  FARCELL_ASSIGN(wanted.surface, surfaceOf(buffers_.place(fmt::format("materials[{}]", material)), from));
  const double opacity = from.pbrMetallicRoughness.baseColorFactor[3];
  if (wanted.surface.alpha != AlphaMode::opaque) wanted.opacity = static_cast<float>(std::clamp(opacity, 0.0, 1.0));
  return wanted;
}

Result<uint32_t> GltfLooks::plainTexture(size_t material) {
  FARCELL_ASSIGN(const Known wanted, withoutImage(material));
  if (wanted.surface.whole()) return kNoTexture;
  return entry(wanted);
}

Result<uint32_t> GltfLooks::texture(size_t material) {
  const GltfPlace place = buffers_.place(fmt::format("materials[{}].pbrMetallicRoughness.baseColorTexture", material));
  FARCELL_ASSIGN(Known wanted, withoutImage(material));
  const auto index = static_cast<size_t>(model_.materials[material].pbrMetallicRoughness.baseColorTexture.index);
  if (index >= model_.textures.size())
    return place.in("index").bad(fmt::format("one of {} textures", model_.textures.size()), std::to_string(index));
  const tinygltf::Texture& texture = model_.textures[index];
  if (texture.source < 0) return kNoTexture;  // an extension brings an image of a kind that is not read
  const GltfPlace at = buffers_.place(fmt::format("textures[{}]", index));
  wanted.image = static_cast<uint64_t>(texture.source);
  FARCELL_ASSIGN(wanted.wrap, wrapsOf(at, texture.sampler));
  if (*wanted.image >= images_.size())
    return at.in("source").bad(fmt::format("one of {} images", images_.size()), std::to_string(*wanted.image));
  return entry(wanted);
}

Result<uint32_t> GltfLooks::entry(const Known& wanted) {
  const auto found = std::find(known_.begin(), known_.end(), wanted);
  if (found != known_.end()) return static_cast<uint32_t>(found - known_.begin());
  FARCELL_ASSIGN(TextureSource from, source(wanted));
  known_.push_back(wanted);
  textures_.push_back(std::move(from));
  return static_cast<uint32_t>(textures_.size() - 1);
}

Result<std::array<TextureWrap, 2>> GltfLooks::wrapsOf(const GltfPlace& place, int sampler) const {
  std::array<TextureWrap, 2> wraps = {TextureWrap::repeat, TextureWrap::repeat};
  if (sampler < 0) return wraps;
  const auto index = static_cast<size_t>(sampler);
  if (index >= model_.samplers.size())
    return place.in("sampler").bad(fmt::format("one of {} samplers", model_.samplers.size()), std::to_string(sampler));
  const GltfPlace at = buffers_.place(fmt::format("samplers[{}]", index));
  FARCELL_ASSIGN(wraps[0], wrapOf(at.in("wrapS"), model_.samplers[index].wrapS));
  FARCELL_ASSIGN(wraps[1], wrapOf(at.in("wrapT"), model_.samplers[index].wrapT));
  return wraps;
}

Result<TextureSource> GltfLooks::source(const Known& wanted) {
  TextureSource from;
  from.file = buffers_.path();
  if (wanted.image) {
    FARCELL_ASSIGN(
        from, imageSource(buffers_, buffers_.place(fmt::format("images[{}]", *wanted.image)), images_[*wanted.image]));
  }
  from.wrapU = wanted.wrap[0];
  from.wrapV = wanted.wrap[1];
  from.surface = wanted.surface;
  from.surface.hasImage = wanted.image.has_value();
  from.opacity = wanted.opacity;
  return from;
}

}  // namespace farcell
