#include "datasets/statue/subdivision.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "datasets/random/random.h"

namespace farcell {
namespace {

constexpr double kMaxCuts = 2147483648.0;  // 2^31
constexpr uint32_t kMinGridRows = 3;
constexpr int kMaxHalvings = 40;
constexpr int kMaxBisections = 60;
constexpr uint64_t kCloseEnough = 1000;  // a thousandth of the wish

// A length and where between two whole numbers it is rounded up: neighbours of one length do not all step at once.
struct Measure {
  double length;
  double rounding;

  uint32_t cuts(double edgeLength) const {
    return static_cast<uint32_t>(std::clamp(std::floor(length / edgeLength + rounding), 1.0, kMaxCuts));
  }
};

struct Measures {
  std::vector<Measure> edges;
  std::vector<Measure> triangles;  // length: side of the equilateral triangle of the same area
};

double equilateralSide(const BaseMesh& mesh, const BaseMesh::Triangle& triangle) {
  const glm::dvec3 a = mesh.positions[triangle[0]];
  const double twiceArea = glm::length(glm::cross(mesh.positions[triangle[1]] - a, mesh.positions[triangle[2]] - a));
  return std::sqrt(twiceArea * (2 / std::sqrt(3.0)));
}

Measures measure(const BaseMesh& mesh, uint64_t seed) {
  Measures result;
  result.edges.reserve(mesh.edges.size());
  for (const auto& [low, high] : mesh.edges)
    result.edges.push_back({glm::length(mesh.positions[high] - mesh.positions[low]), unitOf(keyOf(seed, low, high))});
  result.triangles.reserve(mesh.triangles.size());
  for (size_t t = 0; t < mesh.triangles.size(); ++t)
    result.triangles.push_back(
        {equilateralSide(mesh, mesh.triangles[t]), unitOf(keyOf(seed, -1, static_cast<int64_t>(t)))});
  return result;
}

// No grid where no side has more than two parts.
uint32_t rowsFor(const Measure& measure, const std::array<uint32_t, 3>& cuts, double edgeLength) {
  const uint32_t most = std::max({cuts[0], cuts[1], cuts[2]});
  return most < kMinGridRows ? most : std::max(kMinGridRows, measure.cuts(edgeLength));
}

uint64_t faceCountOf(uint32_t rows, const std::array<uint32_t, 3>& cuts) {
  const uint64_t sides = uint64_t{cuts[0]} + cuts[1] + cuts[2];
  return rows < kMinGridRows ? sides - 2 : uint64_t{rows} * (rows - 3) + sides;
}

uint64_t gridPointCount(uint32_t rows) { return rows < kMinGridRows ? 0 : uint64_t{rows - 1} * (rows - 2) / 2; }

struct Counts {
  std::vector<uint32_t> cuts;
  std::vector<uint32_t> rows;
  uint64_t vertices = 0;
  uint64_t faces = 0;
};

Counts countsAt(const BaseMesh& mesh, const Measures& measures, double edgeLength) {
  Counts counts;
  counts.vertices = mesh.positions.size();
  counts.cuts.reserve(mesh.edges.size());
  for (const Measure& edge : measures.edges) {
    counts.cuts.push_back(edge.cuts(edgeLength));
    counts.vertices += counts.cuts.back() - 1;
  }
  counts.rows.reserve(mesh.triangles.size());
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    const BaseMesh::Triangle& sides = mesh.sides[t];
    const std::array<uint32_t, 3> cuts = {counts.cuts[sides[0]], counts.cuts[sides[1]], counts.cuts[sides[2]]};
    counts.rows.push_back(rowsFor(measures.triangles[t], cuts, edgeLength));
    counts.vertices += gridPointCount(counts.rows.back());
    counts.faces += faceCountOf(counts.rows.back(), cuts);
  }
  return counts;
}

uint64_t distance(uint64_t a, uint64_t b) { return a > b ? a - b : b - a; }

// More faces the shorter the edges; in steps, so the nearest of what was tried.
double edgeLengthFor(const BaseMesh& mesh, const Measures& measures, uint64_t wished) {
  double longer = 2;  // in diagonals: nothing is cut
  double shorter = longer;
  double best = longer;
  uint64_t bestFaces = mesh.triangles.size();
  for (int i = 0; i < kMaxHalvings && bestFaces < wished; ++i) {
    longer = shorter;
    shorter *= 0.5;
    best = shorter;
    bestFaces = countsAt(mesh, measures, shorter).faces;
  }
  for (int i = 0; i < kMaxBisections && distance(bestFaces, wished) > wished / kCloseEnough; ++i) {
    const double middle = std::sqrt(longer * shorter);
    const uint64_t faces = countsAt(mesh, measures, middle).faces;
    (faces < wished ? longer : shorter) = middle;
    if (distance(faces, wished) >= distance(bestFaces, wished)) continue;
    best = middle;
    bestFaces = faces;
  }
  return best;
}

// The row a number of a grid lies in, whose first row holds one, the next two, and so on.
uint64_t triangularRow(uint64_t index) {
  auto row = static_cast<uint64_t>((std::sqrt(8.0 * static_cast<double>(index) + 1) - 1) / 2);
  while (row * (row + 1) / 2 > index) --row;
  while ((row + 1) * (row + 2) / 2 <= index) ++row;
  return row;
}

uint64_t squareRow(uint64_t index) {
  auto row = static_cast<uint64_t>(std::sqrt(static_cast<double>(index)));
  while (row * row > index) --row;
  while ((row + 1) * (row + 1) <= index) ++row;
  return row;
}

// Whose range [first, next first) holds a number; `firsts` ends with the end of the last.
size_t holderOf(const std::vector<uint64_t>& firsts, uint64_t number) {
  return static_cast<size_t>(std::upper_bound(firsts.begin(), firsts.end(), number) - firsts.begin()) - 1;
}

}  // namespace

