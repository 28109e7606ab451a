// Meshes without files, made while they are read: of any size, without memory of their own.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "preprocess/mesh/mesh_reader.h"

namespace farcell {

// Well mixed bits of an index: the same for every pass.
inline uint64_t mixedBits(uint64_t value) {
  value = (value ^ value >> 31) * 0x7fb5d329728ea185ull;
  value = (value ^ value >> 27) * 0x81dadef4bc2dd44dull;
  return value ^ value >> 33;
}
inline double unitFrom(uint64_t bits) { return static_cast<double>(mixedBits(bits) >> 11) * 0x1p-53; }

class StreamedMesh : public MeshReader {
 public:
  using Triangle = std::function<std::array<glm::dvec3, 3>(uint64_t index)>;
  StreamedMesh(uint64_t count, Triangle triangle) : count_(count), triangle_(std::move(triangle)) {
    info_.declaredTriangles = count;
  }
  const MeshInfo& info() const override { return info_; }
  std::vector<std::filesystem::path> files() const override { return {}; }
  Result<MeshCounts> forEachTriangle(const Sink& sink) override {
    std::vector<InputTriangle> batch(2048);
    for (uint64_t first = 0; first < count_; first += batch.size()) {
      batch.resize(std::min<uint64_t>(2048, count_ - first));
      for (size_t i = 0; i < batch.size(); ++i) batch[i].positions = triangle_(first + i);
      if (Result<> taken = sink(batch); !taken) return tl::unexpected<Error>(std::move(taken).error());
    }
    return MeshCounts{count_, {}};
  }

 private:
  MeshInfo info_;
  uint64_t count_;
  Triangle triangle_;
};

// A bumpy sphere of rings of triangles, neighbours one after another; shuffled: in an order without any locality.
inline StreamedMesh sphereMesh(uint64_t triangles, bool shuffled) {
  const auto columns = static_cast<uint64_t>(std::sqrt(static_cast<double>(triangles)));
  const uint64_t rows = triangles / (2 * columns), count = 2 * columns * rows;
  const auto point = [=](uint64_t row, uint64_t column) {
    const double v = M_PI * static_cast<double>(row + 1) / static_cast<double>(rows + 2);
    const double u = 2 * M_PI * static_cast<double>(column % columns) / static_cast<double>(columns);
    const double radius = 10 + 0.5 * std::sin(7 * u) * std::sin(5 * v);
    return glm::dvec3(std::sin(v) * std::cos(u), std::sin(v) * std::sin(u), std::cos(v)) * radius;
  };
  return {count, [=](uint64_t index) -> std::array<glm::dvec3, 3> {
            // Coprime to count where it is prime and larger: a permutation.
            const uint64_t at = shuffled ? index * 2654435761u % count : index;
            const uint64_t quad = at / 2, row = quad / columns, column = quad % columns;
            if (at % 2 == 0) return {point(row, column), point(row + 1, column), point(row + 1, column + 1)};
            return {point(row, column), point(row + 1, column + 1), point(row, column + 1)};
          }};
}

// Small triangles in a speck, and two that span the model a thousand times as wide.
inline StreamedMesh speckMesh(uint64_t triangles) {
  return {triangles, [=](uint64_t i) -> std::array<glm::dvec3, 3> {
            if (i < 2) return {glm::dvec3(0), glm::dvec3(1000, i == 0 ? 0 : 1000, 0), glm::dvec3(1000, 1000, 1000)};
            const glm::dvec3 at(unitFrom(6 * i), unitFrom(6 * i + 1), unitFrom(6 * i + 2));
            const glm::dvec3 side(unitFrom(6 * i + 3), unitFrom(6 * i + 4), unitFrom(6 * i + 5));
            return {at, at + side * 1e-2, at + glm::dvec3(side.y, side.z, side.x) * 1e-2};
          }};
}

// Needles that all have one corner in common.
inline StreamedMesh starMesh(uint64_t triangles) {
  return {triangles, [=](uint64_t i) -> std::array<glm::dvec3, 3> {
            const glm::dvec3 tip(unitFrom(3 * i) - 0.3, unitFrom(3 * i + 1) - 0.3, unitFrom(3 * i + 2) - 0.3);
            return {glm::dvec3(0.0123), tip, tip + glm::dvec3(1e-4, 2e-4, -1e-4)};
          }};
}

// One small triangle again and again, in a wide model.
inline StreamedMesh duplicateMesh(uint64_t triangles) {
  return {triangles, [=](uint64_t i) -> std::array<glm::dvec3, 3> {
            if (i == 0) return {glm::dvec3(0), glm::dvec3(100, 0, 0), glm::dvec3(100, 100, 100)};
            return {glm::dvec3(0.7003), glm::dvec3(0.7004, 0.7003, 0.7003), glm::dvec3(0.7003, 0.7004, 0.7003)};
          }};
}

// Triangles as large as the model.
inline StreamedMesh coveringMesh(uint64_t triangles) {
  return {triangles, [=](uint64_t i) -> std::array<glm::dvec3, 3> {
            const auto corner = [&](uint64_t k) {
              return glm::dvec3(unitFrom(9 * i + 3 * k), unitFrom(9 * i + 3 * k + 1), unitFrom(9 * i + 3 * k + 2));
            };
            return {corner(0), corner(1), corner(2)};
          }};
}

// Thin strips along one axis, each across many cells and few planes: pieces are doubled again and again.
inline StreamedMesh stripMesh(uint64_t triangles) {
  return {triangles, [=](uint64_t i) -> std::array<glm::dvec3, 3> {
            const double y = unitFrom(2 * i) * 0.001, z = unitFrom(2 * i + 1) * 0.001;
            return {glm::dvec3(0, y, z), glm::dvec3(1, y, z), glm::dvec3(1, y + 1e-6, z)};
          }};
}

}  // namespace farcell
