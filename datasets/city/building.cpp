#include "datasets/city/building.h"

#include <cmath>

#include "datasets/city/palette.h"

namespace farcell::city {
namespace {

constexpr std::array<Colour, 12> kPlaster = {{{226, 208, 172},
                                              {214, 186, 142},
                                              {232, 222, 202},
                                              {204, 170, 136},
                                              {190, 196, 186},
                                              {226, 190, 150},
                                              {198, 128, 104},
                                              {176, 104, 84},
                                              {222, 214, 190},
                                              {170, 184, 196},
                                              {238, 230, 216},
                                              {206, 176, 98}}};
constexpr std::array<Colour, 5> kConcrete = {
    {{196, 196, 192}, {176, 180, 184}, {210, 204, 194}, {150, 158, 168}, {188, 170, 152}}};
constexpr std::array<Colour, 6> kTiles = {
    {{156, 88, 66}, {140, 76, 60}, {170, 106, 80}, {112, 70, 60}, {96, 94, 100}, {128, 86, 70}}};
constexpr std::array<Colour, 8> kAccents = {{{96, 58, 40},
                                             {44, 84, 66},
                                             {122, 40, 38},
                                             {46, 68, 108},
                                             {172, 122, 46},
                                             {88, 92, 96},
                                             {140, 52, 72},
                                             {60, 110, 120}}};

FacadeStyle townStyle(Random& random) {
  FacadeStyle style;
  style.wall = pickColour(kPlaster, 0.92, 1.06, random);
  style.trim = random.chance(0.6) ? Colour{236, 230, 218} : scaled(style.wall, 0.82);
  style.frame = random.chance(0.7) ? Colour{244, 242, 236} : Colour{104, 72, 50};
  style.accent = pickColour(kAccents, 0.92, 1.06, random);
  style.groundM = random.range(3.6, 4.4);
  style.floorM = random.range(2.9, 3.5);
  style.bayM = random.range(2.2, 3.0);
  style.windowWidthM = random.range(1.0, 1.35);
  style.windowHeightM = random.range(1.5, 1.9);
  style.surrounds = random.chance(0.55);
  style.courses = random.chance(0.5);
  style.balconyShare = random.chance(0.45) ? random.range(0.2, 0.6) : 0;
  style.hasShops = random.chance(0.45);
  return style;
}

void addPlainWall(Mesh& mesh, const Frame& frame, double widthM, double top, double bottom, Colour colour) {
  mesh.quad(frame.at(0, bottom, 0), frame.at(widthM, bottom, 0), frame.at(widthM, top, 0), frame.at(0, top, 0), colour);
}

// All four sides of a box-shaped body, plinth included.
void addBody(Mesh& mesh, const Lot& lot, int floors, const FacadeStyle& style, Random& random) {
  Frame side = lot.frame;
  for (size_t i = 0; i < 4; ++i) {
    const double widthM = i % 2 == 0 ? lot.widthM : lot.depthM;
    if (lot.sides[i] == SideKind::party) {
      addPlainWall(mesh, side, widthM, heightM(style, floors), -lot.plinthM, scaled(style.wall, 0.9));
    } else {
      addPlainWall(mesh, side, widthM, 0, -lot.plinthM, scaled(style.trim, 0.75));
      addFacade(mesh, side, {widthM, floors, lot.sides[i] == SideKind::street}, style, random);
    }
    side = side.turned(widthM);
  }
}

Frame eaves(const Lot& lot, const FacadeStyle& style, int floors) {
  return lot.frame.moved(0, heightM(style, floors), 0);
}

// The church's tower: a shaft, a belfry with louvred windows, a spire.
void addSpire(Mesh& mesh, const Frame& frame, double edgeM, double topM, const FacadeStyle& style, Random& random) {
  Frame side = frame;
  for (int i = 0; i < 4; ++i) {
    addPlainWall(mesh, side, edgeM, topM - 5, -2, style.wall);
    const Frame belfry = side.moved(0, topM - 5, 0);
    addWindow(mesh, belfry, glm::dvec3(edgeM, 5, 0), glm::dvec3(edgeM * 0.3, 0.8, 0), glm::dvec3(edgeM * 0.7, 4, 0),
              style, random);
    mesh.box(side, glm::dvec3(-0.2, topM - 0.3, -0.3), glm::dvec3(edgeM + 0.2, topM + 0.1, 0.25), style.trim);
    side = side.turned(edgeM);
  }
  const glm::dvec3 centre = frame.at(edgeM / 2, topM, -edgeM / 2);
  const Colour copper = scaled({92, 142, 122}, random.range(0.9, 1.1));
  const auto foot = polygonAround(centre, edgeM * 0.62, 8);
  const auto waist = polygonAround(centre + glm::dvec3(0, 0, edgeM * 0.9), edgeM * 0.3, 8);
  const auto tip = polygonAround(centre + glm::dvec3(0, 0, edgeM * 2.6), 0.05, 8);
  mesh.band(foot, waist, copper, scaled(copper, 1.1));
  mesh.band(waist, tip, copper, scaled(copper, 1.1));
  const Frame cross{centre + glm::dvec3(0, 0, edgeM * 2.6), frame.right};
  mesh.box(cross, glm::dvec3(-0.06, 0, -0.06), glm::dvec3(0.06, 1.8, 0.06), {196, 164, 70});
  mesh.box(cross, glm::dvec3(-0.5, 1.1, -0.06), glm::dvec3(0.5, 1.22, 0.06), {196, 164, 70});
}

}  // namespace

void addTownHouse(Mesh& mesh, const Lot& lot, Random& random) {
  const FacadeStyle style = townStyle(random);
  const int floors = random.between(3, 6);
  RoofShape roof;
  roof.kind = random.chance(0.2) ? RoofKind::flat : RoofKind::gabled;
  roof.widthM = lot.widthM;
  roof.depthM = lot.depthM;
  roof.slope = random.range(0.6, 0.95);
  roof.endReachM = 0;
  roof.tiles = pickColour(kTiles, 0.92, 1.06, random);
  roof.hasDormers = random.chance(0.6);
  addBody(mesh, lot, floors, style, random);
  addRoof(mesh, eaves(lot, style, floors), roof, style, random);
}

void addVilla(Mesh& mesh, const Lot& lot, Random& random) {
  FacadeStyle style = townStyle(random);
  style.groundM = 3.0;
  style.floorM = 2.8;
  style.hasShops = false;
  style.courses = false;
  style.balconyShare = random.chance(0.4) ? 0.3 : 0;
  const int floors = random.between(1, 3);
  RoofShape roof;
  const double kind = random.unit();
  roof.kind = kind < 0.15                                   ? RoofKind::flat
              : kind < 0.6 || lot.widthM < lot.depthM + 0.5 ? RoofKind::gabled
                                                            : RoofKind::hipped;
  roof.widthM = lot.widthM;
  roof.depthM = lot.depthM;
  roof.slope = random.range(0.5, 0.95);
  roof.endReachM = 0.4;
  roof.tiles = pickColour(kTiles, 0.92, 1.06, random);
  roof.hasDormers = floors < 3 && random.chance(0.4);
  addBody(mesh, lot, floors, style, random);
  addRoof(mesh, eaves(lot, style, floors), roof, style, random);
}

void addTower(Mesh& mesh, const Lot& lot, Random& random) {
  FacadeStyle style;
  style.wall = pickColour(kConcrete, 0.92, 1.06, random);
  style.trim = scaled(style.wall, random.range(0.75, 1.15));
  style.frame = random.chance(0.5) ? Colour{72, 76, 80} : Colour{228, 230, 230};
  style.accent = pickColour(kAccents, 0.92, 1.06, random);
  style.groundM = 4.5;
  style.floorM = random.range(3.0, 3.5);
  style.bayM = random.range(3.0, 3.8);
  style.windowWidthM = style.bayM * random.range(0.55, 0.8);
  style.windowHeightM = random.range(1.6, 2.2);
  style.crossBars = random.chance(0.3);
  style.courses = random.chance(0.5);
  style.balconyShare = random.chance(0.3) ? 0.3 : 0;
  style.hasShops = true;
  const double share = random.unit();
  const int floors = 8 + static_cast<int>(18 * share * random.unit());
  addBody(mesh, lot, floors, style, random);
  RoofShape roof;
  roof.kind = RoofKind::flat;
  roof.widthM = lot.widthM;
  roof.depthM = lot.depthM;
  addRoof(mesh, eaves(lot, style, floors), roof, style, random);
}

void addChurch(Mesh& mesh, const Lot& lot, Random& random) {
  FacadeStyle style = townStyle(random);
  style.wall = pickColour(kPlaster, 0.92, 1.06, random);
  style.groundM = random.range(8, 10);
  style.bayM = 4;
  style.windowWidthM = 1.5;
  style.windowHeightM = 5.5;
  style.revealM = 0.5;
  style.surrounds = true;
  style.hasShops = false;
  RoofShape roof;
  roof.widthM = lot.widthM;
  roof.depthM = lot.depthM;
  roof.slope = 1.2;
  roof.tiles = pickColour(kTiles, 0.92, 1.06, random);
  addBody(mesh, lot, 1, style, random);
  addRoof(mesh, eaves(lot, style, 1), roof, style, random);
  constexpr double kTowerM = 6;
  addSpire(mesh, lot.frame.moved(-kTowerM + 0.5, 0, -(lot.depthM - kTowerM) / 2), kTowerM, random.range(22, 30), style,
           random);
}

}  // namespace farcell::city
