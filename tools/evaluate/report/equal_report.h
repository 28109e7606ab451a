// equalTable() as it is written: the member "equal" of report.json, equal.csv, and a table to read.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tools/evaluate/report/equal.h"

namespace farcell {

// {subject, kinds: [...], cameras: [{camera, stem, ms, error, kinds: [{kind, errorThere, msThere}]}]}
nlohmann::ordered_json equalJson(const EqualTable& table);
// One line a camera and kind.
std::string equalCsv(const EqualTable& table);
// One line a kind; empty without a subject or other kinds.
std::string equalText(const EqualTable& table);

}  // namespace farcell
