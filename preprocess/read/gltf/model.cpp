#include "preprocess/read/gltf/model.h"

#include <tiny_gltf.h>

#include <nlohmann/json.hpp>

#include "preprocess/read/gltf/place.h"

namespace farcell {
namespace {

using nlohmann::json;

// tinygltf refuses indices without a view (compressed or sparse ones have none), and looks at nothing of a view but
// that it is there.
void neutralise(json& root) {
  const size_t views = root.contains("bufferViews") ? root["bufferViews"].size() : 0;
  root["bufferViews"] = json(views + 1, json{{"buffer", 0}, {"byteLength", 1}});
  root.erase("buffers");
  root.erase("images");
  if (!root.contains("accessors")) return;
  for (json& accessor : root["accessors"])
    if (!accessor.contains("bufferView")) accessor["bufferView"] = views;
}

// It looks them up without saying which are not there.
Result<> checkIndices(const std::string& path, const json& root) {
  const size_t accessors = root.contains("accessors") ? root["accessors"].size() : 0;
  const json none = json::array();
  const json& meshes = root.contains("meshes") ? root["meshes"] : none;
  for (size_t mesh = 0; mesh < meshes.size(); ++mesh)
    for (size_t number = 0; number < meshes[mesh]["primitives"].size(); ++number) {
      const auto indices = meshes[mesh]["primitives"][number].value("indices", uint64_t{0});
      if (indices < std::max<size_t>(accessors, 1)) continue;
      return GltfPlace{path, fmt::format("meshes[{}].primitives[{}].indices", mesh, number)}.bad(
          fmt::format("one of {} accessors", accessors), std::to_string(indices));
    }
  return {};
}

// It has nothing left to open; should it try, it finds nothing.
void closeFileSystem(tinygltf::TinyGLTF& loader) {
  tinygltf::FsCallbacks callbacks{};
  callbacks.FileExists = [](const std::string&, void*) { return false; };
  callbacks.ExpandFilePath = [](const std::string& path, void*) { return path; };
  callbacks.ReadWholeFile = [](std::vector<unsigned char>*, std::string*, const std::string&, void*) { return false; };
  callbacks.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
    return false;
  };
  loader.SetFsCallbacks(callbacks);
  loader.RemoveImageLoader();
}

// It passes over parts that it cannot read.
bool isComplete(const tinygltf::Model& model, const json& root) {
  const auto count = [&](const char* name) { return root.contains(name) ? root[name].size() : 0; };
  bool complete = model.accessors.size() == count("accessors") && model.meshes.size() == count("meshes") &&
                  model.nodes.size() == count("nodes") && model.scenes.size() == count("scenes") &&
                  model.materials.size() == count("materials") && model.textures.size() == count("textures") &&
                  model.samplers.size() == count("samplers");
  for (size_t i = 0; complete && i < model.meshes.size(); ++i)
    complete = model.meshes[i].primitives.size() == root["meshes"][i]["primitives"].size();
  return complete;
}

}  // namespace

Result<tinygltf::Model> loadModel(const std::string& path, json root) {
  FARCELL_TRY(checkIndices(path, root));
  neutralise(root);
  const GltfPlace place{path, "JSON"};
  tinygltf::TinyGLTF loader;
  closeFileSystem(loader);
  tinygltf::Model model;
  std::string error;
  std::string warning;
  try {
    const std::string text = root.dump();
    if (text.size() > UINT32_MAX) return place.failed(ErrorKind::exhausted, "less than 4 GiB", "more");
    if (!loader.LoadASCIIFromString(&model, &error, &warning, text.data(), static_cast<unsigned>(text.size()), ""))
      return place.bad("glTF 2.0", inQuotes(error));
  } catch (const std::exception& exception) {
    return place.bad("glTF 2.0", inQuotes(exception.what()));
  }
  if (!isComplete(model, root)) return place.bad("glTF 2.0", "parts that tinygltf cannot read");
  return model;
}

}  // namespace farcell
