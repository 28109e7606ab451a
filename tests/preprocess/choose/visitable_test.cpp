// What is said to be unseen is never drawn: visitors at random places of a region, drawn for by the runtime's
// selection.
#include "preprocess/choose/visitable.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "runtime/selection/selection.h"
#include "tests/preprocess/choose/trees.h"

namespace farcell {
namespace {

constexpr int kSteps = 1 << kMaxGridBits;

// A hilly ground with buildings on it; heights in grid steps along the up axis.
struct City {
  Directory directory;
  double hill = 0;  // amplitude
  int up = 2;

  double groundAt(double east, double north) const {
    const double turns = 2 * std::numbers::pi / kSteps;
    return kSteps * 0.5 + hill * (std::sin(3 * turns * east) + std::cos(2 * turns * north));
  }
};

class CityMaker {
 public:
  CityMaker(City& city, std::mt19937& random) : city_(city), random_(random) {}

  void split(const CellKey& key) {
    const GridBox cube = cellBox(city_.directory.model.grid, key);
    GridBox content = cube;
    const int up = city_.up, east = (up + 1) % 3, north = (up + 2) % 3;
    double low = kSteps, high = 0;
    constexpr int kLattice = 8;
    for (int i = 0; i <= kLattice; ++i)
      for (int j = 0; j <= kLattice; ++j) {
        const double height =
            city_.groundAt(cube.min[east] + double(cube.max[east] - cube.min[east]) * i / kLattice,
                           cube.min[north] + double(cube.max[north] - cube.min[north]) * j / kLattice);
        low = std::min(low, height);
        high = std::max(high, height);
      }
    // Between lattice points the ground may be lower.
    low -= city_.hill * 20.0 / kSteps * (cube.max.x - cube.min.x) / kLattice;
    const double buildings = kSteps * 0.01;
    content.min[up] = std::max(cube.min[up], static_cast<int>(low));
    content.max[up] = std::min(cube.max[up], static_cast<int>(high + buildings));
    if (content.min[up] > content.max[up]) return;
    if (key.level >= 5 || (key.level >= 2 && random_() % 4 == 0)) {
      leaves.push_back({key, content, 1000});
      return;
    }
    for (uint32_t octant = 0; octant < 8; ++octant) split(key.child(octant));
  }

  std::vector<TestLeaf> leaves;

 private:
  City& city_;
  std::mt19937& random_;
};

City cityOf(std::mt19937& random, double hill, int up, int views) {
  City city;
  city.hill = hill;
  city.up = up;
  Model& model = city.directory.model;
  model.grid = Grid{{1e6, -2e6, 300}, 5000, kMaxGridBits};
  model.settings.up = static_cast<UpAxis>(up);
  model.settings.form.views = views;
  CityMaker maker(city, random);
  maker.split({});
  city.directory.cells = treeOf(maker.leaves);
  for (CellRecord& cell : city.directory.cells) cell.form = model.settings.form;
  model.bounds = city.directory.cells[0].content;
  return city;
}

class Visits {
 public:
  Visits(const City& city, const Region& region, std::mt19937& random)
      : city_(city),
        viewpoints_(*Viewpoints::create(city.directory.model.settings.form.views)),
        visitable_(region, city.directory.model, city.directory.cells, viewpoints_),
        random_(random) {
    for (const CellRecord& cell : city.directory.cells) seen_.push_back(visitable_.seen(cell));
  }

  // Looks somewhere from a place in the world. What the runtime draws, and is not from inside a leaf, must be seen.
  void look(glm::dvec3 position) {
    std::uniform_real_distribution<double> around(-1, 1);
    Camera camera;
    camera.position = position;
    camera.target = position + glm::dvec3(around(random_), around(random_), around(random_) + 1e-3);
    camera.up = glm::dvec3(0.1, 0.2, 1);
    camera.fovYRad = 2.8;
    SelectionSettings settings;
    settings.mode = RenderMode::impostors;
    settings.texelPixels = std::exp2(6 * around(random_));
    const Cut cut = selectCut(city_.directory, camera, 1000, 1000, settings);
    for (const CutEntry& entry : cut.entries) {
      if (std::isinf(entry.errorPixels)) continue;
      ++drawn_;
      EXPECT_TRUE(seen_[entry.cell][entry.view]) << "cell " << entry.cell << " view " << entry.view;
      EXPECT_TRUE(seen_[entry.cell][entry.secondView]) << "cell " << entry.cell << " second " << entry.secondView;
    }
  }

  double shareSeen() const {
    size_t seen = 0, all = 0;
    for (const ViewMask& mask : seen_) {
      all += mask.size();
      seen += static_cast<size_t>(std::count(mask.begin(), mask.end(), true));
    }
    return static_cast<double>(seen) / static_cast<double>(all);
  }
  size_t drawn() const { return drawn_; }

