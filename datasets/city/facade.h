// One side of a building: windows set back in their reveals, doors, shops, balconies, cornices.
#pragma once

#include "datasets/city/mesh.h"
#include "datasets/random/random.h"

namespace farcell::city {

struct FacadeStyle {
  Colour wall;
  Colour trim;           // surrounds, sills, cornices
  Colour frame;          // of windows
  Colour accent;         // doors, awnings, railings
  double groundM = 3.8;  // height of the ground floor
  double floorM = 3.1;   // height of the others
  double bayM = 2.6;     // wished distance of windows
  double windowWidthM = 1.2;
  double windowHeightM = 1.6;
  double revealM = 0.22;
  bool surrounds = false;
  bool courses = false;     // a moulding between floors
  bool crossBars = true;    // windows have a mullion and a transom
  double balconyShare = 0;  // of the bays
  bool hasShops = false;
};

inline double heightM(const FacadeStyle& style, int floors) { return style.groundM + (floors - 1) * style.floorM; }

struct FacadeSize {
  double widthM = 0;
  int floors = 1;
  bool onStreet = true;  // doors, shops; balconies go to both sides
};

// The wall from the frame's origin, `widthM` to the right and heightM(style, floors) up.
void addFacade(Mesh& mesh, const Frame& frame, const FacadeSize& size, const FacadeStyle& style, Random& random);

// A window in its piece of wall [0, width] x [0, height] of the frame; also used for dormers.
void addWindow(Mesh& mesh, const Frame& frame, glm::dvec3 wallSize, glm::dvec3 low, glm::dvec3 high,
               const FacadeStyle& style, Random& random);

}  // namespace farcell::city
