#include "preprocess/read/gltf/gltf_reader.h"

#include <tiny_gltf.h>

#include <nlohmann/json.hpp>

#include "preprocess/read/gltf/extensions.h"
#include "preprocess/read/gltf/extent.h"
#include "preprocess/read/gltf/gltf_shape.h"
#include "preprocess/read/gltf/json_text.h"
#include "preprocess/read/gltf/model.h"
#include "preprocess/read/gltf/primitive_triangles.h"

namespace farcell {
namespace {

// All that a pass needs.
struct GltfScene {
  std::unique_ptr<GltfBuffers> buffers;
  std::unique_ptr<GltfAccessors> accessors;
  std::vector<std::vector<GltfTransform>> instances;  // of each mesh
  std::vector<GltfPrimitive> primitives;              // of meshes that stand somewhere
  std::vector<TextureSource> textures;
  MeshInfo info;
};

GltfPlace placeOf(const GltfBuffers& buffers, uint32_t mesh, uint32_t number) {
  return buffers.place(fmt::format("meshes[{}].primitives[{}]", mesh, number));
}

Result<> checkVersion(const std::string& path, const nlohmann::json& root) {
  const nlohmann::json& asset = root["asset"];
  const GltfPlace place{path, "asset"};
  const auto version = asset["version"].get<std::string>();
  if (!version.starts_with("2.")) return place.in("version").failed(ErrorKind::unsupported, "2.x", inQuotes(version));
  const auto least = asset.value("minVersion", std::string("2.0"));
  if (least != "2.0") return place.in("minVersion").failed(ErrorKind::unsupported, "2.0", inQuotes(least));
  return {};
}

Result<nlohmann::json> readCheckedJson(const InputFile& file, GltfContainer& container) {
  FARCELL_ASSIGN(nlohmann::json all, parseJsonText(file.path(), container.jsonOffset, container.json));
  container.json = {};
  FARCELL_ASSIGN(nlohmann::json root, takeShape(file.path(), gltfShape(), all));
  FARCELL_TRY(checkVersion(file.path(), root));
  FARCELL_TRY(checkRequiredExtensions(file.path(), root));
  return root;
}

Result<> readPrimitives(const tinygltf::Model& model, GltfLooks& looks, GltfScene& scene) {
  for (uint32_t mesh = 0; mesh < model.meshes.size(); ++mesh) {
    if (scene.instances[mesh].empty()) continue;
    const auto& from = model.meshes[mesh].primitives;
    for (uint32_t number = 0; number < from.size(); ++number) {
      FARCELL_ASSIGN(
          std::optional<GltfPrimitive> primitive,
          readPrimitive(placeOf(*scene.buffers, mesh, number), from[number], *scene.buffers, *scene.accessors, looks));
      if (!primitive) continue;
      primitive->mesh = mesh;
      primitive->number = number;
      scene.primitives.push_back(*primitive);
    }
  }
  return {};
}

Result<> summarise(GltfScene& scene) {
  MeshInfo& info = scene.info;
  info.format = startsLikeGlb(scene.buffers->file()) ? "glTF, binary" : "glTF";
  info.up = UpAxis::y;
  info.hasNormals = !scene.primitives.empty();
  for (const GltfPrimitive& primitive : scene.primitives) {
    info.hasColours |= primitive.hasMaterial || primitive.colour.exists();
    info.hasNormals &= primitive.normal.exists();
    info.vertices += primitive.vertices;
    const std::optional<uint64_t> sum =
        productPlus(primitive.triangles, scene.instances[primitive.mesh].size(), info.declaredTriangles);
    if (!sum)
      return placeOf(*scene.buffers, primitive.mesh, primitive.number)
          .failed(ErrorKind::exhausted, "less than 2^64 triangles", "more");
    info.declaredTriangles = *sum;
  }
  for (GltfPrimitive& primitive : scene.primitives) {
    if (!info.hasColours) primitive.plainColour = defaultColour();
    if (!info.hasNormals) primitive.normal = {};
  }
  return {};
}

class GltfReader final : public MeshReader {
 public:
  explicit GltfReader(GltfScene scene) : scene_(std::move(scene)) {}

  const MeshInfo& info() const override { return scene_.info; }
  std::span<const TextureSource> textures() const override { return scene_.textures; }
  std::vector<std::filesystem::path> files() const override { return scene_.buffers->files(); }
  Result<MeshCounts> forEachTriangle(const Sink& sink) override;

 private:
  GltfScene scene_;
};

Result<MeshCounts> GltfReader::forEachTriangle(const Sink& sink) {
  TriangleBatch batch(sink);
  VertexCache cache(scene_.buffers->memory());
  for (const GltfPrimitive& primitive : scene_.primitives) {
    if (batch.failed()) break;
    const GltfPlace place = placeOf(*scene_.buffers, primitive.mesh, primitive.number);
    cache.makeRoomFor(primitive);
    FARCELL_ASSIGN(const PrimitiveElements elements, elementsOf(place, primitive, *scene_.buffers, *scene_.accessors));
    FARCELL_TRY(emitTriangles(place, primitive, elements, scene_.instances[primitive.mesh], cache, batch));
  }
  return batch.finish();
}

}  // namespace

bool startsLikeGltf(const InputFile& file) { return startsLikeGlb(file); }

Result<std::unique_ptr<MeshReader>> openGltf(InputFile file, const std::shared_ptr<ReadMemory>& memory) {
  GltfScene scene;
  scene.buffers = std::make_unique<GltfBuffers>(std::move(file), memory);
  FARCELL_ASSIGN(GltfContainer container, readContainer(scene.buffers->file()));
  FARCELL_ASSIGN(const uint64_t openingSize, openingBytes(scene.buffers->path(), container.jsonOffset, container.json));
  FARCELL_ASSIGN(MemoryClaim opening, scene.buffers->claim(scene.buffers->place("JSON"), openingSize));
  FARCELL_ASSIGN(nlohmann::json root, readCheckedJson(scene.buffers->file(), container));
  FARCELL_TRY(scene.buffers->open(root, container.binary));
  std::vector<GltfImage> images = imagesOf(root);
  const uint64_t noView = scene.buffers->viewCount();
  FARCELL_ASSIGN(const tinygltf::Model model, loadModel(scene.buffers->path(), std::move(root)));
  scene.accessors = std::make_unique<GltfAccessors>(*scene.buffers, model.accessors, noView);
  FARCELL_ASSIGN(scene.instances, readInstances(model, *scene.buffers, *scene.accessors));
  GltfLooks looks(model, std::move(images), *scene.buffers);
  FARCELL_TRY(readPrimitives(model, looks, scene));
  scene.textures = looks.takeTextures();
  FARCELL_TRY(summarise(scene));
  return std::make_unique<GltfReader>(std::move(scene));
}

}  // namespace farcell