Result<Subdivision> Subdivision::create(const BaseMesh& mesh, uint64_t wished, uint64_t seed) {
  constexpr uint64_t kMaxVertices = std::numeric_limits<uint32_t>::max();
  const auto tooMany = [&] {
    return fail(ErrorKind::unsupported, "{} triangles need more vertices than 32-bit indices can name ({})", wished,
                kMaxVertices);
  };
  if (wished > 4 * kMaxVertices) return tooMany();
  const Measures measures = measure(mesh, seed);
  const double edgeLength = edgeLengthFor(mesh, measures, wished);
  Counts counts = countsAt(mesh, measures, edgeLength);
  if (counts.vertices > kMaxVertices) return tooMany();
  Subdivision result(mesh, edgeLength);
  uint64_t next = mesh.positions.size();
  for (const uint32_t cuts : counts.cuts) {
    result.edgeFirst_.push_back(next);
    next += cuts - 1;
  }
  result.edgeFirst_.push_back(next);
  result.rows_ = std::move(counts.rows);
  result.addTriangles(next);
  return result;
}

void Subdivision::addTriangles(uint64_t firstVertex) {
  uint64_t firstFace = 0;
  for (size_t t = 0; t < rows_.size(); ++t) {
    interiorFirst_.push_back(firstVertex);
    faceFirst_.push_back(firstFace);
    firstVertex += gridPointCount(rows_[t]);
    firstFace += faceCountOf(rows_[t], {cuts(t, 0), cuts(t, 1), cuts(t, 2)});
  }
  interiorFirst_.push_back(firstVertex);
  faceFirst_.push_back(firstFace);
}

uint32_t Subdivision::cuts(size_t triangle, size_t side) const {
  const uint32_t edge = mesh_.sides[triangle][side];
  return static_cast<uint32_t>(edgeFirst_[edge + 1] - edgeFirst_[edge]) + 1;
}

