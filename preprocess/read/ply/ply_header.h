// What a PLY file says about itself (Greg Turk, "The PLY Polygon File Format", 1994).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cache/base/file.h"

namespace farcell {

enum class PlyEncoding { ascii, littleEndian, bigEndian };

// Scalars, by either of their two names in the file ("uchar" or "uint8").
enum class PlyType : uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
size_t sizeBytes(PlyType type);
bool isReal(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;   // of the value, or of each item of a list
  std::optional<PlyType> countType;  // lists only; never a real
};

struct PlyElement {
  std::string name;
  uint64_t count = 0;
  std::vector<PlyProperty> properties;

  std::optional<size_t> find(std::string_view property) const;
  bool hasLists() const;
  uint64_t rowBytes() const;  // binary: the least a row can take (every list empty); exact without lists
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;
  uint64_t bodyOffset = 0;
  uint64_t bodyLine = 1;  // the number of the line that starts there
};

bool startsLikePly(const InputFile& file);
// Also refuses counts that the rest of the file cannot hold, so that callers may allocate by them.
Result<PlyHeader> readPlyHeader(const InputFile& file);

}  // namespace farcell
