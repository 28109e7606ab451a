// Soups to bake in tests, in cell-local coordinates.
#pragma once

#include <cmath>
#include <filesystem>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <random>
#include <vector>

#include "preprocess/bake/view_baker.h"
#include "preprocess/read/open_mesh.h"

namespace farcell::test {

inline void addTriangle(CellSoup& soup, glm::vec3 a, glm::vec3 b, glm::vec3 c, uint32_t colour = 0xffffff) {
  const glm::vec3 p[3] = {a, b, c};
  for (size_t k = 0; k < 3; ++k) {
    soup.x[k].push_back(p[k].x);
    soup.y[k].push_back(p[k].y);
    soup.z[k].push_back(p[k].z);
    soup.colours[k].push_back(colour);
  }
}

inline glm::vec3 corner(const CellSoup& soup, size_t k, size_t triangle) {
  return glm::vec3(soup.x[k][triangle], soup.y[k][triangle], soup.z[k][triangle]);
}

inline CellSoup part(const CellSoup& soup, size_t begin, size_t end) {
  CellSoup result;
  for (size_t k = 0; k < 3; ++k) {
    const auto cut = [&](const auto& from, auto& to) {
      if (!from.empty()) to.assign(from.begin() + ptrdiff_t(begin), from.begin() + ptrdiff_t(end));
    };
    cut(soup.x[k], result.x[k]);
    cut(soup.y[k], result.y[k]);
    cut(soup.z[k], result.z[k]);
    cut(soup.colours[k], result.colours[k]);
    cut(soup.normals[k], result.normals[k]);
  }
  return result;
}

inline void addRectangle(CellSoup& soup, glm::vec3 origin, glm::vec3 a, glm::vec3 b, uint32_t colour) {
  addTriangle(soup, origin, origin + a, origin + a + b, colour);
  addTriangle(soup, origin, origin + a + b, origin + b, colour);
}

// Triangles of every size: from far below a sample to the whole cube, one in four a sliver.
inline CellSoup randomSoup(uint32_t seed, int count) {
  std::mt19937 random(seed);
  const auto uniform = [&](float low, float high) { return std::uniform_real_distribution<float>(low, high)(random); };
  const auto point = [&](float reach) {
    return glm::vec3(uniform(-reach, reach), uniform(-reach, reach), uniform(-reach, reach));
  };
  CellSoup soup;
  for (int i = 0; i < count; ++i) {
    const float size = std::pow(10.0f, uniform(-4, 0.4f));
    const glm::vec3 a = point(1), b = a + point(size);
    const glm::vec3 c = i % 4 != 0 ? a + point(size) : a + (b - a) * uniform(0, 1) + point(size * 1e-4f);
    const auto inside = [](glm::vec3 p) { return glm::clamp(p, glm::vec3(-1.04f), glm::vec3(1.04f)); };
    addTriangle(soup, inside(a), inside(b), inside(c));
    for (size_t k = 0; k < 3; ++k) soup.colours[k].back() = random() & 0xffffff;
  }
  return soup;
}

// A closed sphere of 8 * 4^splits triangles (a split octahedron), turned so that no vertex is special.
inline CellSoup sphereSoup(int splits, float radius) {
  using Face = std::array<glm::vec3, 3>;
  std::vector<Face> faces;
  for (int octant = 0; octant < 8; ++octant)
    faces.push_back({glm::vec3(octant & 1 ? 1 : -1, 0, 0), glm::vec3(0, octant & 2 ? 1 : -1, 0),
                     glm::vec3(0, 0, octant & 4 ? 1 : -1)});
  for (int split = 0; split < splits; ++split) {
    std::vector<Face> finer;
    for (const auto& [a, b, c] : faces) {
      const glm::vec3 ab = glm::normalize(a + b), bc = glm::normalize(b + c), ca = glm::normalize(c + a);
      finer.insert(finer.end(), {Face{a, ab, ca}, Face{ab, b, bc}, Face{ca, bc, c}, Face{ab, bc, ca}});
    }
    faces = finer;
  }
  const glm::vec3 u = glm::normalize(glm::vec3(1, .3f, -.2f)),
                  v = glm::normalize(glm::cross(glm::vec3(.1f, 1, .4f), u));
  const glm::vec3 w = glm::cross(u, v);
  CellSoup soup;
  for (const auto& [a, b, c] : faces) {
    const auto turned = [&](glm::vec3 p) { return radius * (p.x * u + p.y * v + p.z * w); };
    addTriangle(soup, turned(a), turned(b), turned(c));
  }
  return soup;
}

// A mesh file scaled into [-1, 1]^3; nothing where the file is absent.
inline std::optional<CellSoup> meshSoup(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) return std::nullopt;
  auto reader = openMesh(path);
  if (!reader) return std::nullopt;
  std::vector<glm::dvec3> points;
  const auto counts = (*reader)->forEachTriangle([&](std::span<const InputTriangle> triangles) -> Result<> {
    for (const InputTriangle& triangle : triangles)
      points.insert(points.end(), triangle.positions.begin(), triangle.positions.end());
    return {};
  });
  if (!counts) return std::nullopt;
  glm::dvec3 low = points[0], high = points[0];
  for (const glm::dvec3& p : points) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const double scale = 2 / std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  CellSoup soup;
  const auto local = [&](const glm::dvec3& p) { return glm::vec3((p - (low + high) * .5) * scale); };
  for (size_t i = 0; i < points.size(); i += 3)
    addTriangle(soup, local(points[i]), local(points[i + 1]), local(points[i + 2]));
  return soup;
}

struct BakedPair {
  BakedView view, antipode;
};

inline BakedPair bake(const CellSoup& soup, const ViewFrame& frame, const BakeSettings& settings) {
  ViewBaker baker(settings);
  BakedPair pair;
  baker.begin(frame);
  baker.add(soup);
  baker.finish(pair.view, pair.antipode);
  return pair;
}

inline constexpr float kNothing = -std::numeric_limits<float>::infinity();

inline float depthAt(const BakedView& view, int x, int y) {
  const int column = x - view.x0, row = y - view.y0;
  if (column < 0 || row < 0 || column >= view.width || row >= view.height) return kNothing;
  return view.depth[size_t(row * view.width + column)];
}

inline std::array<float, 4> rgbaAt(const BakedView& view, int x, int y) {
  const int column = x - view.x0, row = y - view.y0;
  if (column < 0 || row < 0 || column >= view.width || row >= view.height) return {};
  const auto at = size_t(4 * (row * view.width + column));
  return {view.rgba[at], view.rgba[at + 1], view.rgba[at + 2], view.rgba[at + 3]};
}

inline bool sameView(const BakedView& a, const BakedView& b) {
  return a.x0 == b.x0 && a.y0 == b.y0 && a.width == b.width && a.height == b.height && a.rgba == b.rgba &&
         a.depth == b.depth && a.normal == b.normal;
}

}  // namespace farcell::test
