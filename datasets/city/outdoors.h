// What stands outside: trees, hedges, cars, lamps, benches.
#pragma once

#include "datasets/city/mesh.h"
#include "datasets/random/random.h"

namespace farcell::city {

void addTree(Mesh& mesh, glm::dvec3 foot, double heightM, Random& random);
void addBush(Mesh& mesh, glm::dvec3 foot, double radiusM, Random& random);
// frame: under the middle of the car, which looks along its right.
void addCar(Mesh& mesh, const Frame& frame, Random& random);
// The lamp's arm reaches out of the frame.
void addLamp(Mesh& mesh, const Frame& frame);
void addBench(Mesh& mesh, const Frame& frame);
// A fence of posts and rails, `widthM` along the frame.
void addFence(Mesh& mesh, const Frame& frame, double widthM, Colour colour);

}  // namespace farcell::city
