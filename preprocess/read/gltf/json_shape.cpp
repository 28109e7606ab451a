#include "preprocess/read/gltf/json_shape.h"

#include <nlohmann/json.hpp>

namespace farcell {
namespace {

using nlohmann::json;

constexpr uint64_t kIndexEnd = 0x7fffffff;  // an int of tinygltf
constexpr size_t kNoItem = SIZE_MAX;

// The way from the root, put into words only for an error.
struct Step {
  const std::string& path;
  const Step* parent = nullptr;
  const char* name = "";
  size_t item = kNoItem;

  std::string where() const {
    const std::string before = parent ? parent->where() : std::string();
    if (item != kNoItem) return fmt::format("{}[{}]", before, item);
    return before.empty() || *name == '\0' ? before + name : fmt::format("{}.{}", before, name);
  }
  tl::unexpected<Error> bad(const std::string& expected, const json& found) const {
    constexpr size_t kMaxShown = 60;
    const bool isLong =
        found.is_structured() || (found.is_string() && found.get_ref<const std::string&>().size() > kMaxShown);
    const std::string shown = isLong ? std::string(found.type_name()) : found.dump();
    return GltfPlace{path, where().empty() ? "JSON" : where()}.bad(expected, shown);
  }
};

Result<json> takeObject(const Step& step, const JsonShape& shape, json& object);

// Writers of JSON differ in whether 2.0 is an integer; a fraction is none.
Result<json> takeInteger(const Step& step, uint64_t end, const json& value) {
  if (value.is_number_unsigned() && value.get<uint64_t>() < end) return value;
  if (value.is_number_float()) {
    const double number = value.get<double>();
    constexpr double kExactEnd = 9007199254740992.0;
    if (number >= 0 && number < kExactEnd && number < double(end) && number == double(uint64_t(number)))
      return json(uint64_t(number));
  }
  return step.bad(fmt::format("an integer of 0 to {}", end - 1), value);
}

Result<json> takeIndices(const Step& step, json& value) {
  if (!value.is_object()) return step.bad("an object", value);
  json taken = json::object();
  for (auto& [key, item] : value.items()) {
    FARCELL_ASSIGN(taken[key], takeInteger({step.path, &step, key.c_str()}, kIndexEnd, item));
  }
  return taken;
}

Result<json> takeValue(const Step& step, const JsonMember& member, json& value) {
  switch (member.kind) {
    case JsonKind::index:
      return takeInteger(step, kIndexEnd, value);
    case JsonKind::size:
      return takeInteger(step, uint64_t{1} << 63, value);
    case JsonKind::number:
      if (!value.is_number()) return step.bad("a number", value);
      return json(value.get<double>());
    case JsonKind::string:
      if (!value.is_string()) return step.bad("a string", value);
      return std::move(value);
    case JsonKind::boolean:
      if (!value.is_boolean()) return step.bad("true or false", value);
      return value;
    case JsonKind::object:
      return takeObject(step, *member.shape, value);
    case JsonKind::indices:
      return takeIndices(step, value);
  }
  return step.bad("a known kind", value);
}

Result<json> takeList(const Step& step, const JsonMember& member, json& value) {
  if (!value.is_array()) return step.bad("an array", value);
  if (member.length != 0 && value.size() != member.length)
    return GltfPlace{step.path, step.where()}.bad(fmt::format("{} numbers", member.length),
                                                  fmt::format("{}", value.size()));
  json taken = json::array();
  taken.get_ref<json::array_t&>().reserve(value.size());
  for (size_t i = 0; i < value.size(); ++i) {
    FARCELL_ASSIGN(json item, takeValue({step.path, &step, "", i}, member, value[i]));
    taken.push_back(std::move(item));
  }
  return taken;
}

Result<json> takeObject(const Step& step, const JsonShape& shape, json& object) {
  if (!object.is_object()) return step.bad("an object", object);
  json taken = json::object();
  for (const JsonMember& member : shape.members) {
    const auto found = object.find(member.name);
    const Step at{step.path, &step, member.name};
    if (found == object.end()) {
      if (member.isRequired) return GltfPlace{step.path, at.where()}.bad("this member", "none");
      continue;
    }
    FARCELL_ASSIGN(taken[member.name], member.isList ? takeList(at, member, *found) : takeValue(at, member, *found));
  }
  return taken;
}

}  // namespace

Result<json> takeShape(const std::string& path, const JsonShape& shape, json& object) {
  return takeObject({path}, shape, object);
}

}  // namespace farcell
