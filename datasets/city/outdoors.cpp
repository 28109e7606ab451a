#include "datasets/city/outdoors.h"

#include <cmath>

#include "datasets/city/palette.h"

namespace farcell::city {
namespace {

// A unit vector, every direction as likely as any other, without a sine.
glm::dvec3 randomDirection(Random& random) {
  while (true) {
    const glm::dvec3 v{random.range(-1, 1), random.range(-1, 1), random.range(-1, 1)};
    const double square = glm::dot(v, v);
    if (square > 0.01 && square <= 1) return v / std::sqrt(square);
  }
}

// A lump: rings of eight corners between two poles.
void addLump(Mesh& mesh, glm::dvec3 centre, glm::dvec3 radiiM, Colour colour, Random& random) {
  constexpr std::array<double, 4> kHeights = {-0.8, -0.3, 0.3, 0.8};
  std::vector<std::vector<glm::dvec3>> rings;
  for (const double height : kHeights) {
    auto ring = polygonAround(glm::dvec3(0, 0, height), std::sqrt(1 - height * height), 8);
    for (glm::dvec3& point : ring) point = centre + point * radiiM * random.range(0.85, 1.15);
    rings.push_back(std::move(ring));
  }
  for (size_t i = 0; i + 1 < rings.size(); ++i) {
    const double shade = 0.75 + 0.12 * static_cast<double>(i);
    mesh.band(rings[i], rings[i + 1], scaled(colour, shade), scaled(colour, shade + 0.12));
  }
  const std::vector<glm::dvec3> low(rings.front().rbegin(), rings.front().rend());
  mesh.fan(low, scaled(colour, 0.7));
  mesh.fan(rings.back(), scaled(colour, 1.1));
}

// Leaves (or twigs of them), folded along the middle, on and about an ellipsoid: two triangles each.
void addLeaves(Mesh& mesh, glm::dvec3 centre, glm::dvec3 radiiM, int count, Colour colour, Random& random) {
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 direction = randomDirection(random);
    const glm::dvec3 at = centre + direction * radiiM * random.range(0.86, 1.14);
    const double lengthM = random.range(0.16, 0.32);
    const glm::dvec3 spine = randomDirection(random) * lengthM;
    const glm::dvec3 side = glm::cross(spine, randomDirection(random));
    if (glm::dot(side, side) < 0.05 * glm::dot(spine, spine)) continue;
    const glm::dvec3 fold = glm::cross(spine, side) * random.range(0.5, 1.5);
    const Colour shade = scaled(colour, random.range(0.75, 1.15) * (0.95 + 0.2 * direction.z));
    mesh.quad(at - spine, at + side + fold, at + spine, at - side + fold, shade);
  }
}

constexpr std::array<Colour, 6> kGreens = {
    {{84, 124, 56}, {70, 110, 52}, {104, 136, 60}, {62, 98, 58}, {122, 142, 62}, {92, 130, 74}}};

void addTrunk(Mesh& mesh, glm::dvec3 foot, double heightM, double radiusM) {
  const Colour bark{98, 78, 60};
  mesh.band(polygonAround(foot - glm::dvec3(0, 0, 0.3), radiusM, 6),
            polygonAround(foot + glm::dvec3(0, 0, heightM), radiusM * 0.6, 6), scaled(bark, 0.8), bark);
}

void addBroadTree(Mesh& mesh, glm::dvec3 foot, double heightM, Colour green, Random& random) {
  const double crownM = heightM * random.range(0.24, 0.3);
  const glm::dvec3 middle = foot + glm::dvec3(0, 0, heightM * 0.64);
  addTrunk(mesh, foot, heightM * 0.55, heightM * 0.025);
  const int lumps = random.between(3, 5);
  for (int i = 0; i < lumps; ++i) {
    const glm::dvec3 offset = randomDirection(random) * crownM * 0.6;
    const glm::dvec3 radii = glm::dvec3(1, 1, 0.9) * crownM * random.range(0.6, 0.85);
    addLump(mesh, middle + offset, radii * 0.92, scaled(green, random.range(0.7, 0.9)), random);
    addLeaves(mesh, middle + offset, radii, 70, green, random);
  }
}

void addConifer(Mesh& mesh, glm::dvec3 foot, double heightM, Colour green, Random& random) {
  addTrunk(mesh, foot, heightM * 0.3, heightM * 0.02);
  const int skirts = random.between(5, 7);
  for (int i = 0; i < skirts; ++i) {
    const double share = static_cast<double>(i) / skirts;
    const double radiusM = heightM * 0.2 * (1 - share) * random.range(0.9, 1.1);
    const double z = heightM * (0.15 + 0.72 * share);
    const auto rim = polygonAround(foot + glm::dvec3(0, 0, z), radiusM, 12);
    const auto tip = polygonAround(foot + glm::dvec3(0, 0, z + heightM * 0.22), radiusM * 0.08, 12);
    mesh.band(rim, tip, scaled(green, 0.65), scaled(green, 0.95));
    addLeaves(mesh, foot + glm::dvec3(0, 0, z + heightM * 0.05), glm::dvec3(radiusM, radiusM, heightM * 0.04), 16,
              scaled(green, 0.85), random);
  }
}

}  // namespace

