// The report as one page that opens from disk: index.html beside the pictures, which it refers to by name.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace farcell {

// report: what reportJson() made. Its text cannot become markup, whatever names cameras have.
std::string reportPage(const nlohmann::ordered_json& report);

}  // namespace farcell