void Subdivision::points(uint64_t first, std::span<SurfacePoint> out) const {
  while (!out.empty()) {
    size_t made = 0;
    if (first < mesh_.positions.size()) {
      const auto corner = static_cast<uint32_t>(first);
      out[0] = {{corner, corner, corner}, {1, 0, 0}};
      made = 1;
    } else {
      made = first < edgeFirst_.back() ? edgePoints(first, out) : gridPoints(first, out);
    }
    first += made;
    out = out.subspan(made);
  }
}

// As many as lie on one edge.
size_t Subdivision::edgePoints(uint64_t first, std::span<SurfacePoint> out) const {
  const size_t edge = holderOf(edgeFirst_, first);
  const uint64_t end = edgeFirst_[edge + 1];
  const size_t count = std::min<uint64_t>(out.size(), end - first);
  const auto [low, high] = mesh_.edges[edge];
  const auto parts = static_cast<double>(end - edgeFirst_[edge] + 1);
  for (size_t i = 0; i < count; ++i) {
    const double t = static_cast<double>(first + i - edgeFirst_[edge] + 1) / parts;
    out[i] = {{low, high, low}, {1 - t, t, 0}};
  }
  return count;
}

// As many as lie in one row of one grid.
size_t Subdivision::gridPoints(uint64_t first, std::span<SurfacePoint> out) const {
  const size_t triangle = holderOf(interiorFirst_, first);
  const uint64_t local = first - interiorFirst_[triangle];
  const uint64_t row = triangularRow(local);
  const uint64_t column = local - row * (row + 1) / 2;
  const size_t count = std::min<uint64_t>(out.size(), row + 1 - column);
  const double rows = rows_[triangle];
  const double k = rows - 2 - static_cast<double>(row);
  for (size_t i = 0; i < count; ++i) {
    const auto j = static_cast<double>(column + i + 1);
    out[i] = {mesh_.triangles[triangle], {(rows - k - j) / rows, j / rows, k / rows}};
  }
  return count;
}

// Vertex `step` of a side, from its first corner to the next.
uint32_t Subdivision::sideVertex(size_t triangle, size_t side, uint32_t step) const {
  const uint32_t parts = cuts(triangle, side);
  const BaseMesh::Triangle& corners = mesh_.triangles[triangle];
  if (step == 0) return corners[side];
  if (step == parts) return corners[(side + 1) % 3];
  const uint32_t edge = mesh_.sides[triangle][side];
  const uint32_t fromLow = mesh_.edges[edge][0] == corners[side] ? step : parts - step;
  return static_cast<uint32_t>(edgeFirst_[edge]) + fromLow - 1;
}

uint32_t Subdivision::gridVertex(size_t triangle, uint64_t row, uint64_t column) const {
  return static_cast<uint32_t>(interiorFirst_[triangle] + row * (row + 1) / 2 + column);
}

// Vertex `step` of the grid's own side, along a side of the triangle.
uint32_t Subdivision::gridSideVertex(size_t triangle, size_t side, uint32_t step) const {
  const uint32_t last = rows_[triangle] - kMinGridRows;
  if (side == 0) return gridVertex(triangle, last, step);
  if (side == 1) return gridVertex(triangle, last - step, last - step);
  return gridVertex(triangle, step, 0);
}

void Subdivision::faces(uint64_t first, std::span<Face> out) const {
  for (size_t triangle = holderOf(faceFirst_, first); !out.empty(); ++triangle) {
    const size_t count = std::min<uint64_t>(out.size(), faceFirst_[triangle + 1] - first);
    facesOf(triangle, first - faceFirst_[triangle], out.first(count));
    first += count;
    out = out.subspan(count);
  }
}

