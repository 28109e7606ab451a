// What the parts of a report share: settings and missing figures as JSON, lines of CSV, text for a terminal.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "tools/evaluate/plan/renderers.h"

namespace farcell {

// The settings that the renderer uses.
nlohmann::ordered_json settingsJson(const RendererPlan& plan);
nlohmann::ordered_json optionalJson(const std::optional<double>& value);  // null for nothing

// The members of an object as a line of CSV (RFC 4180), objects in it one column a member: frameMs.median. Its member
// "settings", if any, is one column of text, for settings differ from renderer to renderer. names: of the columns.
std::string csvLine(nlohmann::ordered_json object, bool names);

std::string optionalText(const std::optional<double>& value);
// A name from outside goes to a terminal: no control characters.
std::string printable(std::string text);

}  // namespace farcell
