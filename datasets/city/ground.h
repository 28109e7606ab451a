// The surface of one block and of the halves of the streets around it.
#pragma once

#include "datasets/city/mesh.h"
#include "datasets/random/random.h"

namespace farcell::city {

inline constexpr double kPavementM = 3.2;
inline constexpr double kKerbM = 0.14;  // the block's surface above the street's

// One axis of a block: from the middle of one street to the middle of the next.
struct Span {
  double low = 0;
  double high = 0;
  double halfStreetLowM = 0;
  double halfStreetHighM = 0;

  double kerbLow() const { return low + halfStreetLowM; }
  double kerbHigh() const { return high - halfStreetHighM; }
  double innerLow() const { return kerbLow() + kPavementM; }
  double innerHigh() const { return kerbHigh() - kPavementM; }
};

// The same for all blocks of a row or column, so that neighbours meet.
Span blockSpan(uint64_t seed, int64_t axis, int64_t index);

struct Plot {
  Span x;
  Span y;
};

enum class Surface { lawn, paving, gravel };

// Height of what people walk on within the kerbs.
double plotHeight(uint64_t seed, double x, double y);

void addGround(Mesh& mesh, uint64_t seed, const Plot& plot, Surface surface, Random& random);

}  // namespace farcell::city
