#include "datasets/city/facade.h"

#include <cmath>

namespace farcell::city {
namespace {

// A rectangle on a wall, from low to high.
struct Opening {
  double left = 0;
  double bottom = 0;
  double right = 0;
  double top = 0;
};

Opening shrunk(const Opening& o, double by) { return {o.left + by, o.bottom + by, o.right - by, o.top - by}; }

// The flat frame between two rectangles: 8 triangles.
void addRing(Mesh& mesh, const Frame& frame, const Opening& outer, const Opening& inner, double z, Colour colour) {
  const auto corner = [&](const Opening& o, int i) {
    return mesh.vertex(frame.at(i == 1 || i == 2 ? o.right : o.left, i >= 2 ? o.top : o.bottom, z), colour);
  };
  std::array<uint32_t, 8> v{};
  for (size_t i = 0; i < 4; ++i) v[i] = corner(outer, static_cast<int>(i));
  for (size_t i = 0; i < 4; ++i) v[4 + i] = corner(inner, static_cast<int>(i));
  for (size_t i = 0; i < 4; ++i) {
    const size_t next = (i + 1) % 4;
    mesh.triangle(v[i], v[next], v[4 + next]);
    mesh.triangle(v[i], v[4 + next], v[4 + i]);
  }
}

// The four sides of a hole from the wall's face to `depth` behind it.
void addReveal(Mesh& mesh, const Frame& frame, const Opening& o, double depth, Colour colour) {
  const std::array<glm::dvec3, 4> face = {frame.at(o.left, o.bottom, 0), frame.at(o.right, o.bottom, 0),
                                          frame.at(o.right, o.top, 0), frame.at(o.left, o.top, 0)};
  std::array<glm::dvec3, 4> back = face;
  for (glm::dvec3& point : back) point -= frame.outward() * depth;
  mesh.band(face, back, colour, scaled(colour, 0.85));
}

void addRectangle(Mesh& mesh, const Frame& frame, const Opening& o, double z, Colour colour) {
  mesh.quad(frame.at(o.left, o.bottom, z), frame.at(o.right, o.bottom, z), frame.at(o.right, o.top, z),
            frame.at(o.left, o.top, z), colour);
}

// Dark panes that mirror some sky; behind some, a curtain or a lamp.
Colour glassColour(Random& random) {
  const double kind = random.unit();
  if (kind < 0.12) return scaled({206, 200, 186}, random.range(0.8, 1.05));
  if (kind < 0.16) return {236, 206, 130};
  return scaled({74, 92, 108}, random.range(0.6, 1.35));
}

void addPane(Mesh& mesh, const Frame& frame, const Opening& o, const FacadeStyle& style, Random& random) {
  constexpr double kBarM = 0.07;
  const double back = -style.revealM;
  const double front = back + 0.05;
  const Opening inner = shrunk(o, kBarM);
  addRing(mesh, frame, o, inner, front, style.frame);
  addRectangle(mesh, frame, o, back, glassColour(random));
  if (!style.crossBars) return;
  const double middle = (o.left + o.right) / 2;
  const double transom = o.bottom + (o.top - o.bottom) * 0.68;
  addRectangle(mesh, frame, {middle - kBarM / 2, inner.bottom, middle + kBarM / 2, inner.top}, front, style.frame);
  addRectangle(mesh, frame, {inner.left, transom - kBarM / 2, inner.right, transom + kBarM / 2}, front - 0.005,
               style.frame);
}

void addSurround(Mesh& mesh, const Frame& frame, const Opening& o, const FacadeStyle& style) {
  constexpr double kWidthM = 0.16;
  addRing(mesh, frame, shrunk(o, -kWidthM), o, 0.05, style.trim);
  mesh.box(frame, glm::dvec3(o.left - 0.25, o.top + kWidthM, -0.02),
           glm::dvec3(o.right + 0.25, o.top + kWidthM + 0.14, 0.16), style.trim);
}

void addHole(Mesh& mesh, const Frame& frame, const Opening& wall, const Opening& hole, const FacadeStyle& style) {
  addRing(mesh, frame, wall, hole, 0, style.wall);
  addReveal(mesh, frame, hole, style.revealM, scaled(style.wall, 0.95));
}

void addWindowIn(Mesh& mesh, const Frame& frame, const Opening& wall, const Opening& hole, const FacadeStyle& style,
                 Random& random) {
  addHole(mesh, frame, wall, hole, style);
  addPane(mesh, frame, hole, style, random);
  mesh.box(frame, glm::dvec3(hole.left - 0.08, hole.bottom - 0.08, -0.05),
           glm::dvec3(hole.right + 0.08, hole.bottom, 0.14), style.trim);
  if (style.surrounds) addSurround(mesh, frame, hole, style);
}

void addDoor(Mesh& mesh, const Frame& frame, const Opening& wall, const FacadeStyle& style) {
  const double middle = (wall.left + wall.right) / 2;
  const double half = std::min(0.65, (wall.right - wall.left) * 0.35);
  const Opening hole{middle - half, wall.bottom + 0.02, middle + half, wall.bottom + 2.5};
  addHole(mesh, frame, wall, hole, style);
  addRectangle(mesh, frame, hole, -style.revealM, style.accent);
  const double panel = half * 0.7;
  for (const double y : {0.25, 1.2})
    mesh.box(frame, glm::dvec3(middle - panel, hole.bottom + y, -style.revealM - 0.02),
             glm::dvec3(middle + panel, hole.bottom + y + 0.75, 0.04 - style.revealM), scaled(style.accent, 1.25));
  mesh.box(frame, glm::dvec3(hole.left - 0.3, wall.bottom - 0.5, -0.1), glm::dvec3(hole.right + 0.3, wall.bottom, 0.55),
           {150, 148, 142});
  mesh.box(frame, glm::dvec3(hole.left - 0.2, hole.top + 0.1, -0.05),
           glm::dvec3(hole.right + 0.2, hole.top + 0.22, 0.8), style.trim);
}

void addShop(Mesh& mesh, const Frame& frame, const Opening& wall, const FacadeStyle& style, Random& random) {
  const Opening hole{wall.left + 0.2, wall.bottom + 0.45, wall.right - 0.2, wall.top - 1.0};
  addHole(mesh, frame, wall, hole, style);
  FacadeStyle shop = style;
  shop.frame = scaled(style.accent, 0.7);
  addPane(mesh, frame, hole, shop, random);
  // The sign, and an awning over the pavement.
  mesh.box(frame, glm::dvec3(hole.left, hole.top + 0.2, -0.02), glm::dvec3(hole.right, hole.top + 0.75, 0.1),
           style.accent);
  const std::array<glm::dvec3, 4> awning = {
      frame.at(hole.left, hole.top - 0.35, 1.3), frame.at(hole.right, hole.top - 0.35, 1.3),
      frame.at(hole.right, hole.top + 0.12, 0.06), frame.at(hole.left, hole.top + 0.12, 0.06)};
  mesh.fan(awning, scaled(style.accent, 1.2));
  mesh.quad(frame.at(hole.left, hole.top - 0.55, 1.3), frame.at(hole.right, hole.top - 0.55, 1.3), awning[1], awning[0],
            scaled(style.accent, 0.9));
}

// Slab, bars and a hand rail round three sides.
void addBalcony(Mesh& mesh, const Frame& frame, const Opening& span, const FacadeStyle& style) {
  constexpr double kDepthM = 1.25;
  constexpr double kRailM = 1.0;
  constexpr double kBarSpacingM = 0.16;
  constexpr double kBarM = 0.025;
  const double y = span.bottom;
  const double inner = span.right - span.left - 0.1;
  mesh.box(frame, glm::dvec3(span.left, y - 0.16, -0.05), glm::dvec3(span.right, y, kDepthM), style.trim);
  const Colour rail = scaled(style.accent, 0.6);
  mesh.box(frame, glm::dvec3(span.left, y + kRailM - 0.05, kDepthM - 0.06), glm::dvec3(span.right, y + kRailM, kDepthM),
           rail);
  for (const double x : {span.left, span.right - 0.05})
    mesh.box(frame, glm::dvec3(x, y + kRailM - 0.05, 0), glm::dvec3(x + 0.05, y + kRailM, kDepthM - 0.06), rail);
  const int bars = static_cast<int>(inner / kBarSpacingM);
  const auto addBar = [&](double x, double z) {
    addRectangle(mesh, frame, {x, y, x + kBarM, y + kRailM - 0.05}, z, rail);
  };
  for (int i = 0; i <= bars; ++i) addBar(span.left + 0.05 + inner * i / bars - kBarM / 2, kDepthM - 0.03);
  const int sideBars = static_cast<int>(kDepthM / kBarSpacingM) - 1;
  for (const double x : {span.left + 0.025, span.right - 0.025}) {
    for (int i = 1; i <= sideBars; ++i) {
      const double z = kDepthM * i / (sideBars + 1);
      mesh.quad(frame.at(x, y, z), frame.at(x, y, z + kBarM), frame.at(x, y + kRailM - 0.05, z + kBarM),
                frame.at(x, y + kRailM - 0.05, z), rail);
    }
  }
}

struct Bay {
  Opening wall;
  int floor = 0;
  bool isDoor = false;
  bool hasBalcony = false;
};

void addBay(Mesh& mesh, const Frame& frame, const Bay& bay, bool onStreet, const FacadeStyle& style, Random& random) {
  const Opening& wall = bay.wall;
  if (bay.isDoor) return addDoor(mesh, frame, wall, style);
  if (bay.floor == 0 && onStreet && style.hasShops) return addShop(mesh, frame, wall, style, random);
  const double middle = (wall.left + wall.right) / 2;
  const double half = std::min(style.windowWidthM / 2, (wall.right - wall.left) / 2 - 0.15);
  const double height = std::min(style.windowHeightM, wall.top - wall.bottom - 1.1);
  const double sill = bay.hasBalcony ? wall.bottom + 0.1 : wall.bottom + (wall.top - wall.bottom - height) * 0.6;
  const double top = bay.hasBalcony ? wall.bottom + 2.35 : sill + height;
  addWindowIn(mesh, frame, wall, {middle - half, sill, middle + half, top}, style, random);
  if (bay.hasBalcony) {
    const double reach = std::min(half + 0.7, (wall.right - wall.left) / 2 - 0.05);
    addBalcony(mesh, frame, {middle - reach, wall.bottom + 0.05, middle + reach, top}, style);
  }
}

void addMouldings(Mesh& mesh, const Frame& frame, const FacadeSize& size, const FacadeStyle& style) {
  const double top = heightM(style, size.floors);
  if (style.courses)
    for (int floor = 1; floor < size.floors; ++floor) {
      const double y = heightM(style, floor);
      mesh.box(frame, glm::dvec3(0, y - 0.12, -0.02), glm::dvec3(size.widthM, y + 0.06, 0.09), style.trim);
    }
  mesh.box(frame, glm::dvec3(0, top - 0.45, -0.02), glm::dvec3(size.widthM, top - 0.2, 0.18), style.trim);
  mesh.box(frame, glm::dvec3(0, top - 0.2, -0.02), glm::dvec3(size.widthM, top, 0.34), scaled(style.trim, 0.96));
}

}  // namespace

void addWindow(Mesh& mesh, const Frame& frame, glm::dvec3 wallSize, glm::dvec3 low, glm::dvec3 high,
               const FacadeStyle& style, Random& random) {
  addWindowIn(mesh, frame, {0, 0, wallSize.x, wallSize.y}, {low.x, low.y, high.x, high.y}, style, random);
}

void addFacade(Mesh& mesh, const Frame& frame, const FacadeSize& size, const FacadeStyle& style, Random& random) {
  const int bays = std::max(1, static_cast<int>(size.widthM / style.bayM + 0.5));
  const double bayM = size.widthM / bays;
  const int door = size.onStreet ? random.below(bays) : -1;
  std::vector<bool> balconyColumn;
  for (int i = 0; i < bays; ++i) balconyColumn.push_back(random.chance(style.balconyShare));
  for (int floor = 0; floor < size.floors; ++floor) {
    const double bottom = floor == 0 ? 0 : heightM(style, floor);
    const double top = heightM(style, floor + 1);
    for (int i = 0; i < bays; ++i) {
      const Opening wall{bayM * i, bottom, bayM * (i + 1), top};
      const bool hasBalcony = floor > 0 && balconyColumn[static_cast<size_t>(i)];
      addBay(mesh, frame, {wall, floor, floor == 0 && i == door, hasBalcony}, size.onStreet, style, random);
    }
  }
  addMouldings(mesh, frame, size, style);
}

}  // namespace farcell::city
