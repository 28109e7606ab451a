// Small models whose pictures are known, as packs and as mesh files. Triangles of a pack made here must each lie within
// one octant of the grid, so that no clipping is needed and the truth stays exact.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <vector>

#include "cache/base/file.h"
#include "cache/base/hash.h"
#include "cache/pack/pack_file.h"
#include "preprocess/mesh/mesh_reader.h"
#include "shaders/shared/shading.h"
#include "tests/support/evaluate_directory.h"

namespace farcell::testing {

struct TestModel {
  Grid grid;
  bool hasColours = false;
  bool hasSides = false;
  bool hasNormals = false;
  Lighting lighting = Lighting::baked;  // of the pack's views, of which it has none
  std::vector<InputTriangle> triangles;
};

// An octahedron whose faces are split in four `levels` times, pushed to the sphere: triangles keep to octants.
// Inscribed; its deviation from the sphere is radius * (pi / 2 / 2^levels)^2 / 8.
inline TestModel sphereModel(glm::dvec3 centre, double radius, int levels) {
  TestModel model;
  model.grid = gridAround(centre - radius, centre + radius);
  model.hasNormals = true;
  struct Face {
    glm::dvec3 a, b, c;
  };
  std::vector<Face> faces;
  for (int octant = 0; octant < 8; ++octant)
    faces.push_back(
        {{(octant & 1) != 0 ? 1 : -1, 0, 0}, {0, (octant & 2) != 0 ? 1 : -1, 0}, {0, 0, (octant & 4) != 0 ? 1 : -1}});
  for (int level = 0; level < levels; ++level) {
    std::vector<Face> finer;
    for (const Face& f : faces) {
      const glm::dvec3 ab = glm::normalize(f.a + f.b), bc = glm::normalize(f.b + f.c), ca = glm::normalize(f.c + f.a);
      finer.insert(finer.end(), {{f.a, ab, ca}, {ab, f.b, bc}, {ca, bc, f.c}, {ab, bc, ca}});
    }
    faces = std::move(finer);
  }
  for (const Face& f : faces) {
    InputTriangle triangle{};
    triangle.positions = {centre + f.a * radius, centre + f.b * radius, centre + f.c * radius};
    triangle.normals = {glm::vec3(f.a), glm::vec3(f.b), glm::vec3(f.c)};
    model.triangles.push_back(triangle);
  }
  return model;
}

inline uint32_t octahedralSnorm(glm::vec3 normal) {
  const glm::vec2 p = shared::octahedralFromUnit(glm::normalize(normal));
  const auto bits = [](float v) { return static_cast<uint32_t>(static_cast<uint16_t>(std::lround(v * 32767))); };
  return bits(p.x) | bits(p.y) << 16;
}

// The page of a cell, from triangles given in grid points.
inline GeometryPage geometryPage(const TestModel& model, const std::vector<const InputTriangle*>& triangles,
                                 const CellKey& cell) {
  GeometryPage page;
  const GridPoint origin = cellBox(model.grid, cell).min;
  for (const InputTriangle* triangle : triangles)
    for (size_t corner = 0; corner < 3; ++corner) {
      page.indices.push_back(static_cast<uint32_t>(page.positions.size()));
      page.positions.emplace_back(model.grid.gridFromWorld(triangle->positions[corner]) - origin);
      if (model.hasColours) page.colours.push_back(triangle->colours[corner]);
      if (model.hasNormals) page.normals.push_back(octahedralSnorm(triangle->normals[corner]));
    }
  return page;
}

inline GridBox contentBox(const TestModel& model, const std::vector<const InputTriangle*>& triangles) {
  GridBox box;
  for (const InputTriangle* triangle : triangles)
    for (const glm::dvec3& position : triangle->positions) box.include(model.grid.gridFromWorld(position));
  return box;
}

// A root with up to eight leaves, one an octant; `oneLeaf`: the root is the leaf. Pages without views.
inline void writeTestPack(const TestModel& model, const std::filesystem::path& path, uint64_t sourceHash,
                          bool oneLeaf = false) {
  const glm::dvec3 centre = cellCentre(model.grid, {});
  std::vector<std::vector<const InputTriangle*>> byCell(oneLeaf ? 1 : 8);
  for (const InputTriangle& triangle : model.triangles) {
    const glm::dvec3 middle = (triangle.positions[0] + triangle.positions[1] + triangle.positions[2]) / 3.0;
    const size_t octant =
        (middle.x > centre.x ? 1u : 0u) | (middle.y > centre.y ? 2u : 0u) | (middle.z > centre.z ? 4u : 0u);
    byCell[oneLeaf ? 0 : octant].push_back(&triangle);
  }
  Directory directory;
  directory.model.grid = model.grid;
  directory.model.hasColours = model.hasColours;
  directory.model.hasSides = model.hasSides;
  directory.model.hasNormals = model.hasNormals;
  directory.model.settings.lighting = model.lighting;
  directory.sourceName = "model.ply";
  directory.sourceHash = sourceHash;
  directory.report.inputTriangles = model.triangles.size();
  directory.cells.emplace_back();
  CellRecord& root = directory.cells[0];
  root.triangles = model.triangles.size();

  auto writer = PackWriter::create(path);
  ASSERT_TRUE(writer) << writer.error().message;
  for (uint32_t octant = 0; octant < byCell.size(); ++octant) {
    if (byCell[octant].empty()) continue;
    CellRecord cell = directory.cells[0];
    const auto index = oneLeaf ? 0u : static_cast<uint32_t>(directory.cells.size());
    if (!oneLeaf) {
      cell = CellRecord{};
      cell.key = CellKey{}.child(octant);
      cell.parent = 0;
      directory.cells[0].firstChild = 1;
      ++directory.cells[0].childCount;
    }
    cell.content = contentBox(model, byCell[octant]);
    cell.triangles = byCell[octant].size();
    const GeometryPage page = geometryPage(model, byCell[octant], cell.key);
    const std::vector<std::byte> stored = encodeGeometryPage(page);
    directory.report.geometryBytes += stored.size();
    const auto added = writer->add(PageKind::geometry, index, 0, decodedSizeBytes(page), stored);
    ASSERT_TRUE(added) << added.error().message;
    cell.meshTriangles = cell.triangles;
    cell.firstGeometryPage = *added;
    cell.geometryPageCount = 1;
    directory.cells[0].content.include(cell.content);
    if (oneLeaf)
      directory.cells[0] = cell;
    else
      directory.cells.push_back(cell);
  }
  directory.model.bounds = directory.cells[0].content;
  const auto finished = writer->finish(directory);
  ASSERT_TRUE(finished) << finished.error().message;
}

// An ASCII PLY file, and its hash.
inline uint64_t writeTestPly(const TestModel& model, const std::filesystem::path& path) {
  std::ofstream file(path);
  file.precision(17);
  file << "ply\nformat ascii 1.0\nelement vertex " << 3 * model.triangles.size()
       << "\nproperty double x\nproperty double y\nproperty double z\n";
  if (model.hasNormals) file << "property float nx\nproperty float ny\nproperty float nz\n";
  if (model.hasColours) file << "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  file << "element face " << model.triangles.size() << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const InputTriangle& triangle : model.triangles)
    for (size_t corner = 0; corner < 3; ++corner) {
      const glm::dvec3& p = triangle.positions[corner];
      file << p.x << ' ' << p.y << ' ' << p.z;
      if (model.hasNormals)
        file << ' ' << triangle.normals[corner].x << ' ' << triangle.normals[corner].y << ' '
             << triangle.normals[corner].z;
      const uint32_t colour = triangle.colours[corner];
      if (model.hasColours) file << ' ' << (colour & 255) << ' ' << (colour >> 8 & 255) << ' ' << (colour >> 16 & 255);
      file << '\n';
    }
  for (size_t t = 0; t < model.triangles.size(); ++t)
    file << "3 " << 3 * t << ' ' << 3 * t + 1 << ' ' << 3 * t + 2 << '\n';
  file.close();
  std::ifstream in(path, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  return hashBytes(std::as_bytes(std::span(text)));
}

}  // namespace farcell::testing
