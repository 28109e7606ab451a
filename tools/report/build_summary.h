// The tables that end a `farcell build`, for people: what took how long, what the pack is made of, what it left out.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace farcell {

struct BuildSummary {
  struct Stage {
    std::string name;
    double seconds = 0;                // wall
    std::optional<double> cpuSeconds;  // of all threads
    uint64_t units = 0;                // done in it; 0: no rate is shown
    std::string unit;                  // "views"
    std::optional<uint64_t> bytes;     // written by it
  };
  struct Part {
    std::string name;
    uint64_t bytes = 0;
  };
  struct LeftOut {
    std::string what;  // "views", "triangles"
    std::string why;   // "empty"
    uint64_t count = 0;
    std::optional<uint64_t> bytesSaved;
  };

  // How far the image errors expected of cells are from what they would be measured to be.
  struct Expected {
    std::string way;  // to draw them: "mesh"
    uint64_t cells = 0;
    std::vector<std::string> scales;  // texels: ".5 px"
    std::vector<double> median;       // |expected / measured - 1|, by scale
    std::vector<double> ninetieth;
  };

  // The views of a kind of cells, as chosen.
  struct Form {
    std::string kind;  // "level 5 leaves"
    uint64_t cells = 0;
    int views = 0;
    int imageSize = 0;
    double bytes = 0;  // a cell, as measured
  };

  uint64_t triangles = 0;
  uint64_t leaves = 0;
  uint64_t innerCells = 0;
  uint64_t viewsKept = 0;
  uint64_t viewsBaked = 0;
  std::vector<Stage> stages;
  double seconds = 0;
  double cpuSeconds = 0;
  std::vector<Part> parts;  // of the pack; what they do not add up to is told as "other"
  uint64_t packBytes = 0;
  uint64_t packBudget = 0;  // bytes; 0: none
  uint64_t peakRssBytes = 0;
  uint64_t memoryLimit = 0;  // bytes; 0: none
  std::vector<LeftOut> leftOut;
  std::vector<Expected> expected;
  std::vector<Form> forms;
};

// At most 80 columns, unless a reason is long.
std::string buildSummaryText(const BuildSummary& summary);

}  // namespace farcell
