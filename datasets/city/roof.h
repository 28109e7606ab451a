// What closes a building: tiled gabled and hipped roofs with chimneys and dormers, flat roofs with their machines.
#pragma once

#include "datasets/city/facade.h"

namespace farcell::city {

enum class RoofKind { gabled, hipped, flat };

// A roof over the box [0, widthM] x [-depthM, 0] (along x and z of the frame); the frame's origin is at eave height.
struct RoofShape {
  RoofKind kind = RoofKind::gabled;
  double widthM = 0;
  double depthM = 0;
  double slope = 0.8;      // rise over run
  double endReachM = 0.3;  // overhang past the left and right walls; 0 against a neighbour
  Colour tiles;
  bool hasDormers = false;
};

void addRoof(Mesh& mesh, const Frame& frame, const RoofShape& shape, const FacadeStyle& style, Random& random);

}  // namespace farcell::city
