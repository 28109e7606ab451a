// The paper's stress test: a camera on its way around the model, so fast that every frame needs other images.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/bench/wscg2010/measure/errors.h"

namespace farcell::wscg {

// Where a frame's textures come from.
enum class Source {
  triangles,     // no impostors at all: the full geometry
  resident,      // textures are there already
  memory,        // made from memory for each frame and deleted after it: the paper's upload test
  diskWarm,      // the same, read from a file that the operating system has in memory
  diskCold,      // the same, after the operating system was asked to forget the file
  deflatedWarm,  // as diskWarm and diskCold, zlib 6, inflated by libdeflate
  deflatedCold,
};
inline constexpr size_t kSourceCount = 7;
const char* sourceName(Source source);

struct TimeSettings {
  int width = 1024;
  int height = 768;
  int frames = 24;  // one turn
  double distance = 1;
  double elevationDeg = 35;
  std::filesystem::path scratchDirectory;
};

// Milliseconds of wall time: medians over the frames; parts by one thread, in turn.
struct TimeRow {
  std::string scene;
  std::string variant;
  Source source = Source::triangles;
  double frameMs = 0;
  double readMs = 0, inflateMs = 0, uploadMs = 0, drawMs = 0;  // upload: make the textures; draw: draw and wait
  double readBytes = 0;                                        // mean per frame, of files
  double textureBytes = 0;                                     // mean per frame, as uploaded
  double items = 0;                                            // mean billboards, or triangles
  double newImages = 0;  // mean share of a frame's images that the frame before did not use
  double inMemory = 0;   // worst share of the file that was still in memory after asking to forget it
};

// REQUIRES: a current context.
Result<std::vector<TimeRow>> measureTimes(const CellIndex& index, const FullGeometry& full, const Variant& variant,
                                          const TimeSettings& settings);

const TimeRow* findTime(const std::vector<TimeRow>& rows, const std::string& scene, Source source);
// What most of the frame's time goes into: "draw", "upload", "read" or "inflate".
std::string boundOf(const TimeRow& row);

}  // namespace farcell::wscg
