#include "tools/evaluate/report/page.h"

#include <nlohmann/json.hpp>
#include <string_view>

#include "cache/base/check.h"
#include "tools/evaluate/report/page_files.h"

namespace farcell {
namespace {

std::string_view pageFile(const std::string& name) {
  const std::string_view text = reportPageFile("tools/evaluate/report/page/" + name);
  FARCELL_CHECK(text.data() != nullptr);
  return text;
}

// In the order in which they build on each other.
std::string script() {
  std::string text;
  for (const char* name :
       {"format.js", "model.js", "scale.js", "labels.js", "plot.js", "plot_controls.js", "front.js", "table.js",
        "equal.js", "suns.js", "pictures.js", "paths.js", "main.js"})
    text += pageFile(name);
  return text;
}

// ASCII, and no "<" that could end the script element or begin a comment in it. JSON has "<" in strings only.
std::string scriptSafe(const nlohmann::ordered_json& json) {
  std::string text;
  for (const char c : json.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace))
    text += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return text;
}

std::string partOf(std::string_view name, const nlohmann::ordered_json& report) {
  if (name == "style") return std::string(pageFile("style.css"));
  if (name == "errors") return std::string(pageFile("errors.js"));
  if (name == "script") return script();
  FARCELL_CHECK_EQ(name, "data");
  return scriptSafe(report);
}

}  // namespace

// What is put in is not searched again.
std::string reportPage(const nlohmann::ordered_json& report) {
  std::string page;
  std::string_view rest = pageFile("page.html");
  for (size_t open = rest.find("{{"); open != std::string_view::npos; open = rest.find("{{")) {
    const size_t close = rest.find("}}", open);
    page += rest.substr(0, open);
    page += partOf(rest.substr(open + 2, close - open - 2), report);
    rest.remove_prefix(close + 2);
  }
  return page += rest;
}

}  // namespace farcell
