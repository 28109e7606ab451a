#include "preprocess/read/scene/scene_json.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace farcell {
namespace {

using Json = nlohmann::json;

constexpr int kMaxDepth = 8;
constexpr size_t kMaxQuoted = 60;

// What the parser itself lets pass; a callback of its, which never lets it keep what nests too deep.
class DocumentGuard {
 public:
  bool operator()(int depth, Json::parse_event_t event, const Json& value) {
    using Event = Json::parse_event_t;
    tooDeep_ |= depth > kMaxDepth;
    if (event == Event::object_start && !tooDeep_) names_.emplace_back();
    if (event == Event::object_end && !tooDeep_) names_.pop_back();
    if (event == Event::key && !tooDeep_ && !names_.back().insert(value.get<std::string>()).second && twice_.empty())
      twice_ = value.get<std::string>();
    return !tooDeep_;
  }
  bool tooDeep() const { return tooDeep_; }
  const std::string& twice() const { return twice_; }

 private:
  std::vector<std::set<std::string>> names_;  // of the objects that are open
  std::string twice_;
  bool tooDeep_ = false;
};

// In ASCII, whatever it holds.
std::string quoted(const std::string& text) {
  return Json(text.substr(0, kMaxQuoted)).dump(-1, ' ', true, Json::error_handler_t::replace);
}

}  // namespace

Result<Json> parseSceneJson(const std::string& text, const std::string& file) {
  try {
    DocumentGuard guard;
    Json json = Json::parse(text, std::ref(guard));
    if (guard.tooDeep())
      return fail(ErrorKind::corrupt, "{}: expected at most {} levels of nesting, found more", file, kMaxDepth);
    if (!guard.twice().empty())
      return fail(ErrorKind::corrupt, "{}: expected each member of an object once, found {} twice", file,
                  quoted(guard.twice()));
    return json;
  } catch (const Json::parse_error& error) {
    return corrupt(file, error.byte > 0 ? error.byte - 1 : 0, "JSON", error.what());
  } catch (const Json::exception& error) {
    return fail(ErrorKind::corrupt, "{}: expected JSON, found {}", file, error.what());
  }
}

tl::unexpected<Error> SceneValue::bad(const std::string& expected, const std::string& found) const {
  return fail(ErrorKind::corrupt, "{}: {}: expected {}, found {}", file_, where_, expected, found);
}

tl::unexpected<Error> SceneValue::bad(const std::string& expected) const {
  if (json_.is_array()) return bad(expected, fmt::format("an array of {} elements", json_.size()));
  if (json_.is_object()) return bad(expected, fmt::format("an object of {} members", json_.size()));
  return bad(expected, json_.is_string() ? quoted(json_.get_ref<const std::string&>()) : json_.dump());
}

Result<> SceneValue::expectMembers(std::initializer_list<std::string_view> known) const {
  if (!json_.is_object()) return bad("an object");
  for (const auto& [name, value] : json_.items())
    if (std::find(known.begin(), known.end(), name) == known.end())
      return bad(fmt::format("no members but {}", fmt::join(known, ", ")), quoted(name));
  return {};
}

SceneValue SceneValue::member(const char* name) const {
  return {file_, where_ == "scene" ? name : fmt::format("{}.{}", where_, name), json_.at(name)};
}

SceneValue SceneValue::element(size_t index) const {
  return {file_, fmt::format("{}[{}]", where_, index), json_.at(index)};
}

Result<> SceneValue::expectNumbers(size_t count) const {
  if (json_.is_array() && json_.size() == count) return {};
  return bad(fmt::format("an array of {} numbers", count));
}

Result<size_t> SceneValue::objectCount(size_t limit) const {
  if (!json_.is_array() || json_.empty()) return bad("an array of at least one object");
  if (json_.size() <= limit) return json_.size();
  return fail(ErrorKind::exhausted, "{}: {}: expected at most {} elements, found {}", file_, where_, limit,
              json_.size());
}

Result<double> SceneValue::number() const {
  if (json_.is_number() && std::isfinite(json_.get<double>())) return json_.get<double>();
  return bad("a finite number");
}

Result<glm::dvec3> SceneValue::vector() const {
  FARCELL_TRY(expectNumbers(3));
  glm::dvec3 vector;
  for (int axis = 0; axis < 3; ++axis) {
    FARCELL_ASSIGN(vector[axis], element(static_cast<size_t>(axis)).number());
  }
  return vector;
}

Result<std::string> SceneValue::string() const {
  if (json_.is_string()) {
    const auto& text = json_.get_ref<const std::string&>();
    if (!text.empty() && text.find('\0') == std::string::npos) return text;
  }
  return bad("a string that is not empty");
}

}  // namespace farcell
