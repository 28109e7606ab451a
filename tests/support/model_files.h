// One model in every format: what readers and the pipeline below them must not tell apart.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace farcell::test {

struct IndexedModel {
  std::vector<glm::vec3> positions;
  std::vector<std::array<uint32_t, 3>> triangles;
};

// Numbers in text give the same doubles as the floats of the binary formats.
class ModelFile {
 public:
  explicit ModelFile(const IndexedModel& model) : model_(model) {}

  std::string plyText() const {
    std::string text = plyHeader("ascii") + points("");
    for (const auto& t : model_.triangles) text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
    return text;
  }
  std::string plyLittle() const { return plyHeader("binary_little_endian") + plyBody(false); }
  std::string plyBig() const { return plyHeader("binary_big_endian") + plyBody(true); }
  std::string obj() const {
    std::string text = points("v ");
    for (const auto& t : model_.triangles) text += fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
    return text;
  }
  std::string stlText() const {
    std::string text = "solid model\n";
    for (const auto& t : model_.triangles) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (const uint32_t i : t) text += "vertex " + point(model_.positions[i]) + "\n";
      text += "endloop\nendfacet\n";
    }
    return text + "endsolid model\n";
  }
  std::string stlBinary() const {
    std::string bytes = "solid though binary";
    bytes.resize(80, ' ');
    put(bytes, static_cast<uint32_t>(model_.triangles.size()));
    for (const auto& t : model_.triangles) {
      put(bytes, glm::vec3(0));
      for (const uint32_t i : t) put(bytes, model_.positions[i]);
      put(bytes, uint16_t{0});
    }
    return bytes;
  }
  std::string off() const {
    std::string text = fmt::format("OFF\n{} {} 0\n", model_.positions.size(), model_.triangles.size()) + points("");
    for (const auto& t : model_.triangles) text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
    return text;
  }
  std::string gltf() const {
    return gltfJson(R"("uri":"data:application/octet-stream;base64,)" + base64(gltfBuffer()) + R"(",)");
  }
  std::string glb() const {
    std::string json = gltfJson("");
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const std::string buffer = gltfBuffer();  // of words: needs no padding
    std::string bytes = "glTF";
    put(bytes, uint32_t{2});
    put(bytes, static_cast<uint32_t>(12 + 8 + json.size() + 8 + buffer.size()));
    put(bytes, static_cast<uint32_t>(json.size()));
    bytes += "JSON" + json;
    put(bytes, static_cast<uint32_t>(buffer.size()));
    return bytes + std::string("BIN\0", 4) + buffer;
  }

 private:
  template <class T>
  static void put(std::string& bytes, const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
  }
  template <class T>
  static void putScalar(std::string& bytes, T value, bool swap) {
    put(bytes, value);
    if (swap) std::reverse(bytes.end() - sizeof(T), bytes.end());
  }
  static std::string point(glm::vec3 p) { return fmt::format("{} {} {}", double{p.x}, double{p.y}, double{p.z}); }

  std::string points(const std::string& before) const {
    std::string text;
    for (const glm::vec3& p : model_.positions) text += before + point(p) + "\n";
    return text;
  }
  std::string plyHeader(const std::string& encoding) const {
    return fmt::format(
        "ply\nformat {} 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
        "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        encoding, model_.positions.size(), model_.triangles.size());
  }
  std::string plyBody(bool swap) const {
    std::string bytes;
    for (const glm::vec3& p : model_.positions)
      for (int axis = 0; axis < 3; ++axis) putScalar(bytes, p[axis], swap);
    for (const auto& t : model_.triangles) {
      bytes += '\3';
      for (const uint32_t i : t) putScalar(bytes, i, swap);
    }
    return bytes;
  }

  // Positions, then indices.
  std::string gltfBuffer() const {
    std::string bytes;
    for (const glm::vec3& p : model_.positions) put(bytes, p);
    for (const auto& t : model_.triangles) put(bytes, t);
    return bytes;
  }
  std::string gltfJson(const std::string& uri) const {
    glm::vec3 min = model_.positions[0], max = min;
    for (const glm::vec3& p : model_.positions) min = glm::min(min, p), max = glm::max(max, p);
    const size_t positionBytes = 12 * model_.positions.size(), indexBytes = 12 * model_.triangles.size();
    return fmt::format(
        R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],)"
        R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],)"
        R"("buffers":[{{{}"byteLength":{}}}],)"
        R"("bufferViews":[{{"buffer":0,"byteLength":{}}},{{"buffer":0,"byteOffset":{},"byteLength":{}}}],)"
        R"("accessors":[{{"bufferView":0,"componentType":5126,"count":{},"type":"VEC3","min":[{},{},{}],"max":[{},{},{}]}},)"
        R"({{"bufferView":1,"componentType":5125,"count":{},"type":"SCALAR"}}]}})",
        uri, positionBytes + indexBytes, positionBytes, positionBytes, indexBytes, model_.positions.size(), min.x,
        min.y, min.z, max.x, max.y, max.z, 3 * model_.triangles.size());
  }
  static std::string base64(const std::string& bytes) {
    constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t at = 0; at < bytes.size(); at += 3) {
      uint32_t bits = 0;
      for (size_t i = 0; i < 3; ++i)
        bits = bits << 8 | (at + i < bytes.size() ? static_cast<uint8_t>(bytes[at + i]) : 0u);
      for (size_t i = 0; i < 4; ++i) text += at + i <= bytes.size() ? kDigits[bits >> (18 - 6 * i) & 63] : '=';
    }
    return text;
  }

  const IndexedModel& model_;
};

}  // namespace farcell::test
