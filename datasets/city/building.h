// A whole building on its lot.
#pragma once

#include "datasets/city/roof.h"

namespace farcell::city {

// Sides by the frame: front (z = 0), right, back, left.
enum class SideKind { street, court, party };  // party: against a neighbour, no openings

struct Lot {
  Frame frame;  // origin: the front left corner, at the height of the ground floor; the building goes to -z
  double widthM = 0;
  double depthM = 0;
  double plinthM = 1;  // how far walls reach below the ground floor
  std::array<SideKind, 4> sides{};
};

void addTownHouse(Mesh& mesh, const Lot& lot, Random& random);  // a row's: 3 to 7 floors
void addVilla(Mesh& mesh, const Lot& lot, Random& random);      // detached: 1 to 3 floors
void addTower(Mesh& mesh, const Lot& lot, Random& random);      // 8 to 26 floors
void addChurch(Mesh& mesh, const Lot& lot, Random& random);

}  // namespace farcell::city