 private:
  const City& city_;
  const Viewpoints viewpoints_;
  const Visitable visitable_;
  std::mt19937& random_;
  std::vector<ViewMask> seen_;
  size_t drawn_ = 0;
};

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

TEST(Visitable, NobodyAboveTheGroundMissesAView) {
  for (const unsigned seed : {1u, 2u, 3u, 4u, 5u, 6u}) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const City city = cityOf(random, seed % 2 == 0 ? 0 : kSteps * 0.01, seed % 3, seed > 4 ? 162 : 42);
    const Grid& grid = city.directory.model.grid;
    Visits visits(city, Region{Region::Kind::aboveGround, {}}, random);
    EXPECT_LT(visits.shareSeen(), city.hill > 0 ? 0.99 : 0.9);
    for (int i = 0; i < 300; ++i) {
      const int up = city.up, east = (up + 1) % 3, north = (up + 2) % 3;
      glm::dvec3 steps;
      steps[east] = uniform(random, 0, kSteps);
      steps[north] = uniform(random, 0, kSteps);
      // On the ground, mostly.
      steps[up] = city.groundAt(steps[east], steps[north]) + (i % 3 > 0 ? 0 : std::exp2(uniform(random, 0, 26)));
      visits.look(grid.origin + steps * grid.step());
    }
    EXPECT_GT(visits.drawn(), 1000u);
  }
}

TEST(Visitable, NobodyInABoxMissesAView) {
  for (const unsigned seed : {1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u}) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const City city = cityOf(random, kSteps * 0.01, 2, seed > 6 ? 162 : 42);
    const Grid& grid = city.directory.model.grid;
    Region region{Region::Kind::boxes, {}};
    for (unsigned box = 0; box < seed; ++box) {
      glm::dvec3 centre, extent;
      for (int axis = 0; axis < 3; ++axis) {
        centre[axis] = uniform(random, -0.5, 1.5) * grid.side;
        extent[axis] = std::exp2(uniform(random, -12, seed == 3 ? 20 : -1)) * grid.side;
      }
      region.boxes.push_back({grid.origin + centre - extent, grid.origin + centre + extent});
    }
    Visits visits(city, region, random);
    for (int i = 0; i < 300; ++i) {
      const WorldBox& box = region.boxes[random() % region.boxes.size()];
      glm::dvec3 position;
      for (int axis = 0; axis < 3; ++axis) position[axis] = uniform(random, box.min[axis], box.max[axis]);
      visits.look(position);
    }
    EXPECT_GT(visits.drawn(), 100u);
  }
}

TEST(Visitable, EverywhereIsEveryView) {
  std::mt19937 random(1);
  const City city = cityOf(random, 0, 2, 42);
  EXPECT_EQ(Visits(city, Region{}, random).shareSeen(), 1);
}

TEST(Visitable, OneFarPlaceSeesFewViews) {
  std::mt19937 random(1);
  const City city = cityOf(random, 0, 2, 162);
  const Grid& grid = city.directory.model.grid;
  const glm::dvec3 place = grid.origin + glm::dvec3(200 * grid.side, 3 * grid.side, 10 * grid.side);
  const Visits visits(city, Region{Region::Kind::boxes, {{place, place}}}, random);
  EXPECT_LE(visits.shareSeen(), 4.0 / 162);
  EXPECT_GE(visits.shareSeen(), 2.0 / 162);
}

TEST(Visitable, OnFlatGroundNobodySeesABlockFromBelow) {
  std::mt19937 random(1);
  const City city = cityOf(random, 0, 2, 42);
  const Viewpoints viewpoints = *Viewpoints::create(42);
  const Visitable visitable(Region{Region::Kind::aboveGround, {}}, city.directory.model, city.directory.cells,
                            viewpoints);
  const int below = viewpoints.nearest({0.01, 0.02, -1}), above = viewpoints.nearest({0.01, 0.02, 1});
  size_t unseen = 0;
  for (const CellRecord& cell : city.directory.cells) {
    EXPECT_TRUE(visitable.canBeSeen(cell, above));
    if (!visitable.canBeSeen(cell, below)) ++unseen;
  }
  EXPECT_GT(unseen, city.directory.cells.size() * 9 / 10);
}

TEST(Ground, LiesBelowWhatHangsOverIt) {
  // A block on the ground, and one in the air beside it.
  Model model;
  model.grid = Grid{{0, 0, 0}, 1, kMaxGridBits};
  const CellKey low{4, 3, 3, 2}, high{4, 4, 3, 9};
  const GridBox lowBox = cellBox(model.grid, low), highBox = cellBox(model.grid, high);
  const auto cells = treeOf({{low, lowBox, 10}, {high, highBox, 10}});
  model.bounds = cells[0].content;
  const Ground ground(model, cells);
  const double width = lowBox.max.x - lowBox.min.x;
  const glm::dvec3 under = glm::dvec3(highBox.min + highBox.max) * 0.5;
  EXPECT_GE(ground.heightAt(under), lowBox.min.z);
  EXPECT_LE(ground.heightAt(under), lowBox.min.z + kGroundSlope * width);
  EXPECT_EQ(ground.heightAt(glm::dvec3(lowBox.min) + width * 0.5), lowBox.min.z);
  EXPECT_EQ(ground.heightAt({-1e9, 0, 0}), lowBox.min.z);
}

}  // namespace
}  // namespace farcell
