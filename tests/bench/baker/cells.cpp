#include "tests/bench/baker/cells.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <random>

#include "preprocess/read/open_mesh.h"

namespace farcell::bench {
namespace {

struct IndexedMesh {
  std::vector<glm::vec3> positions;
  std::vector<unsigned> indices;
};

void scaleIntoCube(std::vector<glm::dvec3>& points) {
  glm::dvec3 low(INFINITY), high(-INFINITY);
  for (const glm::dvec3& p : points) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const double scale = 2 / std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  for (glm::dvec3& p : points) p = (p - (low + high) * 0.5) * scale;
}

IndexedMesh welded(const std::vector<glm::dvec3>& corners) {
  const std::vector<glm::vec3> soup(corners.begin(), corners.end());
  IndexedMesh mesh;
  mesh.indices.resize(soup.size());
  const size_t vertices = meshopt_generateVertexRemap(mesh.indices.data(), nullptr, soup.size(), soup.data(),
                                                      soup.size(), sizeof(glm::vec3));
  mesh.positions.resize(vertices);
  meshopt_remapVertexBuffer(mesh.positions.data(), soup.data(), soup.size(), sizeof(glm::vec3), mesh.indices.data());
  return mesh;
}

void simplify(IndexedMesh& mesh, size_t triangles) {
  std::vector<unsigned> simplified(mesh.indices.size());
  simplified.resize(meshopt_simplify(simplified.data(), mesh.indices.data(), mesh.indices.size(), &mesh.positions[0].x,
                                     mesh.positions.size(), sizeof(glm::vec3), 3 * triangles, 1.0f, 0, nullptr));
  mesh.indices.resize(simplified.size());
  meshopt_optimizeVertexCache(mesh.indices.data(), simplified.data(), simplified.size(), mesh.positions.size());
}

void addCorner(CellSoup& soup, size_t k, glm::vec3 p, uint32_t colour) {
  soup.x[k].push_back(p.x);
  soup.y[k].push_back(p.y);
  soup.z[k].push_back(p.z);
  soup.colours[k].push_back(colour);
}

void addQuad(CellSoup& soup, glm::vec3 origin, glm::vec3 a, glm::vec3 b, uint32_t colour) {
  const glm::vec3 corners[2][3] = {{origin, origin + a, origin + a + b}, {origin, origin + a + b, origin + b}};
  for (const auto& triangle : corners)
    for (size_t k = 0; k < 3; ++k) addCorner(soup, k, triangle[k], colour);
}

void addBlock(CellSoup& soup, glm::vec3 low, glm::vec3 size, uint32_t colour) {
  for (int axis = 0; axis < 3; ++axis) {
    glm::vec3 a(0), b(0), up(0);
    a[(axis + 1) % 3] = size[(axis + 1) % 3];
    b[(axis + 2) % 3] = size[(axis + 2) % 3];
    up[axis] = size[axis];
    addQuad(soup, low, a, b, colour);
    addQuad(soup, low + up, a, b, colour);
  }
}

}  // namespace

Result<BenchCell> statueCell(const std::filesystem::path& path, size_t triangles) {
  FARCELL_ASSIGN(const auto reader, openMesh(path));
  std::vector<glm::dvec3> corners;
  const auto collect = [&](std::span<const InputTriangle> batch) -> Result<> {
    for (const InputTriangle& triangle : batch)
      corners.insert(corners.end(), triangle.positions.begin(), triangle.positions.end());
    return {};
  };
  FARCELL_TRY(reader->forEachTriangle(collect));
  scaleIntoCube(corners);
  IndexedMesh mesh = welded(corners);
  simplify(mesh, triangles);
  BenchCell cell{"statue", {}};
  for (size_t i = 0; i < mesh.indices.size(); ++i) {
    const unsigned vertex = mesh.indices[i];
    addCorner(cell.soup, i % 3, mesh.positions[vertex], 0x808080u + vertex % 64 * 0x010101u);
  }
  return cell;
}

BenchCell reliefCell(int edge) {
  BenchCell cell{"relief", {}};
  const auto add = [&](size_t k, int x, int y) {
    const double u = 2.0 * x / edge - 1, v = 2.0 * y / edge - 1;
    const glm::dvec3 p(u, v, 0.4 * std::sin(3 * u + v) + 0.1 * std::cos(11 * v - 7 * u));
    addCorner(cell.soup, k, glm::vec3(p), 0x406080u + static_cast<uint32_t>((x * 7 + y * 3) % 64) * 0x010101u);
  };
  for (int y = 0; y < edge; ++y) {
    for (int x = 0; x < edge; ++x) {
      add(0, x, y), add(1, x + 1, y), add(2, x + 1, y + 1);
      add(0, x, y), add(1, x + 1, y + 1), add(2, x, y + 1);
    }
  }
  return cell;
}

BenchCell blockCell(int blocks) {
  BenchCell cell{"blocks", {}};
  std::mt19937 random(1);
  const auto fraction = [&] { return static_cast<float>(random() % 4096) / 4096.0f; };
  addQuad(cell.soup, glm::vec3(-1.04f, -1.04f, -1), glm::vec3(2.08f, 0, 0), glm::vec3(0, 2.08f, 0), 0x607060);
  for (int i = 0; i < blocks; ++i) {
    const glm::vec3 low(fraction() * 1.7f - 1, fraction() * 1.7f - 1, -1);
    addBlock(cell.soup, low, glm::vec3(0.05f + 0.2f * fraction(), 0.05f + 0.2f * fraction(), 0.1f + 1.2f * fraction()),
             static_cast<uint32_t>(random()) & 0xffffff);
  }
  return cell;
}

}  // namespace farcell::bench
