#include "datasets/city/ground.h"

#include "datasets/city/terrain.h"

namespace farcell::city {
namespace {

constexpr double kStepM = 9;      // of the surface's grid
constexpr double kPaintM = 0.03;  // of road markings above it
constexpr Colour kPaint{222, 222, 214};

// Where the grid's lines lie along one axis: middle of the street, kerb, inner edge of the pavement, and so on back.
std::vector<double> linesOf(const Span& span) {
  std::vector<double> lines = {span.low, span.kerbLow(), span.innerLow()};
  const double inner = span.innerHigh() - span.innerLow();
  const int steps = std::max(1, static_cast<int>(inner / kStepM + 0.5));
  for (int i = 1; i < steps; ++i) lines.push_back(span.innerLow() + inner * i / steps);
  lines.insert(lines.end(), {span.innerHigh(), span.kerbHigh(), span.high});
  return lines;
}

enum class Zone { street, pavement, inner };

Zone zoneOf(size_t cell, size_t cells) {
  const size_t fromEdge = std::min(cell, cells - 1 - cell);
  return fromEdge == 0 ? Zone::street : fromEdge == 1 ? Zone::pavement : Zone::inner;
}

Colour colourOf(Zone zone, Surface surface, Random& random) {
  if (zone == Zone::street) return scaled({84, 84, 88}, random.range(0.95, 1.05));
  if (zone == Zone::pavement) return scaled({164, 160, 152}, random.range(0.94, 1.05));
  switch (surface) {
    case Surface::lawn:
      return scaled({112, 138, 70}, random.range(0.86, 1.1));
    case Surface::paving:
      return scaled({178, 168, 152}, random.range(0.92, 1.05));
    case Surface::gravel:
      return scaled({170, 158, 132}, random.range(0.92, 1.06));
  }
  return {};
}

struct Painter {
  Mesh& mesh;
  uint64_t seed;

  glm::dvec3 on(double x, double y, double above) const { return glm::dvec3(x, y, groundHeight(seed, x, y) + above); }
  void rectangle(double x0, double y0, double x1, double y1, double above, Colour colour) const {
    mesh.quad(on(x0, y0, above), on(x1, y0, above), on(x1, y1, above), on(x0, y1, above), colour);
  }
};

// The upright face of the kerb along one line of the grid, from point to point.
void addKerb(const Painter& painter, std::span<const glm::dvec3> line) {
  constexpr Colour kStone{146, 144, 140};
  for (size_t i = 0; i + 1 < line.size(); ++i) {
    const glm::dvec3 a = line[i];
    const glm::dvec3 b = line[i + 1];
    painter.mesh.quad(painter.on(a.x, a.y, 0), painter.on(b.x, b.y, 0), painter.on(b.x, b.y, kKerbM),
                      painter.on(a.x, a.y, kKerbM), kStone);
  }
}

void addKerbs(const Painter& painter, const Plot& plot, std::span<const double> xs, std::span<const double> ys) {
  std::array<std::vector<glm::dvec3>, 4> lines;
  for (size_t i = 1; i + 1 < xs.size(); ++i) {
    lines[0].emplace_back(xs[i], plot.y.kerbLow(), 0);
    lines[1].emplace_back(xs[xs.size() - 1 - i], plot.y.kerbHigh(), 0);
  }
  for (size_t i = 1; i + 1 < ys.size(); ++i) {
    lines[2].emplace_back(plot.x.kerbHigh(), ys[i], 0);
    lines[3].emplace_back(plot.x.kerbLow(), ys[ys.size() - 1 - i], 0);
  }
  for (const auto& line : lines) addKerb(painter, line);
}

// Half of the dashed line in the middle of each street, and half of the zebra crossings at its ends. `across` are the
// sides along one axis, `along` runs down the street.
template <class Rectangle>
void addMarkings(const Span& across, const Span& along, const Rectangle& rectangle) {
  constexpr double kDashM = 3;
  constexpr double kLineM = 0.09;
  constexpr double kStripeM = 0.5;
  const double start = along.kerbLow() + 5;
  const double end = along.kerbHigh() - 5;
  for (double at = start; at + kDashM < end; at += 2 * kDashM) {
    rectangle(across.low, at, across.low + kLineM, at + kDashM);
    rectangle(across.high - kLineM, at, across.high, at + kDashM);
  }
  for (const double at : {along.kerbLow() + 0.8, along.kerbHigh() - 3.6}) {
    for (double side = 0.25; side + kStripeM < across.halfStreetLowM; side += 2 * kStripeM)
      rectangle(across.low + side, at, across.low + side + kStripeM, at + 2.8);
    for (double side = 0.25; side + kStripeM < across.halfStreetHighM; side += 2 * kStripeM)
      rectangle(across.high - side - kStripeM, at, across.high - side, at + 2.8);
  }
}

}  // namespace

Span blockSpan(uint64_t seed, int64_t axis, int64_t index) {
  constexpr double kPitchM = 100;
  constexpr double kAvenueHalfM = 8.5;
  constexpr double kStreetHalfM = 5.5;
  const auto line = [&](int64_t i) {
    return kPitchM * static_cast<double>(i) + 26 * (unitOf(keyOf(seed, 11, axis, i)) - 0.5);
  };
  const auto half = [](int64_t i) { return i % 4 == 0 ? kAvenueHalfM : kStreetHalfM; };
  return {line(index), line(index + 1), half(index), half(index + 1)};
}

double plotHeight(uint64_t seed, double x, double y) { return groundHeight(seed, x, y) + kKerbM; }

void addGround(Mesh& mesh, uint64_t seed, const Plot& plot, Surface surface, Random& random) {
  const std::vector<double> xs = linesOf(plot.x);
  const std::vector<double> ys = linesOf(plot.y);
  const Painter painter{mesh, seed};
  for (size_t j = 0; j + 1 < ys.size(); ++j) {
    for (size_t i = 0; i + 1 < xs.size(); ++i) {
      const Zone zone = std::min(zoneOf(i, xs.size() - 1), zoneOf(j, ys.size() - 1));
      painter.rectangle(xs[i], ys[j], xs[i + 1], ys[j + 1], zone == Zone::street ? 0 : kKerbM,
                        colourOf(zone, surface, random));
    }
  }
  addKerbs(painter, plot, xs, ys);
  addMarkings(plot.x, plot.y,
              [&](double a0, double b0, double a1, double b1) { painter.rectangle(a0, b0, a1, b1, kPaintM, kPaint); });
  addMarkings(plot.y, plot.x,
              [&](double a0, double b0, double a1, double b1) { painter.rectangle(b0, a0, b1, a1, kPaintM, kPaint); });
}

}  // namespace farcell::city
