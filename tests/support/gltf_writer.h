// Small glTF files made by tests: what is put in is known before any reader sees it.
#pragma once

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace farcell::test {

// One buffer, filled from front to back. `root` is open to every change before the file is made.
class GltfWriter {
 public:
  GltfWriter();

  nlohmann::json root;

  // The index of what was added. `members` are added to the object.
  uint32_t addView(const std::string& bytes, const nlohmann::json& members = nlohmann::json::object());
  uint32_t addAccessor(const nlohmann::json& accessor) { return add("accessors", accessor); }
  uint32_t addMesh(const nlohmann::json& primitive) {
    return add("meshes", {{"primitives", nlohmann::json::array({primitive})}});
  }
  uint32_t addNode(const nlohmann::json& node);  // also to the scene
  uint32_t add(const char* list, const nlohmann::json& object);
  // A mesh of one primitive, and a node that shows it where it is.
  void show(const nlohmann::json& primitive) { addNode({{"mesh", addMesh(primitive)}}); }

  // An accessor of its own view: "SCALAR", "VEC2", ... of T, side by side.
  template <class T>
  uint32_t addArray(const std::string& type, const std::vector<T>& numbers,
                    const nlohmann::json& members = nlohmann::json::object()) {
    nlohmann::json accessor = {{"bufferView", addView(bytesOf(numbers))},
                               {"componentType", componentType<T>()},
                               {"count", numbers.size() / componentsOf(type)},
                               {"type", type}};
    accessor.update(members);
    return addAccessor(accessor);
  }

  const std::string& binary() const { return binary_; }
  std::string glb() const;                         // the buffer as its binary chunk
  std::string gltf(const std::string& uri) const;  // the buffer at `uri`
  std::string gltfWithData() const;                // the buffer as base64 text
  static std::string glbOf(const std::string& json, const std::string& binary);

  template <class T>
  static std::string bytesOf(const std::vector<T>& numbers) {
    std::string bytes(numbers.size() * sizeof(T), '\0');
    if (!bytes.empty()) std::memcpy(bytes.data(), numbers.data(), bytes.size());
    return bytes;
  }
  static size_t componentsOf(const std::string& type);
  template <class T>
  static int componentType() {
    if (std::is_same_v<T, int8_t>) return 5120;
    if (std::is_same_v<T, uint8_t>) return 5121;
    if (std::is_same_v<T, int16_t>) return 5122;
    if (std::is_same_v<T, uint16_t>) return 5123;
    if (std::is_same_v<T, uint32_t>) return 5125;
    static_assert(std::is_integral_v<T> || std::is_same_v<T, float>);
    return 5126;
  }

 private:
  std::string binary_;
};

std::string base64(const std::string& bytes);

}  // namespace farcell::test
