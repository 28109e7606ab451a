// The file that `farcell batch` works off:
//
//   {"datasets": [{"name": "city", "meshes": ["city.ply"], "output": "city.far", "options": {"views": 42, "unit":
//   "m"}}]}
//
// Paths are relative to the file. `output` is a file name, <name>.far when absent. `options` are the long options of
// `farcell build`: a string or number is an option's value, true gives a flag, false leaves it out.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cache/base/result.h"

namespace farcell {

struct DataSet {
  std::string name;                  // a file name, of no other data set
  std::vector<std::string> meshes;   // as they stand in the file
  std::string output;                // a file name that ends in .far, of no other data set
  std::vector<std::string> options;  // "--views=42", by name
};

constexpr size_t kMaxDataSets = 100'000;

// Errors name the file and the member: "datasets.json: list.datasets[3].name: expected ..., found ...". What is not
// known is an error, as are names and outputs that come twice (without regard to case: not all file systems have one).
Result<std::vector<DataSet>> parseDataSets(const std::string& text, const std::string& file);
Result<std::vector<DataSet>> readDataSets(const std::filesystem::path& path);

}  // namespace farcell
