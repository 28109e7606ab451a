#include "preprocess/read/gltf/extensions.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "preprocess/read/gltf/draco_mesh.h"
#include "preprocess/read/gltf/place.h"

namespace farcell {
namespace {

constexpr std::string_view kDraco = "KHR_draco_mesh_compression";

constexpr std::array<std::string_view, 5> kRead = {
    kDraco, "KHR_mesh_quantization", "KHR_texture_transform", "EXT_mesh_gpu_instancing", "EXT_meshopt_compression",
};
// What they add is not shown here, and what they leave is right without them: shape and base colour.
constexpr std::array<std::string_view, 16> kIgnored = {
    "KHR_materials_anisotropy", "KHR_materials_clearcoat",         "KHR_materials_dispersion",
    "KHR_materials_ior",        "KHR_materials_emissive_strength", "KHR_materials_iridescence",
    "KHR_materials_sheen",      "KHR_materials_specular",          "KHR_materials_transmission",
    "KHR_materials_unlit",      "KHR_materials_variants",          "KHR_materials_volume",
    "KHR_lights_punctual",      "KHR_animation_pointer",           "KHR_xmp_json_ld",
    "EXT_lights_image_based",
};

template <size_t kCount>
bool contains(const std::array<std::string_view, kCount>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

Result<> checkRequiredExtensions(const std::string& path, const nlohmann::json& root) {
  const auto required = root.find("extensionsRequired");
  if (required == root.end()) return {};
  for (const nlohmann::json& item : *required) {
    const auto name = item.get<std::string>();
    const bool isKnown = contains(kRead, name) || contains(kIgnored, name);
    if (isKnown && (name != kDraco || kHasDraco)) continue;
    const char* expected = name == kDraco ? "a build with libdraco" : "extensions that are read here";
    return GltfPlace{path, "extensionsRequired"}.failed(ErrorKind::unsupported, expected, inQuotes(name));
  }
  return {};
}

}  // namespace farcell
