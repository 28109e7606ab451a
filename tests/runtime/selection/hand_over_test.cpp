#include "runtime/selection/hand_over.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <random>
#include <set>
#include <tuple>

namespace farcell {
namespace {

constexpr int kWidth = 320, kHeight = 240, kDepth = 4;

// The planes between the children of a few cells, the others left whole; every cell has views, leaves have triangles.
Directory treeOf(unsigned seed) {
  Directory directory;
  directory.model.grid = Grid{{5, -7, 100}, 64, 24};
  directory.model.settings.form.imageSize = 64;
  std::mt19937 random(seed);
  directory.cells.resize(1);
  for (uint32_t i = 0; i < directory.cells.size(); ++i) {
    CellRecord& cell = directory.cells[i];
    cell.content = cellBox(directory.model.grid, cell.key);
    cell.form = directory.model.settings.form;
    cell.triangles = 100;
    cell.firstViewPage = 0;
    cell.viewPageCount = 1;
    if (static_cast<int>(cell.key.level) == kDepth || random() % 4 == 3) {
      cell.meshTriangles = 100;
      cell.firstGeometryPage = 0;
      cell.geometryPageCount = 1;
      continue;
    }
    cell.firstChild = static_cast<uint32_t>(directory.cells.size());
    cell.childCount = 8;
    const CellKey key = cell.key;
    for (uint32_t octant = 0; octant < 8; ++octant) {
      CellRecord child;
      child.key = key.child(octant);
      child.parent = i;
      directory.cells.push_back(child);
    }
  }
  return directory;
}

Camera cameraAt(const Directory& directory, glm::dvec3 eye) {
  const Grid& grid = directory.model.grid;
  return {
      "test", grid.origin + eye * grid.side, grid.origin + glm::dvec3(0.51, 0.52, 0.53) * grid.side, {0, 0, 1}, 0.9};
}

SelectionSettings settingsOf(RenderMode mode) {
  SelectionSettings settings;
  settings.mode = mode;
  return settings;
}

// How a leaf is drawn: cell, way, view.
using Way = std::tuple<uint32_t, Representation, uint32_t>;

// By leaf, for one share; a leaf that has two ways fails.
std::map<uint32_t, Way> waysOf(const Directory& directory, const Cut& cut, int share) {
  std::map<uint32_t, Way> ways;
  for (const CutEntry& entry : cut.entries) {
    if ((entry.shares >> share & 1) == 0) continue;
    for (uint32_t leaf = 0; leaf < directory.cells.size(); ++leaf) {
      if (directory.cells[leaf].childCount > 0) continue;
      uint32_t above = leaf;
      while (above != kNone && above != entry.cell) above = directory.cells[above].parent;
      if (above == kNone) continue;
      const bool isNew = ways.emplace(leaf, Way(entry.cell, entry.representation, entry.view)).second;
      EXPECT_TRUE(isNew) << "leaf " << leaf << " is drawn twice in share " << share;
    }
  }
  return ways;
}

std::vector<glm::dvec3> eyes() {
  return {{-2, 0.3, 0.4}, {0.5, 0.5, 4}, {0.5, 0.5, 0.5}, {0.3, 0.6, 0.1}, {0, 0, 0}, {4, 3, 2}, {9, -8, 12}};
}

TEST(HandOver, everyShareIsACutOfAllThatIsInView) {
  for (const unsigned seed : {1u, 2u}) {
    const Directory directory = treeOf(seed);
    for (const RenderMode mode : {RenderMode::automatic, RenderMode::impostors})
      for (const glm::dvec3 eye : eyes()) {
        SCOPED_TRACE(fmt::format("seed {} mode {} eye {} {} {}", seed, static_cast<int>(mode), eye.x, eye.y, eye.z));
        const Camera camera = cameraAt(directory, eye);
        std::set<uint32_t> expected;
        for (const CutEntry& entry :
             selectCut(directory, camera, kWidth, kHeight, settingsOf(RenderMode::triangles)).entries)
          expected.insert(entry.cell);
        const Cut cut = selectHandOver(directory, camera, kWidth, kHeight, settingsOf(mode));
        uint64_t triangles = 0;
        for (const CutEntry& entry : cut.entries) {
          EXPECT_NE(entry.shares, 0);
          if (entry.representation != Representation::impostor) triangles += directory.cells[entry.cell].meshTriangles;
        }
        EXPECT_EQ(cut.triangles, triangles);
        for (int share = 0; share < kShares; ++share) {
          const auto ways = waysOf(directory, cut, share);
          for (const uint32_t leaf : expected) EXPECT_TRUE(ways.count(leaf)) << "leaf " << leaf << " share " << share;
        }
      }
  }
}

TEST(HandOver, everyShareIsInTheOrderOfItsOwnCut) {
  const Directory directory = treeOf(3);
  for (const glm::dvec3 eye : eyes()) {
    SCOPED_TRACE(fmt::format("eye {} {} {}", eye.x, eye.y, eye.z));
    const Camera camera = cameraAt(directory, eye);
    const Cut cut = selectHandOver(directory, camera, kWidth, kHeight, settingsOf(RenderMode::impostors));
    // The order of leaves, in which each entry stands where its first leaf does.
    std::map<uint32_t, size_t> places;
    for (const CutEntry& entry : selectCut(directory, camera, kWidth, kHeight, settingsOf(RenderMode::full)).entries)
      places.emplace(entry.cell, places.size());
    for (int share = 0; share < kShares; ++share) {
      std::map<uint32_t, size_t> first;  // by cell drawn
      for (const auto& [leaf, way] : waysOf(directory, cut, share)) {
        const size_t place = places.at(leaf);
        auto& own = first.emplace(std::get<0>(way), place).first->second;
        own = std::min(own, place);
      }
      size_t last = 0;
      for (const CutEntry& entry : cut.entries) {
        if ((entry.shares >> share & 1) == 0) continue;
        EXPECT_GE(first.at(entry.cell), last);
        last = first.at(entry.cell);
      }
    }
  }
}

// Leaves' shares that a step of the eye changes: all at once without hand-over.
int mostSharesAtOnce(const Directory& directory, const std::vector<glm::dvec3>& path, bool handOver, int& changes) {
  std::array<std::map<uint32_t, Way>, kShares> before;
  int most = 0;
  for (const glm::dvec3 eye : path) {
    const Camera camera = cameraAt(directory, eye);
    const SelectionSettings settings = settingsOf(RenderMode::impostors);
    const Cut cut = handOver ? selectHandOver(directory, camera, kWidth, kHeight, settings)
                             : selectCut(directory, camera, kWidth, kHeight, settings);
    std::map<uint32_t, int> changed;
    for (int share = 0; share < kShares; ++share) {
      auto ways = waysOf(directory, cut, share);
      for (const auto& [leaf, way] : before[static_cast<size_t>(share)])
        changed[leaf] += ways.count(leaf) && ways.at(leaf) != way;
      before[static_cast<size_t>(share)] = std::move(ways);
    }
    for (const auto& [leaf, count] : changed) {
      most = std::max(most, count);
      changes += count;
    }
  }
  return most;
}

TEST(HandOver, sharesLeaveOneAfterTheOther) {
  const Directory directory = treeOf(4);
  std::vector<glm::dvec3> dolly, turn;
  for (int i = 0; i < 200; ++i) {
    dolly.push_back(glm::dvec3(0.5) + glm::dvec3(3, 2, 2.5) * std::exp2(0.008 * i));
    turn.push_back(glm::dvec3(0.5) + 9.0 * glm::dvec3(std::cos(0.004 * i), std::sin(0.004 * i), 0.3));
  }
  for (const auto& path : {dolly, turn}) {
    int together = 0, apart = 0;
    EXPECT_EQ(mostSharesAtOnce(directory, path, false, together), kShares);
    EXPECT_LE(mostSharesAtOnce(directory, path, true, apart), 2);
    EXPECT_GT(apart, 0);
  }
}

}  // namespace
}  // namespace farcell
