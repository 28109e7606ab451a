// A procedural city of any size, the same for the same settings on every machine and with any number of threads.
// Metres, z up, around the origin; streets and blocks on rolling ground, every house, tree and car made of triangles.
//
// How it comes about: 1. block.h numbers the blocks in a spiral and says what stands on each, from a hash of seed,
// block and lot alone; 2. ground.h lays streets and surface, building.h (facade.h, roof.h) and outdoors.h fill them,
// all into a Mesh of that one block; 3. city.cpp takes blocks until there are enough triangles, cuts the last one
// short thing by thing, and makes each anew for every part of the file.
#pragma once

#include <cstdint>
#include <filesystem>

#include "cache/base/progress.h"
#include "cache/base/result.h"

namespace farcell {

struct CitySettings {
  uint64_t triangles = 5'000'000;  // wished; what is made is within 5 % from 10,000 on, and never more
  uint64_t seed = 1;
  int threads = 0;  // 0: all the machine offers
};

inline constexpr uint64_t kMinCityTriangles = 2'000;

struct CityCounts {
  uint64_t triangles = 0;
  uint64_t vertices = 0;
  uint64_t blocks = 0;
  uint64_t bytes = 0;  // of the file
};

// How large the city of these settings is, without writing it. invalidArgument below kMinCityTriangles; unsupported
// when it has more vertices than a PLY file's 32-bit indices can name (some 4 billion).
Result<CityCounts> countCity(const CitySettings& settings, Progress& progress);

// Writes it as binary little-endian PLY: float x y z, uchar red green blue; faces. Memory does not grow with the city:
// it is generated three times, to count, for the vertices and for the faces.
Result<CityCounts> writeCity(const CitySettings& settings, const std::filesystem::path& path, Progress& progress);

}  // namespace farcell
