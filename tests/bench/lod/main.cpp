// Makes the levels of detail of a model by several ways and says what each costs and keeps.
// usage: bench_lod <model> [--leaf-triangles N] [--target N] [--way NAME] [--threads N] [--ply DIRECTORY]
#include <CLI/CLI.hpp>
#include <fstream>

#include "cache/base/parallel.h"
#include "tests/bench/lod/appearance.h"
#include "tests/bench/lod/tree.h"
#include "tests/bench/lod/ways.h"
#include "tests/bench/thread_seconds.h"

namespace farcell::bench {
namespace {

constexpr size_t kComparedCells = 6;  // a level

struct Options {
  std::string model, way, ply;
  int leafTriangles = 16384;
  uint64_t target = 16384;
  int threads = 1;
  int imageSize = 128;
};

struct Level {
  size_t cells = 0, above = 0;
  uint64_t trianglesIn = 0, trianglesOut = 0, locked = 0, most = 0;
  double seconds = 0, error = 0, coverage = 0, imageError = 0, worstCoverage = 1;
  size_t compared = 0;
};

struct Made {
  LodMesh mesh;
  double errorSteps = 0;
};

Result<CellSoup> fullSoup(const Tree& tree, const CellKey& cell) {
  CellSoup soup;
  for (const CellKey& leaf : leavesBelow(tree, cell)) {
    FARCELL_ASSIGN(const LodMesh mesh, leafMesh(tree, leaf));
    const CellSoup part = cellSoup(tree.partition.grid, cell, mesh);
    for (size_t k = 0; k < 3; ++k) {
      soup.x[k].insert(soup.x[k].end(), part.x[k].begin(), part.x[k].end());
      soup.y[k].insert(soup.y[k].end(), part.y[k].begin(), part.y[k].end());
      soup.z[k].insert(soup.z[k].end(), part.z[k].begin(), part.z[k].end());
      soup.colours[k].insert(soup.colours[k].end(), part.colours[k].begin(), part.colours[k].end());
    }
  }
  return soup;
}

void writePly(const std::filesystem::path& path, const Grid& grid, std::span<const Made> cells) {
  size_t vertices = 0, triangles = 0;
  for (const Made& cell : cells) vertices += cell.mesh.positions.size(), triangles += cell.mesh.triangles();
  std::ofstream file(path);
  file << "ply\nformat ascii 1.0\nelement vertex " << vertices
       << "\nproperty double x\nproperty double y\nproperty double z\nproperty uchar red\nproperty uchar "
          "green\nproperty "
          "uchar blue\nelement face "
       << triangles << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Made& cell : cells)
    for (size_t i = 0; i < cell.mesh.positions.size(); ++i) {
      const glm::dvec3 p = grid.worldFromGrid(cell.mesh.positions[i]);
      const uint32_t colour = cell.mesh.colours[i];
      file << fmt::format("{:.9g} {:.9g} {:.9g} {} {} {}\n", p.x, p.y, p.z, colour & 255, colour >> 8 & 255,
                          colour >> 16 & 255);
    }
  size_t first = 0;
  for (const Made& cell : cells) {
    for (size_t i = 0; i < cell.mesh.indices.size(); i += 3)
      file << fmt::format("3 {} {} {}\n", first + cell.mesh.indices[i], first + cell.mesh.indices[i + 1],
                          first + cell.mesh.indices[i + 2]);
    first += cell.mesh.positions.size();
  }
}

class Run {
 public:
  Run(const Tree& tree, const Way& way, const Options& options) : tree_(tree), way_(way), options_(options) {}

  Result<> all() {
    for (const auto& [key, index] : tree_.leaves) made_[key];
    for (const auto& [key, children] : tree_.children) made_[key];
    std::vector<CellKey> leaves;
    for (const auto& [key, index] : tree_.leaves) leaves.push_back(key);
    parallelFor(leaves.size(), options_.threads,
                [&](size_t i, int) { made_.at(leaves[i]).mesh = leafMesh(tree_, leaves[i]).value(); });
    for (uint32_t level = tree_.children.rbegin()->first.level + 1; level-- > 0;) FARCELL_TRY(one(level));
    return {};
  }

