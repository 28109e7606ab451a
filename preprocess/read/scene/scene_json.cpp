#include "preprocess/read/scene/scene_json.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <vector>

namespace farcell {
namespace {

using Json = nlohmann::json;

constexpr size_t kMaxDepth = 8;
constexpr size_t kMaxQuoted = 60;

// Reads a document without keeping it, for what the parser itself lets pass. (Its own callback for that looks through
// all of an array at each object in it.)
class DocumentGuard final : public nlohmann::json_sax<Json> {
 public:
  const std::optional<Error>& failure() const { return failure_; }
  explicit DocumentGuard(const std::string& file) : file_(file) {}

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(size_t) override { return open(); }
  bool start_array(size_t) override { return open(); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override;
  bool parse_error(size_t byte, const std::string& token, const Json::exception& error) override;

 private:
  bool open();
  bool close() {
    names_.pop_back();
    return true;
  }

  const std::string& file_;
  std::vector<std::set<std::string>> names_;  // met so far in what is open
  std::optional<Error> failure_;
};

// The beginning of a text as a JSON string, whatever it holds.
std::string inAscii(const std::string& text) {
  return Json(text.substr(0, kMaxQuoted)).dump(-1, ' ', true, Json::error_handler_t::replace);
}

bool DocumentGuard::key(string_t& name) {
  if (names_.back().insert(name).second) return true;
  failure_ =
      fail(ErrorKind::corrupt, "{}: expected each member of an object once, found {} twice", file_, inAscii(name))
          .value();
  return false;
}

bool DocumentGuard::open() {
  names_.emplace_back();
  if (names_.size() <= kMaxDepth) return true;
  failure_ =
      fail(ErrorKind::corrupt, "{}: expected at most {} levels of nesting, found more", file_, kMaxDepth).value();
  return false;
}

bool DocumentGuard::parse_error(size_t byte, const std::string&, const Json::exception& error) {
  failure_ = corrupt(file_, byte > 0 ? byte - 1 : 0, "JSON", error.what()).value();
  return false;
}

}  // namespace

Result<Json> parseSceneJson(const std::string& text, const std::string& file) {
  DocumentGuard guard(file);
  if (!Json::sax_parse(text, &guard)) return tl::unexpected<Error>(*guard.failure());
  return Json::parse(text);
}

tl::unexpected<Error> SceneValue::bad(const std::string& expected, const std::string& found) const {
  return fail(ErrorKind::corrupt, "{}: {}: expected {}, found {}", file_, where_, expected, found);
}

tl::unexpected<Error> SceneValue::bad(const std::string& expected) const {
  if (json_.is_array()) return bad(expected, fmt::format("an array of {} elements", json_.size()));
  if (json_.is_object()) return bad(expected, fmt::format("an object of {} members", json_.size()));
  return bad(expected, json_.is_string() ? inAscii(json_.get_ref<const std::string&>()) : json_.dump());
}

Result<> SceneValue::expectMembers(std::initializer_list<std::string_view> known) const {
  if (!json_.is_object()) return bad("an object");
  for (const auto& [name, value] : json_.items())
    if (std::find(known.begin(), known.end(), name) == known.end())
      return bad(fmt::format("no members but {}", fmt::join(known, ", ")), inAscii(name));
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
