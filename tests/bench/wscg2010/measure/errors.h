// The paper's error against distance, for the ways of making impostors that the paper compares and those it leaves
// open.
#pragma once

#include <string>
#include <vector>

#include "tests/bench/wscg2010/measure/references.h"
#include "tests/bench/wscg2010/measure/table.h"
#include "tests/bench/wscg2010/scene/cameras.h"

namespace farcell::wscg {

// One way of drawing a scene.
struct Variant {
  std::string name;
  int depth = 4;
  ImpostorSettings impostors;
  DrawSettings draw;
};
// Names of variants that other parts look for.
inline constexpr const char* kPaperVariant = "depth 4";
inline constexpr const char* kTrianglesVariant = "triangles, 1 sample";

// All variants that are measured. Those of one depth stand together, and those of the same images.
std::vector<Variant> allVariants();
// The paper's way at a depth, and named changes of it; for pictures and times.
Variant paperVariant(int depth);

struct ErrorSettings {
  int width = 1024;
  int height = 768;
  int truthSamples = 64;
  std::vector<double> distances = {.5, 1, 2, 4};  // diameters
  int levelDirections = 4;                        // per distance, besides the steep one
  std::vector<Variant> variants = allVariants();
};

struct ErrorRow {
  std::string scene;
  std::string variant;
  std::string camera;
  double distance = 0;
  bool steep = false;
  size_t billboards = 0;
  Metrics toSingle;  // against the triangles at one sample a pixel, as in the paper
  Metrics toTruth;   // against truthSamples rays a pixel
};

struct CellCount {
  std::string scene;
  int depth = 0;
  size_t occupied = 0;
};

struct ErrorResults {
  std::vector<ErrorRow> rows;
  std::vector<CellCount> cells;
};

// REQUIRES: a current context.
Result<ErrorResults> measureErrors(const Scene& scene, const FullGeometry& full, const ErrorSettings& settings);

// Mean over the level cameras at a distance (or over all distances, < 0) of one figure; 0 where there is no such row.
double meanOver(const ErrorResults& results, const std::string& scene, const std::string& variant, double distance,
                double (*figure)(const ErrorRow&));
// The same of the steep camera.
double steepOver(const ErrorResults& results, const std::string& scene, const std::string& variant, double distance,
                 double (*figure)(const ErrorRow&));
double toSingle(const ErrorRow& row);  // paperError
double toTruth(const ErrorRow& row);
double holes(const ErrorRow& row);  // holeRate against the triangles at one sample
double leaks(const ErrorRow& row);  // leakRate against them

Table errorCsv(const ErrorResults& results);

}  // namespace farcell::wscg
