// Members of a scene file, each knowing its place for messages.
#pragma once

#include <glm/vec3.hpp>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "cache/base/result.h"

namespace farcell {

// Parses a document whose nesting is bounded and whose objects name each member once. `file` is for messages.
Result<nlohmann::json> parseSceneJson(const std::string& text, const std::string& file);

// A value and where it stands; both, and `file`, must outlive it.
class SceneValue {
 public:
  SceneValue(const std::string& file, std::string where, const nlohmann::json& json)
      : file_(file), where_(std::move(where)), json_(json) {}

  const nlohmann::json& json() const { return json_; }
  // "scene.json: files[2].scale: expected ..., found ..."
  tl::unexpected<Error> bad(const std::string& expected) const;
  tl::unexpected<Error> bad(const std::string& expected, const std::string& found) const;

  // Whether this is an object of no other members than these.
  Result<> expectMembers(std::initializer_list<std::string_view> known) const;
  bool has(const char* name) const { return json_.contains(name); }
  SceneValue member(const char* name) const;       // REQUIRES: has(name)
  SceneValue element(size_t index) const;          // REQUIRES: of an array that long
  Result<> expectNumbers(size_t count) const;      // an array of as many; the elements are not looked at
  Result<size_t> objectCount(size_t limit) const;  // length of an array that is not empty; exhausted above the limit

  Result<double> number() const;
  Result<glm::dvec3> vector() const;
  Result<std::string> string() const;  // not empty, without a zero byte

 private:
  const std::string& file_;
  std::string where_;
  const nlohmann::json& json_;
};

}  // namespace farcell
