#include "datasets/city/roof.h"

#include <cmath>

namespace farcell::city {
namespace {

constexpr double kEaveReachM = 0.45;
constexpr double kThicknessM = 0.16;

struct Slope {
  glm::dvec3 eaveLeft;
  glm::dvec3 eaveRight;
  glm::dvec3 ridgeRight;
  glm::dvec3 ridgeLeft;  // may be ridgeRight: a triangle
};

glm::dvec3 between(glm::dvec3 a, glm::dvec3 b, double share) { return a + (b - a) * share; }

// Rows of tiles, each a little over the one below and of its own colour.
void addSlope(Mesh& mesh, const Slope& slope, Colour tiles, Random& random) {
  const double runM = glm::length(slope.ridgeLeft - slope.eaveLeft);
  const double widthM = glm::length(slope.eaveRight - slope.eaveLeft);
  const int rows = std::clamp(static_cast<int>(runM / 0.9), 2, 12);
  const int columns = std::clamp(static_cast<int>(widthM / 2.2), 2, 12);
  const glm::dvec3 lip(0, 0, 0.05);
  const bool pointed = glm::length(slope.ridgeRight - slope.ridgeLeft) < 1e-6;
  for (int row = 0; row < rows; ++row) {
    const auto point = [&](int r, int column) {
      const double up = static_cast<double>(r) / rows;
      return between(between(slope.eaveLeft, slope.ridgeLeft, up), between(slope.eaveRight, slope.ridgeRight, up),
                     static_cast<double>(column) / columns);
    };
    for (int column = 0; column < columns; ++column) {
      const Colour colour = scaled(tiles, random.range(0.9, 1.08));
      const glm::dvec3 a = point(row, column) + lip;
      const glm::dvec3 b = point(row, column + 1) + lip;
      if (pointed && row == rows - 1) {
        mesh.triangle(a, b, point(rows, 0), colour);
      } else {
        mesh.quad(a, b, point(row + 1, column + 1), point(row + 1, column), colour);
      }
    }
    mesh.quad(point(row, 0), point(row, columns), point(row, columns) + lip, point(row, 0) + lip, scaled(tiles, 0.7));
  }
}

// The board along an edge and the plane underneath.
void addUnderside(Mesh& mesh, const Slope& slope, Colour colour) {
  const glm::dvec3 down(0, 0, -kThicknessM);
  mesh.quad(slope.eaveLeft + down, slope.eaveRight + down, slope.eaveRight, slope.eaveLeft, colour);
  const std::array<glm::dvec3, 4> under = {slope.eaveLeft + down, slope.ridgeLeft + down, slope.ridgeRight + down,
                                           slope.eaveRight + down};
  mesh.triangle(under[0], under[1], under[3], colour);
  if (glm::length(under[1] - under[2]) > 1e-6) mesh.triangle(under[1], under[2], under[3], colour);
}

void addGables(Mesh& mesh, const Frame& frame, const RoofShape& shape, double rise, const FacadeStyle& style) {
  const double middle = -shape.depthM / 2;
  mesh.triangle(frame.at(0, 0, -shape.depthM), frame.at(0, 0, 0), frame.at(0, rise, middle), style.wall);
  mesh.triangle(frame.at(shape.widthM, 0, 0), frame.at(shape.widthM, 0, -shape.depthM),
                frame.at(shape.widthM, rise, middle), style.wall);
}

std::vector<Slope> slopesOf(const Frame& frame, const RoofShape& shape, double rise) {
  const double drop = -kEaveReachM * shape.slope;
  const double middle = -shape.depthM / 2;
  const bool hipped = shape.kind == RoofKind::hipped;
  const double reach = hipped ? kEaveReachM : shape.endReachM;
  const double ridgeStart = hipped ? shape.depthM / 2 : -reach;
  const glm::dvec3 frontLeft = frame.at(-reach, drop, kEaveReachM);
  const glm::dvec3 frontRight = frame.at(shape.widthM + reach, drop, kEaveReachM);
  const glm::dvec3 backLeft = frame.at(-reach, drop, -shape.depthM - kEaveReachM);
  const glm::dvec3 backRight = frame.at(shape.widthM + reach, drop, -shape.depthM - kEaveReachM);
  const glm::dvec3 ridgeLeft = frame.at(ridgeStart, rise, middle);
  const glm::dvec3 ridgeRight = frame.at(shape.widthM - ridgeStart, rise, middle);
  std::vector<Slope> slopes = {{frontLeft, frontRight, ridgeRight, ridgeLeft},
                               {backRight, backLeft, ridgeLeft, ridgeRight}};
  if (hipped) {
    slopes.push_back({frontRight, backRight, ridgeRight, ridgeRight});
    slopes.push_back({backLeft, frontLeft, ridgeLeft, ridgeLeft});
  }
  return slopes;
}

void addChimney(Mesh& mesh, const Frame& frame, const RoofShape& shape, double rise, Random& random) {
  const double x = random.range(shape.widthM * 0.3, shape.widthM * 0.7);
  const double z = -shape.depthM * random.range(0.32, 0.45);
  const double half = random.range(0.3, 0.45);
  const double top = rise + random.range(0.6, 1.2);
  const Colour brick = scaled({150, 84, 66}, random.range(0.8, 1.15));
  mesh.box(frame, glm::dvec3(x - half, 0, z - half), glm::dvec3(x + half, top, z + half), brick);
  mesh.box(frame, glm::dvec3(x - half - 0.08, top, z - half - 0.08),
           glm::dvec3(x + half + 0.08, top + 0.14, z + half + 0.08), {128, 124, 118});
  for (const double side : {-0.5, 0.5}) {
    const auto foot = polygonAround(frame.at(x + half * side, top + 0.14, z), 0.12, 8);
    auto rim = foot;
    for (glm::dvec3& point : rim) point.z += 0.4;
    mesh.band(foot, rim, scaled(brick, 1.2), scaled(brick, 0.8));
  }
}

void addDormer(Mesh& mesh, const Frame& roof, double x, const RoofShape& shape, const FacadeStyle& style,
               Random& random) {
  constexpr double kWidthM = 1.7;
  constexpr double kHeightM = 1.5;
  constexpr double kSetBackM = 0.9;
  const Frame frame = roof.moved(x - kWidthM / 2, kSetBackM * shape.slope, -kSetBackM);
  FacadeStyle plain = style;
  plain.surrounds = false;
  addWindow(mesh, frame, glm::dvec3(kWidthM, kHeightM, 0), glm::dvec3(0.35, 0.25, 0),
            glm::dvec3(kWidthM - 0.35, 1.35, 0), plain, random);
  const double deep = -kHeightM / shape.slope;
  mesh.triangle(frame.at(kWidthM, 0, 0), frame.at(kWidthM, kHeightM, deep), frame.at(kWidthM, kHeightM, 0), style.wall);
  mesh.triangle(frame.at(0, 0, 0), frame.at(0, kHeightM, 0), frame.at(0, kHeightM, deep), style.wall);
  const double peak = kHeightM + 0.6;
  const double peakDeep = -peak / shape.slope;
  const double middle = kWidthM / 2;
  mesh.triangle(frame.at(0, kHeightM, 0), frame.at(kWidthM, kHeightM, 0), frame.at(middle, peak, 0), style.wall);
  mesh.quad(frame.at(kWidthM + 0.15, kHeightM - 0.1, 0.2), frame.at(kWidthM + 0.15, kHeightM - 0.1, deep),
            frame.at(middle, peak, peakDeep), frame.at(middle, peak, 0.2), shape.tiles);
  mesh.quad(frame.at(-0.15, kHeightM - 0.1, deep), frame.at(-0.15, kHeightM - 0.1, 0.2), frame.at(middle, peak, 0.2),
            frame.at(middle, peak, peakDeep), scaled(shape.tiles, 0.95));
}

void addPitchedRoof(Mesh& mesh, const Frame& frame, const RoofShape& shape, const FacadeStyle& style, Random& random) {
  const double rise = shape.slope * shape.depthM / 2;
  for (const Slope& slope : slopesOf(frame, shape, rise)) {
    addSlope(mesh, slope, shape.tiles, random);
    addUnderside(mesh, slope, scaled(style.trim, 0.7));
  }
  if (shape.kind == RoofKind::gabled) addGables(mesh, frame, shape, rise, style);
  const double ends = shape.kind == RoofKind::hipped ? shape.depthM * 0.3 : 1.5;
  const int dormers = shape.hasDormers ? static_cast<int>((shape.widthM - 2 * ends) / 3.2) : 0;
  for (int i = 0; i < dormers; ++i)
    addDormer(mesh, frame, ends + (shape.widthM - 2 * ends) * (i + 0.5) / dormers, shape, style, random);
  addChimney(mesh, frame, shape, rise, random);
  mesh.box(frame, glm::dvec3(-shape.endReachM, -0.1 - kEaveReachM * shape.slope, kEaveReachM),
           glm::dvec3(shape.widthM + shape.endReachM, 0.02 - kEaveReachM * shape.slope, kEaveReachM + 0.13),
           {112, 110, 108});
}

// A machine on a flat roof: housing, louvres, a fan.
void addMachine(Mesh& mesh, const Frame& frame, glm::dvec3 at, Random& random) {
  const double half = random.range(0.6, 1.1);
  const double top = random.range(0.9, 1.5);
  const Colour metal = scaled({170, 172, 174}, random.range(0.85, 1.1));
  mesh.box(frame, at + glm::dvec3(-half, 0, -half), at + glm::dvec3(half, top, half), metal);
  for (int i = 0; i < 4; ++i) {
    const double y = top * (0.25 + 0.16 * i);
    mesh.box(frame, at + glm::dvec3(-half * 0.8, y, half - 0.02), at + glm::dvec3(half * 0.8, y + 0.05, half + 0.05),
             scaled(metal, 0.7));
  }
  const auto rim = polygonAround(frame.at(at.x, at.y + top + 0.1, at.z), half * 0.6, 12);
  auto foot = rim;
  for (glm::dvec3& point : foot) point.z -= 0.1;
  mesh.band(foot, rim, scaled(metal, 0.8), scaled(metal, 0.8));
  mesh.fan(rim, {60, 62, 64});
}

void addFlatRoof(Mesh& mesh, const Frame& frame, const RoofShape& shape, const FacadeStyle& style, Random& random) {
  constexpr double kParapetM = 0.9;
  constexpr double kWallM = 0.3;
  const double w = shape.widthM;
  const double d = shape.depthM;
  const Colour gravel = scaled({156, 150, 142}, random.range(0.8, 1.1));
  mesh.quad(frame.at(0, 0.05, 0), frame.at(w, 0.05, 0), frame.at(w, 0.05, -d), frame.at(0, 0.05, -d), gravel);
  mesh.box(frame, glm::dvec3(0, 0, -kWallM), glm::dvec3(w, kParapetM, 0), style.wall);
  mesh.box(frame, glm::dvec3(0, 0, -d), glm::dvec3(w, kParapetM, kWallM - d), style.wall);
  mesh.box(frame, glm::dvec3(0, 0, kWallM - d), glm::dvec3(kWallM, kParapetM, -kWallM), style.wall);
  mesh.box(frame, glm::dvec3(w - kWallM, 0, kWallM - d), glm::dvec3(w, kParapetM, -kWallM), style.wall);
  for (const double z : {-kWallM - 0.08, -d - 0.08})
    mesh.box(frame, glm::dvec3(-0.08, kParapetM, z), glm::dvec3(w + 0.08, kParapetM + 0.1, z + kWallM + 0.16),
             style.trim);
  // The stair's head, then machines.
  const glm::dvec3 stair{random.range(0.25, 0.55) * w, 0.05, -random.range(0.4, 0.6) * d};
  mesh.box(frame, stair, stair + glm::dvec3(std::min(3.5, w * 0.3), 2.6, std::min(3.0, d * 0.3)),
           scaled(style.wall, 0.92));
  const int machines = std::min(8, static_cast<int>(w * d / 70) + 1);
  for (int i = 0; i < machines; ++i)
    addMachine(mesh, frame, glm::dvec3{random.range(0.12, 0.88) * w, 0.05, -random.range(0.12, 0.88) * d}, random);
  if (random.chance(0.4)) {
    const glm::dvec3 mast(w * 0.5, 0.05, -d * 0.5);
    mesh.box(frame, mast - glm::dvec3(0.05, 0, 0.05), mast + glm::dvec3(0.05, random.range(4, 7), 0.05), {180, 60, 52});
  }
}

}  // namespace

void addRoof(Mesh& mesh, const Frame& frame, const RoofShape& shape, const FacadeStyle& style, Random& random) {
  if (shape.kind == RoofKind::flat) return addFlatRoof(mesh, frame, shape, style, random);
  addPitchedRoof(mesh, frame, shape, style, random);
}

}  // namespace farcell::city