// The grid's faces, then those of the strips at sides 0, 1, 2.
void Subdivision::facesOf(size_t triangle, uint64_t first, std::span<Face> out) const {
  if (rows_[triangle] < kMinGridRows) return fanFaces(triangle, first, out);
  const uint64_t last = rows_[triangle] - kMinGridRows;
  const std::array<uint64_t, 4> sizes = {last * last, last + cuts(triangle, 0), last + cuts(triangle, 1),
                                         last + cuts(triangle, 2)};
  for (size_t part = 0; part < sizes.size() && !out.empty(); ++part) {
    if (first >= sizes[part]) {
      first -= sizes[part];
      continue;
    }
    const size_t count = std::min<uint64_t>(out.size(), sizes[part] - first);
    if (part == 0) gridFaces(triangle, first, out.first(count));
    if (part > 0) stripFaces(triangle, part - 1, first, out.first(count));
    first = 0;
    out = out.subspan(count);
  }
}

// Without a grid: a fan over the outline, around the middle of a side where one is cut (no face then lies on a side).
void Subdivision::fanFaces(size_t triangle, uint64_t first, std::span<Face> out) const {
  std::array<uint32_t, 6> outline{};
  size_t count = 0;
  size_t hub = 0;
  for (size_t side = 0; side < 3; ++side)
    for (uint32_t step = 0; step < cuts(triangle, side); ++step) {
      if (step == 1 && hub == 0) hub = count;
      outline[count++] = sideVertex(triangle, side, step);
    }
  for (size_t i = 0; i < out.size(); ++i) {
    const size_t next = hub + 1 + first + i;
    out[i] = {outline[hub], outline[next % count], outline[(next + 1) % count]};
  }
}

// Row by row, between row and row + 1: faces with their tip towards corner 2 and away from it in turn.
void Subdivision::gridFaces(size_t triangle, uint64_t first, std::span<Face> out) const {
  uint64_t row = squareRow(first);
  uint64_t place = first - row * row;
  for (Face& face : out) {
    const uint64_t column = place / 2;
    if (place % 2 == 0) {
      face = {gridVertex(triangle, row + 1, column), gridVertex(triangle, row + 1, column + 1),
              gridVertex(triangle, row, column)};
    } else {
      face = {gridVertex(triangle, row + 1, column + 1), gridVertex(triangle, row, column + 1),
              gridVertex(triangle, row, column)};
    }
    if (++place <= 2 * row) continue;
    ++row;
    place = 0;
  }
}

// Between a side and the grid's side along it: at each turn the shorter of the two edges across that go on.
void Subdivision::stripFaces(size_t triangle, size_t side, uint64_t first, std::span<Face> out) const {
  const int64_t outerParts = cuts(triangle, side);
  const int64_t rows = rows_[triangle];
  const int64_t innerParts = rows - kMinGridRows;
  int64_t outer = 0;
  int64_t inner = 0;
  for (uint64_t i = 0; i < first + out.size(); ++i) {
    // Places along the side, in parts of 2 outerParts rows; the grid begins one and a half of its steps in.
    const int64_t outerPlace = 2 * rows * outer;
    const int64_t innerPlace = outerParts * (2 * inner + 3);
    const bool outerIsNearer =
        std::abs(outerPlace + 2 * rows - innerPlace) <= std::abs(outerPlace - innerPlace - 2 * outerParts);
    const bool alongOuter = inner == innerParts || (outer < outerParts && outerIsNearer);
    if (i >= first) {
      const uint32_t from = sideVertex(triangle, side, static_cast<uint32_t>(outer));
      const uint32_t across = gridSideVertex(triangle, side, static_cast<uint32_t>(inner));
      out[i - first] = alongOuter
                           ? Face{from, sideVertex(triangle, side, static_cast<uint32_t>(outer + 1)), across}
                           : Face{from, gridSideVertex(triangle, side, static_cast<uint32_t>(inner + 1)), across};
    }
    ++(alongOuter ? outer : inner);
  }
}

}  // namespace farcell
