// Tables of results: CSV for machines, Markdown for people.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cache/base/result.h"

namespace farcell::wscg {

struct Table {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;  // each as long as the header

  std::string csv() const;  // no cell holds a comma
  std::string markdown() const;
};

// Fixed point with `digits` after it; "-" for what is not a number.
std::string number(double value, int digits);
// A share as "12.3 %".
std::string percent(double share);

double median(std::vector<double> values);  // 0 of none
double mean(const std::vector<double>& values);

}  // namespace farcell::wscg
