#include "datasets/city/block.h"

#include <cmath>

#include "datasets/city/building.h"
#include "datasets/city/ground.h"
#include "datasets/city/outdoors.h"
#include "datasets/city/terrain.h"

namespace farcell::city {
namespace {

enum class Kind { towers, town, villas, park, churchyard };

// What a Random of a block is for; part of its key.
enum Purpose : int64_t { kKindOf = 100, kGround, kStreetLife, kGarden, kLots };

struct Block {
  Mesh& mesh;
  uint64_t seed;
  BlockKey key;
  uint64_t maxTriangles;
  Plot plot;
  bool complete = true;

  Random random(int64_t purpose, int64_t item = 0) const {
    return Random(keyOf(keyOf(seed, key.x, key.y), purpose, item));
  }
  glm::dvec3 on(double x, double y) const { return {x, y, plotHeight(seed, x, y)}; }
  // Calls `item`, and takes back what it added when that is too much.
  template <class Item>
  void add(const Item& item) {
    const Mesh::Mark before = mesh.mark();
    item();
    if (mesh.triangles().size() <= maxTriangles) return;
    mesh.truncate(before);
    complete = false;
  }
  void tree(double x, double y, double lowM, double highM, Random& source) {
    const double heightM = source.range(lowM, highM);
    Random own(source.bits());
    add([&] { addTree(mesh, on(x, y), heightM, own); });
  }
  void bush(double x, double y, Random& source) {
    const double radiusM = source.range(0.6, 1.3);
    Random own(source.bits());
    add([&] { addBush(mesh, on(x, y), radiusM, own); });
  }
};

Kind kindOf(const Block& block) {
  const double x = (block.plot.x.low + block.plot.x.high) / 2;
  const double y = (block.plot.y.low + block.plot.y.high) / 2;
  Random random = block.random(kKindOf);
  const double special = random.unit();
  const double centre = std::max(0.0, 1 - std::sqrt(x * x + y * y) / 700);
  const double density = smoothNoise(keyOf(block.seed, kKindOf), x, y, 420) + 0.3 * centre + random.range(-0.06, 0.06);
  if (special < 0.1 && (block.key.x != 0 || block.key.y != 0)) return Kind::park;
  if (special < 0.14) return Kind::churchyard;
  return density > 0.97 ? Kind::towers : density > 0.42 ? Kind::town : Kind::villas;
}

// A lot from its front left corner; on a slope the ground floor is above its highest corner.
Lot lotAt(const Block& block, glm::dvec3 corner, glm::dvec3 right, double widthM, double depthM) {
  Lot lot;
  lot.widthM = widthM;
  lot.depthM = depthM;
  lot.frame = {corner, right};
  double low = 1e9;
  double high = -1e9;
  for (const double x : {0.0, widthM})
    for (const double z : {0.0, -depthM}) {
      const glm::dvec3 point = lot.frame.at(x, 0, z);
      const double height = plotHeight(block.seed, point.x, point.y);
      low = std::min(low, height);
      high = std::max(high, height);
    }
  lot.frame.origin.z = high + 0.12;
  lot.plinthM = high - low + 0.6;
  return lot;
}

struct Side {
  glm::dvec3 corner;
  glm::dvec3 right;
  double lengthM;
  bool hasCorners;  // its first and last houses stand at street corners
};

std::array<Side, 4> sidesOf(const Plot& plot, double depthM) {
  const double x0 = plot.x.innerLow();
  const double x1 = plot.x.innerHigh();
  const double y0 = plot.y.innerLow();
  const double y1 = plot.y.innerHigh();
  return {{{glm::dvec3(x0, y0, 0), glm::dvec3(1, 0, 0), x1 - x0, true},
           {glm::dvec3(x1, y0 + depthM, 0), glm::dvec3(0, 1, 0), y1 - y0 - 2 * depthM, false},
           {glm::dvec3(x1, y1, 0), glm::dvec3(-1, 0, 0), x1 - x0, true},
           {glm::dvec3(x0, y1 - depthM, 0), glm::dvec3(0, -1, 0), y1 - y0 - 2 * depthM, false}}};
}

void addRow(Block& block, const Side& side, double depthM, int64_t sideIndex) {
  Random layout = block.random(kLots, sideIndex);
  const int houses = std::max(1, static_cast<int>(side.lengthM / layout.range(13, 17) + 0.5));
  const double widthM = side.lengthM / houses;
  for (int i = 0; i < houses; ++i) {
    const bool first = i == 0;
    const bool last = i == houses - 1;
    const bool isGap = layout.chance(0.07) && !first && !last;
    if (isGap) continue;
    Lot lot = lotAt(block, side.corner + side.right * (widthM * i), side.right, widthM, depthM);
    lot.sides = {SideKind::street, side.hasCorners && last ? SideKind::street : SideKind::party, SideKind::court,
                 side.hasCorners && first ? SideKind::street : SideKind::party};
    Random own = block.random(kLots, 1000 * (sideIndex + 1) + i);
    block.add([&] { addTownHouse(block.mesh, lot, own); });
  }
}

// Trees and bushes at random places of a rectangle, clear of its edges.
void addGrove(Block& block, glm::dvec3 low, glm::dvec3 high, int trees, int bushes, Random& random) {
  for (int i = 0; i < trees; ++i) {
    const double x = random.range(low.x, high.x);
    block.tree(x, random.range(low.y, high.y), 7, 14, random);
  }
  for (int i = 0; i < bushes; ++i) {
    const double x = random.range(low.x, high.x);
    block.bush(x, random.range(low.y, high.y), random);
  }
}

// Workshops and rear houses in a courtyard that begins `margin` inside the pavement.
void addRearHouses(Block& block, double margin) {
  constexpr double kLotM = 19;
  Random random = block.random(kLots, 90);
  const double x0 = block.plot.x.innerLow() + margin;
  const double y0 = block.plot.y.innerLow() + margin;
  const int columns = static_cast<int>((block.plot.x.innerHigh() - margin - x0) / kLotM);
  const int rows = static_cast<int>((block.plot.y.innerHigh() - margin - y0) / kLotM);
  for (int i = 0; i < columns * rows; ++i) {
    if (random.chance(0.55)) continue;
    const double x = x0 + kLotM * (i % columns) + random.range(2, 5);
    const double y = y0 + kLotM * (i / columns) + random.range(2, 6);
    const double widthM = random.range(8.5, 13);
    Lot lot = lotAt(block, glm::dvec3(x, y, 0), glm::dvec3(1, 0, 0), widthM, random.range(6.5, 9));
    lot.sides.fill(SideKind::court);
    lot.sides[0] = SideKind::street;
    Random own(random.bits());
    block.add([&] { addVilla(block.mesh, lot, own); });
  }
}

void addTown(Block& block) {
  constexpr double kDepthM = 12.5;
  const auto sides = sidesOf(block.plot, kDepthM);
  for (size_t i = 0; i < sides.size(); ++i) addRow(block, sides[i], kDepthM, static_cast<int64_t>(i));
  addRearHouses(block, kDepthM + 6);
  Random random = block.random(kGarden);
  const double margin = kDepthM + 5;
  const int trees = random.between(8, 16);
  const int bushes = random.between(6, 14);
  addGrove(block, glm::dvec3(block.plot.x.innerLow() + margin, block.plot.y.innerLow() + margin, 0),
           glm::dvec3(block.plot.x.innerHigh() - margin, block.plot.y.innerHigh() - margin, 0), trees, bushes, random);
}

// One house and its garden; `front` is the garden's front left corner at the pavement.
void addVillaLot(Block& block, glm::dvec3 front, glm::dvec3 right, glm::dvec3 size, int64_t index) {
  Random random = block.random(kLots, index);
  const Frame garden{front, right};
  const double widthM = std::min(random.range(9, 13.5), size.x - 5);
  const double depthM = random.range(8, 11);
  const double left = random.range(2, size.x - widthM - 2);
  const double setBack = random.range(4, 7);
  Lot lot = lotAt(block, garden.at(left, 0, -setBack), right, widthM, depthM);
  lot.sides = {SideKind::street, SideKind::court, SideKind::court, SideKind::court};
  Random own(random.bits());
  block.add([&] { addVilla(block.mesh, lot, own); });
  const double gateM = left + widthM / 2;
  const Frame fence{block.on(front.x, front.y), right};
  if (random.chance(0.6)) block.add([&] { addFence(block.mesh, fence, gateM - 1.5, {206, 200, 188}); });
  for (int i = 0; i < 4; ++i) {
    const double x = random.range(1.5, size.x - 1.5);
    const glm::dvec3 at = garden.at(x, 0, -random.range(setBack + depthM + 2.5, size.y - 1.5));
    block.tree(at.x, at.y, 5, 10, random);
  }
  for (int i = 0; i < 7; ++i) {
    const glm::dvec3 at = garden.at(i % 2 == 0 ? 0.6 : size.x - 0.6, 0, -random.range(1, size.y - 1));
    block.bush(at.x, at.y, random);
  }
}

void addVillas(Block& block) {
  const Plot& plot = block.plot;
  const double width = plot.x.innerHigh() - plot.x.innerLow();
  const double depth = (plot.y.innerHigh() - plot.y.innerLow()) / 2;
  const int columns = std::max(1, static_cast<int>(width / 21));
  const glm::dvec3 size(width / columns, depth, 0);
  for (int i = 0; i < columns; ++i) {
    addVillaLot(block, glm::dvec3(plot.x.innerLow() + size.x * i, plot.y.innerLow(), 0), glm::dvec3(1, 0, 0), size, i);
    addVillaLot(block, glm::dvec3(plot.x.innerHigh() - size.x * i, plot.y.innerHigh(), 0), glm::dvec3(-1, 0, 0), size,
                500 + i);
  }
}

void addTowers(Block& block) {
  Random random = block.random(kLots);
  const Plot& plot = block.plot;
  const double halfX = (plot.x.innerHigh() - plot.x.innerLow()) / 2;
  const double halfY = (plot.y.innerHigh() - plot.y.innerLow()) / 2;
  for (int i = 0; i < 4; ++i) {
    if (random.chance(0.1)) continue;
    const double widthM = halfX * random.range(0.6, 0.85);
    const double depthM = std::min(halfY * random.range(0.55, 0.75), 26.0);
    const double x = plot.x.innerLow() + (i % 2) * halfX + random.range(1, halfX - widthM - 1);
    const double y = plot.y.innerLow() + (i / 2) * halfY + random.range(1, halfY - depthM - 1);
    Lot lot = lotAt(block, glm::dvec3(x, y, 0), glm::dvec3(1, 0, 0), widthM, depthM);
    lot.sides.fill(SideKind::street);
    Random own(random.bits());
    block.add([&] { addTower(block.mesh, lot, own); });
  }
  // Rows of trees with benches between them, on what the towers leave free.
  for (int i = 0; i < 24; ++i) {
    const double x = plot.x.innerLow() + 2 * halfX * (i % 8 + 0.5) / 8;
    const double y = i < 8 ? plot.y.innerLow() + halfY : i < 16 ? plot.y.innerLow() + 1.5 : plot.y.innerHigh() - 1.5;
    block.tree(x, y + random.range(-0.8, 0.8), 6, 9, random);
    if (i < 8) block.add([&] { addBench(block.mesh, {block.on(x + 3, y), glm::dvec3(1, 0, 0)}); });
  }
}

// A gravel path between two points that differ in x or in y only.
void addPath(Block& block, glm::dvec3 from, glm::dvec3 to, Random& random) {
  constexpr int kPieces = 12;
  constexpr double kHalfM = 1.4;
  const glm::dvec3 side = (from.x == to.x ? glm::dvec3(1, 0, 0) : glm::dvec3(0, -1, 0)) * kHalfM;
  const auto at = [&](int piece, double share) {
    const glm::dvec3 point = from + (to - from) * (static_cast<double>(piece) / kPieces) + side * share;
    return block.on(point.x, point.y) + glm::dvec3(0, 0, 0.05);
  };
  for (int i = 0; i < kPieces; ++i)
    block.mesh.quad(at(i, -1), at(i, 1), at(i + 1, 1), at(i + 1, -1),
                    scaled({186, 172, 140}, random.range(0.95, 1.05)));
}

void addPond(Mesh& mesh, glm::dvec3 centre) {
  const auto rim = polygonAround(centre + glm::dvec3(0, 0, 0.25), 9, 12);
  mesh.band(polygonAround(centre - glm::dvec3(0, 0, 0.6), 9.3, 12), rim, {150, 146, 138}, {160, 156, 148});
  mesh.fan(rim, {82, 112, 126});
}

// Crossing paths over the lawn, a pond, benches, many trees.
void addPark(Block& block) {
  Random random = block.random(kGarden);
  const Span& x = block.plot.x;
  const Span& y = block.plot.y;
  const glm::dvec3 middle((x.innerLow() + x.innerHigh()) / 2, (y.innerLow() + y.innerHigh()) / 2, 0);
  const glm::dvec3 pond = block.on(middle.x + 16, middle.y + 14);
  block.add([&] {
    addPath(block, {middle.x, y.innerLow(), 0}, {middle.x, y.innerHigh(), 0}, random);
    addPath(block, {x.innerLow(), middle.y, 0}, {x.innerHigh(), middle.y, 0}, random);
  });
  block.add([&] { addPond(block.mesh, pond); });
  for (int i = 0; i < 44; ++i) {
    const double treeX = random.range(x.innerLow() + 2, x.innerHigh() - 2);
    const double treeY = random.range(y.innerLow() + 2, y.innerHigh() - 2);
    const bool onPath = std::abs(treeX - middle.x) < 3.5 || std::abs(treeY - middle.y) < 3.5;
    const bool inPond = std::abs(treeX - pond.x) < 12 && std::abs(treeY - pond.y) < 12;
    if (!onPath && !inPond) block.tree(treeX, treeY, 8, 17, random);
  }
  for (int i = 0; i < 6; ++i)
    block.add([&] {
      addBench(block.mesh, {block.on(x.innerLow() + 8 + 11 * i, middle.y + 2.4), glm::dvec3(1, 0, 0)});
    });
}

void addChurchyard(Block& block) {
  const Plot& plot = block.plot;
  Random random = block.random(kLots);
  const double lengthM = std::min(34.0, plot.x.innerHigh() - plot.x.innerLow() - 20);
  constexpr double kNaveM = 14;
  const double x = (plot.x.innerLow() + plot.x.innerHigh() - lengthM) / 2;
  const double y = (plot.y.innerLow() + plot.y.innerHigh() - kNaveM) / 2;
  Lot lot = lotAt(block, glm::dvec3(x, y, 0), glm::dvec3(1, 0, 0), lengthM, kNaveM);
  lot.sides = {SideKind::street, SideKind::party, SideKind::court, SideKind::party};
  block.add([&] { addChurch(block.mesh, lot, random); });
  Random garden = block.random(kGarden);
  addGrove(block, glm::dvec3(plot.x.innerLow() + 3, plot.y.innerLow() + 3, 0),
           glm::dvec3(plot.x.innerHigh() - 3, y - 6, 0), 9, 5, garden);
  addGrove(block, glm::dvec3(plot.x.innerLow() + 3, y + kNaveM + 6, 0),
           glm::dvec3(plot.x.innerHigh() - 3, plot.y.innerHigh() - 3, 0), 9, 5, garden);
}

// Cars, trees and lamps along one kerb, from `start`; the frame looks at the street.
void addKerbside(Block& block, glm::dvec3 start, glm::dvec3 right, double lengthM, double streetM, Random& random) {
  const Frame kerb{start, right};
  for (double at = 7; at < lengthM - 7; at += 6.2) {
    if (streetM < 5 || !random.chance(0.45)) continue;
    const glm::dvec3 point = kerb.at(at, 0, 1.15);
    Random own(random.bits());
    const glm::dvec3 onStreet(point.x, point.y, plotHeight(block.seed, point.x, point.y) - kKerbM);
    block.add([&] { addCar(block.mesh, {onStreet, random.chance(0.5) ? right : -right}, own); });
  }
  const bool isAvenue = streetM > 7;
  for (double at = 9; at < lengthM - 6; at += isAvenue ? 11 : 22) {
    const glm::dvec3 tree = kerb.at(at, 0, -0.8);
    if (random.chance(0.85)) block.tree(tree.x, tree.y, 6.5, 10, random);
    const glm::dvec3 lamp = kerb.at(at + 5, 0, -0.5);
    if (at + 5 < lengthM - 5) block.add([&] { addLamp(block.mesh, {block.on(lamp.x, lamp.y), right}); });
  }
}

void addStreetLife(Block& block) {
  Random random = block.random(kStreetLife);
  const Span& x = block.plot.x;
  const Span& y = block.plot.y;
  const double lengthX = x.kerbHigh() - x.kerbLow();
  const double lengthY = y.kerbHigh() - y.kerbLow();
  addKerbside(block, glm::dvec3(x.kerbLow(), y.kerbLow(), 0), glm::dvec3(1, 0, 0), lengthX, y.halfStreetLowM, random);
  addKerbside(block, glm::dvec3(x.kerbHigh(), y.kerbLow(), 0), glm::dvec3(0, 1, 0), lengthY, x.halfStreetHighM, random);
  addKerbside(block, glm::dvec3(x.kerbHigh(), y.kerbHigh(), 0), glm::dvec3(-1, 0, 0), lengthX, y.halfStreetHighM,
              random);
  addKerbside(block, glm::dvec3(x.kerbLow(), y.kerbHigh(), 0), glm::dvec3(0, -1, 0), lengthY, x.halfStreetLowM, random);
}

void addContent(Block& block, Kind kind) {
  switch (kind) {
    case Kind::towers:
      return addTowers(block);
    case Kind::town:
      return addTown(block);
    case Kind::villas:
      return addVillas(block);
    case Kind::park:
      return addPark(block);
    case Kind::churchyard:
      return addChurchyard(block);
  }
}

}  // namespace

BlockKey blockAt(uint64_t index) {
  if (index == 0) return {};
  // Ring r holds the indices [(2r-1)^2, (2r+1)^2), starting beside its lower right corner and going round.
  auto ring = static_cast<int64_t>((std::sqrt(static_cast<double>(index)) + 1) / 2);
  while ((2 * ring - 1) * (2 * ring - 1) > static_cast<int64_t>(index)) --ring;
  while ((2 * ring + 1) * (2 * ring + 1) <= static_cast<int64_t>(index)) ++ring;
  const int64_t along = static_cast<int64_t>(index) - (2 * ring - 1) * (2 * ring - 1);
  const int64_t step = along % (2 * ring) + 1;
  switch (along / (2 * ring)) {
    case 0:
      return {ring, step - ring};
    case 1:
      return {ring - step, ring};
    case 2:
      return {-ring, ring - step};
    default:
      return {step - ring, -ring};
  }
}

bool buildBlock(Mesh& mesh, uint64_t seed, BlockKey key, uint64_t maxTriangles) {
  mesh.clear();
  Block block{mesh, seed, key, maxTriangles, {blockSpan(seed, 0, key.x), blockSpan(seed, 1, key.y)}};
  const Kind kind = kindOf(block);
  const bool paved = kind == Kind::towers || (kind == Kind::town && (key.x + key.y) % 3 == 0);
  Random ground = block.random(kGround);
  block.add([&] { addGround(mesh, seed, block.plot, paved ? Surface::paving : Surface::lawn, ground); });
  if (mesh.triangles().empty()) return false;
  addContent(block, kind);
  addStreetLife(block);
  return block.complete;
}

}  // namespace farcell::city