void addTree(Mesh& mesh, glm::dvec3 foot, double heightM, Random& random) {
  const Colour green = pickColour(kGreens, 0.85, 1.15, random);
  if (random.chance(0.15)) return addConifer(mesh, foot, heightM * 1.2, scaled(green, 0.75), random);
  addBroadTree(mesh, foot, heightM, green, random);
}

void addBush(Mesh& mesh, glm::dvec3 foot, double radiusM, Random& random) {
  const Colour green = pickColour(kGreens, 0.8, 1.1, random);
  const glm::dvec3 centre = foot + glm::dvec3(0, 0, radiusM * 0.5);
  addLump(mesh, centre, glm::dvec3(radiusM, radiusM, radiusM * 0.8), green, random);
  addLeaves(mesh, centre, glm::dvec3(radiusM, radiusM, radiusM * 0.8), 14, green, random);
}

void addCar(Mesh& mesh, const Frame& frame, Random& random) {
  constexpr std::array<Colour, 8> kPaints = {{{196, 198, 200},
                                              {40, 42, 46},
                                              {130, 134, 140},
                                              {150, 34, 32},
                                              {38, 62, 112},
                                              {232, 232, 230},
                                              {70, 86, 72},
                                              {176, 148, 92}}};
  const Colour paint = kPaints[static_cast<size_t>(random.below(kPaints.size()))];
  mesh.box(frame, glm::dvec3(-2.1, 0.3, -0.85), glm::dvec3(2.1, 0.85, 0.85), paint);
  mesh.box(frame, glm::dvec3(-2.15, 0.35, -0.8), glm::dvec3(2.15, 0.5, 0.8), scaled(paint, 0.6));
  const auto level = [&](double y, double back, double front, double half) {
    return std::array<glm::dvec3, 4>{frame.at(back, y, half), frame.at(front, y, half), frame.at(front, y, -half),
                                     frame.at(back, y, -half)};
  };
  const auto sill = level(0.85, -1.7, 1.0, 0.82);
  const auto top = level(1.42, -1.25, 0.35, 0.66);
  mesh.band(sill, top, {52, 60, 68}, {60, 70, 80});
  mesh.fan(top, paint);
  for (const double x : {-1.3, 1.35})
    for (const double z : {-0.88, 0.66}) {
      std::vector<glm::dvec3> inner;
      std::vector<glm::dvec3> outer;
      for (const glm::dvec3 p : polygonAround(glm::dvec3(0), 0.32, 8)) {
        inner.push_back(frame.at(x + p.x, 0.32 + p.y, z));
        outer.push_back(frame.at(x + p.x, 0.32 + p.y, z + 0.22));
      }
      mesh.band(inner, outer, {34, 34, 36}, {34, 34, 36});
      mesh.fan(outer, {58, 58, 60});
    }
}

void addLamp(Mesh& mesh, const Frame& frame) {
  const Colour steel{86, 92, 94};
  mesh.band(polygonAround(frame.at(0, -0.2, 0), 0.09, 6), polygonAround(frame.at(0, 6.2, 0), 0.05, 6), steel, steel);
  mesh.box(frame, glm::dvec3(-0.04, 6.1, -0.04), glm::dvec3(0.04, 6.2, 1.2), steel);
  mesh.box(frame, glm::dvec3(-0.15, 6.0, 0.8), glm::dvec3(0.15, 6.12, 1.5), {224, 220, 196});
}

void addBench(Mesh& mesh, const Frame& frame) {
  const Colour wood{134, 98, 62};
  for (int i = 0; i < 3; ++i)
    mesh.box(frame, glm::dvec3(-0.9, 0.42, 0.16 * i - 0.3), glm::dvec3(0.9, 0.46, 0.16 * i - 0.18), wood);
  for (int i = 0; i < 2; ++i)
    mesh.box(frame, glm::dvec3(-0.9, 0.58 + 0.18 * i, -0.36), glm::dvec3(0.9, 0.7 + 0.18 * i, -0.33), wood);
  for (const double x : {-0.7, 0.7})
    mesh.box(frame, glm::dvec3(x - 0.04, 0, -0.34), glm::dvec3(x + 0.04, 0.88, 0.14), {60, 62, 64});
}

void addFence(Mesh& mesh, const Frame& frame, double widthM, Colour colour) {
  const int posts = std::max(1, static_cast<int>(widthM / 1.6));
  for (int i = 0; i <= posts; ++i) {
    const double x = widthM * i / posts;
    mesh.box(frame, glm::dvec3(x - 0.05, -0.3, -0.05), glm::dvec3(x + 0.05, 1.0, 0.05), scaled(colour, 0.9));
  }
  for (const double y : {0.3, 0.75})
    mesh.box(frame, glm::dvec3(0, y, -0.02), glm::dvec3(widthM, y + 0.09, 0.02), colour);
}

}  // namespace farcell::city
