#include "preprocess/read/gltf/json_text.h"

#include <nlohmann/json.hpp>

namespace farcell {
namespace {

constexpr int kMaxDepth = 64;                       // glTF itself needs about ten
constexpr uint64_t kMaxValues = uint64_t{8} << 20;  // at most about 1 GB as a tree

Result<uint64_t> countValues(const std::string& path, uint64_t offset, const std::string& text) {
  int depth = 0;
  uint64_t values = 0;
  bool inString = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inString) {
      if (c == '\\') ++i;
      inString = c != '"';
      continue;
    }
    inString = c == '"';
    if (c == ',' || c == '[' || c == '{') ++values;  // each starts at most one value
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    if (depth > kMaxDepth)
      return corrupt(path, offset + i, fmt::format("JSON nested at most {} deep", kMaxDepth), "deeper nesting");
    if (values > kMaxValues)
      return fail(ErrorKind::exhausted, "{}: offset {}: expected at most {} JSON values, found more", path, offset + i,
                  kMaxValues);
  }
  return values;
}

}  // namespace

Result<uint64_t> openingBytes(const std::string& path, uint64_t offset, const std::string& text) {
  constexpr uint64_t kBytesPerValue = 192;
  constexpr uint64_t kTexts = 3;  // as it was read, as strings of the tree, and as tinygltf is given it
  FARCELL_ASSIGN(const uint64_t values, countValues(path, offset, text));
  return values * kBytesPerValue + kTexts * text.size();
}

Result<nlohmann::json> parseJsonText(const std::string& path, uint64_t offset, const std::string& text) {
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    return corrupt(path, offset + error.byte, "JSON", error.what());
  } catch (const nlohmann::json::exception& error) {  // a number too large for a double
    return corrupt(path, offset, "JSON", error.what());
  }
}

}  // namespace farcell
