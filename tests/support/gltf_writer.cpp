#include "tests/support/gltf_writer.h"

namespace farcell::test {
namespace {

using nlohmann::json;

void pad(std::string& bytes, char filler) {
  while (bytes.size() % 4 != 0) bytes += filler;
}

std::string word(uint64_t value) { return GltfWriter::bytesOf(std::vector<uint32_t>{static_cast<uint32_t>(value)}); }

}  // namespace

GltfWriter::GltfWriter() {
  root = {{"asset", {{"version", "2.0"}}},
          {"scene", 0},
          {"scenes", {{{"nodes", json::array()}}}},
          {"buffers", {{{"byteLength", 0}}}}};
}

uint32_t GltfWriter::add(const char* list, const json& object) {
  if (!root.contains(list)) root[list] = json::array();
  root[list].push_back(object);
  return static_cast<uint32_t>(root[list].size() - 1);
}

uint32_t GltfWriter::addView(const std::string& bytes, const json& members) {
  pad(binary_, '\0');
  json view = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}};
  view.update(members);
  binary_ += bytes;
  root["buffers"][0]["byteLength"] = binary_.size();
  return add("bufferViews", view);
}

uint32_t GltfWriter::addNode(const json& node) {
  const uint32_t index = add("nodes", node);
  root["scenes"][0]["nodes"].push_back(index);
  return index;
}

size_t GltfWriter::componentsOf(const std::string& type) {
  return type == "SCALAR" ? 1 : static_cast<size_t>(type.back() - '0');
}

std::string GltfWriter::glbOf(const std::string& json, const std::string& binary) {
  std::string text = json;
  std::string bytes = binary;
  pad(text, ' ');
  pad(bytes, '\0');
  std::string chunks = word(text.size()) + "JSON" + text;
  if (!bytes.empty()) chunks += word(bytes.size()) + std::string("BIN\0", 4) + bytes;
  return "glTF" + word(2) + word(12 + chunks.size()) + chunks;
}

std::string GltfWriter::glb() const { return glbOf(root.dump(), binary_); }

std::string GltfWriter::gltf(const std::string& uri) const {
  json copy = root;
  copy["buffers"][0]["uri"] = uri;
  return copy.dump();
}

std::string GltfWriter::gltfWithData() const { return gltf("data:application/octet-stream;base64," + base64(binary_)); }

std::string base64(const std::string& bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t bits = 0;
    for (size_t k = 0; k < 3; ++k) bits = bits << 8 | (i + k < bytes.size() ? uint8_t(bytes[i + k]) : 0u);
    for (size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : kDigits[bits >> (18 - 6 * k) & 63];
  }
  return text;
}

}  // namespace farcell::test
