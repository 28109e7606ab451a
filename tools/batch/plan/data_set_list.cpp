#include "tools/batch/plan/data_set_list.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>

#include "cache/base/file.h"
#include "preprocess/read/scene/scene_json.h"

namespace farcell {
namespace {
constexpr uint64_t kMaxFileBytes = uint64_t{64} << 20;
constexpr size_t kMaxMeshes = 100'000;
constexpr size_t kMaxNameBytes = 200;  // with an ending, still a file name anywhere
// What batch itself says to a build, or what would take the place of the work.
constexpr std::array<std::string_view, 7> kNotForLists = {"output",  "json", "progress",       "quiet",
                                                          "version", "help", "print-reference"};

bool isNameByte(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '_' || c == '-'; }

// Letters, digits, '.', '_' and '-', not a '.' or '-' first: never a path, hidden, or an option.
Result<std::string> fileName(const SceneValue& value) {
  FARCELL_ASSIGN(std::string name, value.string());
  if (name.size() <= kMaxNameBytes && std::all_of(name.begin(), name.end(), isNameByte) && name[0] != '.' &&
      name[0] != '-')
    return name;
  return value.bad(fmt::format("a name of at most {} letters, digits, '.', '_' and '-'", kMaxNameBytes));
}

Result<std::vector<std::string>> meshesOf(const SceneValue& value) {
  FARCELL_ASSIGN(const size_t count, value.objectCount(kMaxMeshes));
  std::vector<std::string> meshes(count);
  for (size_t i = 0; i < count; ++i) {
    FARCELL_ASSIGN(meshes[i], value.element(i).string());
  }
  return meshes;
}

bool isOptionByte(char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-'; }

bool isOptionName(const std::string& name) {
  return !name.empty() && name[0] != '-' && std::all_of(name.begin(), name.end(), isOptionByte);
}

Result<std::vector<std::string>> optionsOf(const SceneValue& value) {
  if (!value.json().is_object()) return value.bad("an object");
  std::vector<std::string> options;
  for (const auto& [name, json] : value.json().items()) {
    if (!isOptionName(name) || std::find(kNotForLists.begin(), kNotForLists.end(), name) != kNotForLists.end())
      return value.bad("long options of `farcell build` that say how to build",
                       nlohmann::json(name).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace));
    const SceneValue option = value.member(name.c_str());
    if (json.is_boolean()) {
      if (json.get<bool>()) options.push_back(fmt::format("--{}", name));
    } else if (json.is_number()) {
      options.push_back(fmt::format("--{}={}", name, json.dump()));
    } else {
      FARCELL_ASSIGN(const std::string text, option.string());
      options.push_back(fmt::format("--{}={}", name, text));
    }
  }
  return options;
}

Result<DataSet> dataSetOf(const SceneValue& value) {
  FARCELL_TRY(value.expectMembers({"name", "meshes", "output", "options"}));
  for (const char* needed : {"name", "meshes"})
    if (!value.has(needed)) return value.bad(fmt::format("a member '{}'", needed), "none");
  DataSet set;
  FARCELL_ASSIGN(set.name, fileName(value.member("name")));
  FARCELL_ASSIGN(set.meshes, meshesOf(value.member("meshes")));
  set.output = fmt::format("{}.far", set.name);
  if (value.has("output")) {
    FARCELL_ASSIGN(set.output, fileName(value.member("output")));
    if (!set.output.ends_with(".far")) return value.member("output").bad("a name that ends in .far");
  }
  if (value.has("options")) {
    FARCELL_ASSIGN(set.options, optionsOf(value.member("options")));
  }
  return set;
}

std::string withoutCase(std::string name) {
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return name;
}

}  // namespace

Result<std::vector<DataSet>> parseDataSets(const std::string& text, const std::string& file) {
  FARCELL_ASSIGN(const nlohmann::json json, parseSceneJson(text, file));
  const SceneValue list(file, "list", json);
  FARCELL_TRY(list.expectMembers({"datasets"}));
  if (!list.has("datasets")) return list.bad("a member 'datasets'", "none");
  const SceneValue array = list.member("datasets");
  FARCELL_ASSIGN(const size_t count, array.objectCount(kMaxDataSets));
  std::vector<DataSet> sets;
  std::set<std::string> names, outputs;
  for (size_t i = 0; i < count; ++i) {
    const SceneValue value = array.element(i);
    FARCELL_ASSIGN(DataSet set, dataSetOf(value));
    if (!names.insert(withoutCase(set.name)).second)
      return value.bad("a name of no other data set", fmt::format("'{}' again", set.name));
    if (!outputs.insert(withoutCase(set.output)).second)
      return value.bad("an output of no other data set", fmt::format("'{}' again", set.output));
    sets.push_back(std::move(set));
  }
  return sets;
}

Result<std::vector<DataSet>> readDataSets(const std::filesystem::path& path) {
  FARCELL_ASSIGN(const std::string text, readTextFile(path, kMaxFileBytes));
  return parseDataSets(text, path.string());
}

}  // namespace farcell