 private:
  Result<> one(uint32_t levelNumber) {
    std::vector<CellKey> cells;
    for (const auto& [key, children] : tree_.children)
      if (key.level == levelNumber) cells.push_back(key);
    Level level;
    level.cells = cells.size();
    std::vector<double> seconds(cells.size());
    std::vector<LodFigures> figures(cells.size());
    parallelFor(cells.size(), options_.threads, [&](size_t i, int) {
      std::vector<LodMesh> children;
      double childrenError = 0;
      for (const CellKey& child : tree_.children.at(cells[i])) {
        children.push_back(std::move(made_.at(child).mesh));
        childrenError = std::max(childrenError, made_.at(child).errorSteps);
      }
      const double start = threadSeconds();
      SimplifiedCell cell =
          way_.simplify(tree_.partition.grid, cells[i], children, childrenError, options_.target).value();
      seconds[i] = threadSeconds() - start;
      figures[i] = cell.figures;
      made_.at(cells[i]) = {std::move(cell.mesh), cell.errorSteps};
    });
    for (size_t i = 0; i < cells.size(); ++i) {
      const Made& made = made_.at(cells[i]);
      level.seconds += seconds[i];
      level.trianglesIn += figures[i].childTriangles;
      level.trianglesOut += made.mesh.triangles();
      level.most = std::max<uint64_t>(level.most, made.mesh.triangles());
      level.above += made.mesh.triangles() > options_.target;
      level.locked = std::max(level.locked, figures[i].lockedTriangles);
      level.error = std::max(level.error, made.errorSteps);
    }
    FARCELL_TRY(look(cells, level));
    print(levelNumber, level);
    return {};
  }

  // Of cells spread over the level.
  Result<> look(const std::vector<CellKey>& cells, Level& level) {
    if (options_.imageSize == 0) return {};
    const size_t step = (cells.size() + kComparedCells - 1) / kComparedCells;
    std::vector<Made> shown;
    for (size_t i = 0; i < cells.size(); i += step) {
      const Made& made = made_.at(cells[i]);
      FARCELL_ASSIGN(const CellSoup full, fullSoup(tree_, cells[i]));
      const Appearance appearance =
          compare(full, cellSoup(tree_.partition.grid, cells[i], made.mesh), options_.imageSize);
      level.coverage += appearance.coverage;
      level.imageError += appearance.imageError;
      level.worstCoverage = std::min(level.worstCoverage, appearance.coverage);
      ++level.compared;
    }
    if (options_.ply.empty()) return {};
    for (const CellKey& cell : cells) shown.push_back(made_.at(cell));
    writePly(std::filesystem::path(options_.ply) / fmt::format("{}-{}.ply", way_.name, cells[0].level),
             tree_.partition.grid, shown);
    return {};
  }

  void print(uint32_t number, const Level& level) const {
    const double side = std::ldexp(1.0, tree_.partition.grid.bits - static_cast<int>(number));
    const double compared = std::max<double>(1, static_cast<double>(level.compared));
    fmt::print("| {} | {} | {} | {} | {} | {} | {} | {} | {:.2f} | {:.2f} | {:.4f} | {:.3f} | {:.3f} | {:.2f} |\n",
               way_.name, number, level.cells, level.trianglesIn, level.trianglesOut, level.most, level.above,
               level.locked, level.seconds, 1e-6 * static_cast<double>(level.trianglesIn) / level.seconds,
               level.error / side, level.coverage / compared, level.worstCoverage, level.imageError / compared);
    std::fflush(stdout);
  }

  const Tree& tree_;
  const Way& way_;
  const Options& options_;
  std::map<CellKey, Made> made_;
};

class Scratch {
 public:
  Scratch() : name_((std::filesystem::temp_directory_path() / "bench_lod.XXXXXX").string()) { ::mkdtemp(name_.data()); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() { std::filesystem::remove_all(name_); }
  const std::string& path() const { return name_; }

 private:
  std::string name_;
};

int run(const Options& options) {
  const Scratch scratch;
  const Result<Tree> tree = treeOf(options.model, options.leafTriangles, scratch.path());
  if (!tree) {
    fmt::print(stderr, "bench_lod: {}\n", tree.error().message);
    return 1;
  }
  fmt::print("{}, {} leaves of at most {} triangles, target {}\n\n", options.model, tree->leaves.size(),
             options.leafTriangles, options.target);
  fmt::print(
      "| way | level | cells | triangles in | out | most | above target | most locked | CPU s | Mtri/s | error / side "
      "| "
      "coverage | worst | image error |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const Way& way : ways()) {
    if (!options.way.empty() && options.way != way.name) continue;
    if (const Result<> done = Run(*tree, way, options).all(); !done) {
      fmt::print(stderr, "bench_lod: {}\n", done.error().message);
      return 1;
    }
  }
  return 0;
}

}  // namespace
}  // namespace farcell::bench

int main(int argc, char** argv) {
  farcell::bench::Options options;
  CLI::App app("Levels of detail: what ways of simplifying cost and keep.", "bench_lod");
  app.add_option("model", options.model, "mesh file")->required();
  app.add_option("--leaf-triangles", options.leafTriangles, "most triangles of a leaf");
  app.add_option("--target", options.target, "triangles of an inner cell");
  app.add_option("--way", options.way, "this way only");
  app.add_option("--threads", options.threads, "cells at once");
  app.add_option("--image-size", options.imageSize, "texels along a view that is compared; 0: compare none");
  app.add_option("--ply", options.ply, "write each level's meshes into this directory");
  CLI11_PARSE(app, argc, argv);
  return farcell::bench::run(options);
}
