#include "preprocess/read/gltf/instancing.h"

#include <tiny_gltf.h>

#include "preprocess/read/gltf/node_transform.h"

namespace farcell {
namespace {

using enum ComponentType;

constexpr const char* kExtension = "EXT_mesh_gpu_instancing";
constexpr std::array kFloat = {float32};
constexpr std::array kRotationTypes = {int8, int16, float32};
constexpr AccessorUse kTranslationUse{"TRANSLATION", kFloat, 3, 3};
constexpr AccessorUse kRotationUse{"ROTATION", kRotationTypes, 4, 4};
constexpr AccessorUse kScaleUse{"SCALE", kFloat, 3, 3};

// One attribute of all instances; none where the extension does not give it.
using Vectors = std::vector<glm::dvec4>;

Result<Vectors> readVectors(const GltfPlace& place, const tinygltf::Value& attributes, const AccessorUse& use,
                            GltfBuffers& buffers, GltfAccessors& accessors, MemoryClaim& room) {
  if (!attributes.Has(use.name)) return Vectors{};
  const auto accessor = static_cast<uint64_t>(attributes.Get(use.name).GetNumberAsInt());
  FARCELL_TRY(accessors.checked(place.in(use.name), accessor, use));
  FARCELL_ASSIGN(const Elements elements, accessors.elements(accessor));
  FARCELL_ASSIGN(MemoryClaim claim, buffers.claim(place.in(use.name), elements.count * sizeof(glm::dvec4)));
  room.add(std::move(claim));
  Vectors vectors;
  vectors.reserve(elements.count);
  const double full = fullScale(elements.type);
  FARCELL_TRY(forEachElement(
      elements.bytes, elements.count, elements.stride, elements.elementBytes(), [&](const std::byte* at) {
        glm::dvec4 vector(0);
        for (uint32_t i = 0; i < elements.components; ++i)
          vector[static_cast<int>(i)] = loadComponent(at + i * sizeBytes(elements.type), elements.type) / full;
        vectors.push_back(vector);
        return true;
      }));
  return vectors;
}

}  // namespace

Result<> addInstances(const GltfPlace& place, const tinygltf::Node& node, const GltfTransform& worldFromNode,
                      GltfBuffers& buffers, GltfAccessors& accessors, std::vector<GltfTransform>& instances) {
  const auto extension = node.extensions.find(kExtension);
  if (extension == node.extensions.end()) {
    FARCELL_TRY(buffers.claimTable(place, sizeof(GltfTransform)));
    instances.push_back(worldFromNode);
    return {};
  }
  const GltfPlace at = place.in("extensions").in(kExtension).in("attributes");
  const tinygltf::Value& attributes = extension->second.Get("attributes");
  MemoryClaim room;
  FARCELL_ASSIGN(const Vectors translations, readVectors(at, attributes, kTranslationUse, buffers, accessors, room));
  FARCELL_ASSIGN(const Vectors rotations, readVectors(at, attributes, kRotationUse, buffers, accessors, room));
  FARCELL_ASSIGN(const Vectors scales, readVectors(at, attributes, kScaleUse, buffers, accessors, room));
  const size_t count = std::max({translations.size(), rotations.size(), scales.size()});
  for (const Vectors* vectors : {&translations, &rotations, &scales})
    if (!vectors->empty() && vectors->size() != count)
      return at.bad(fmt::format("{} instances in each accessor", count), std::to_string(vectors->size()));
  FARCELL_TRY(buffers.claimTable(at, count * sizeof(GltfTransform)));
  instances.reserve(instances.size() + count);
  for (size_t i = 0; i < count; ++i) {
    const glm::dvec4 rotation = rotations.empty() ? glm::dvec4(0, 0, 0, 1) : rotations[i];
    if (rotation == glm::dvec4(0)) return at.in("ROTATION").bad("unit quaternions", fmt::format("zeros at {}", i));
    instances.push_back(worldFromNode * fromTrs(translations.empty() ? glm::dvec3(0) : glm::dvec3(translations[i]),
                                                rotation, scales.empty() ? glm::dvec3(1) : glm::dvec3(scales[i])));
  }
  return {};
}

}  // namespace farcell
