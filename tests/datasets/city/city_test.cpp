#include "datasets/city/city.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "cache/base/process.h"
#include "datasets/city/block.h"
#include "datasets/city/ground.h"
#include "datasets/city/terrain.h"
#include "preprocess/read/open_mesh.h"

namespace farcell {
namespace {

class CityTest : public testing::Test {
 protected:
  CityTest() {
    std::string name = (std::filesystem::temp_directory_path() / "farcell-city.XXXXXX").string();
    directory_ = ::mkdtemp(name.data());
  }
  ~CityTest() override { std::filesystem::remove_all(directory_); }

  CityCounts write(const CitySettings& settings, const std::string& name) {
    Progress silent(false);
    const auto counts = writeCity(settings, directory_ / name, silent);
    if (counts) return *counts;
    ADD_FAILURE() << counts.error().message;
    return {};
  }
  std::string bytes(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(directory_ / name, std::ios::binary).rdbuf();
    return text.str();
  }

  std::filesystem::path directory_;
};

CityCounts count(uint64_t triangles, uint64_t seed = 1) {
  Progress silent(false);
  const auto counts = countCity({triangles, seed, 0}, silent);
  if (counts) return *counts;
  ADD_FAILURE() << counts.error().message;
  return {};
}

TEST_F(CityTest, IsTheSameForTheSameSettingsAtAnyThreadCount) {
  write({400'000, 7, 1}, "one.ply");
  write({400'000, 7, 3}, "three.ply");
  write({400'000, 8, 1}, "other.ply");
  EXPECT_TRUE(bytes("one.ply") == bytes("three.ply"));
  EXPECT_FALSE(bytes("one.ply") == bytes("other.ply"));
}

TEST_F(CityTest, IsReadBackWholeAndWithoutDegenerateTriangles) {
  const CityCounts counts = write({300'000, 3, 0}, "city.ply");
  EXPECT_EQ(std::filesystem::file_size(directory_ / "city.ply"), counts.bytes);
  const auto reader = openMesh(directory_ / "city.ply");
  ASSERT_TRUE(reader);
  EXPECT_TRUE((*reader)->info().hasColours);
  EXPECT_EQ((*reader)->info().vertices, counts.vertices);
  std::set<uint32_t> colours;
  double lowest = 1e9;
  double highest = -1e9;
  const auto found = (*reader)->forEachTriangle([&](std::span<const InputTriangle> batch) -> Result<> {
    for (const InputTriangle& triangle : batch) {
      colours.insert(triangle.colours[0]);
      lowest = std::min(lowest, triangle.positions[0].z);
      highest = std::max(highest, triangle.positions[0].z);
    }
    return {};
  });
  ASSERT_TRUE(found);
  EXPECT_EQ(found->accepted, counts.triangles);
  EXPECT_TRUE(found->skipped.empty());
  EXPECT_GT(colours.size(), 500u);
  EXPECT_GT(lowest, -10);
  EXPECT_GT(highest - lowest, 15);
  EXPECT_LT(highest - lowest, 150);
}

TEST_F(CityTest, IsNeverLargerThanAskedForAndHardlySmaller) {
  for (const uint64_t seed : {1, 2, 3})
    for (const uint64_t wished : {10'000, 33'000, 100'000, 250'000, 1'000'000}) {
      SCOPED_TRACE(fmt::format("seed {} triangles {}", seed, wished));
      const CityCounts counts = count(wished, seed);
      EXPECT_LE(counts.triangles, wished);
      EXPECT_GE(static_cast<double>(counts.triangles), 0.95 * static_cast<double>(wished));
    }
}

TEST_F(CityTest, CountsWhatItWrites) {
  const CityCounts counted = count(150'000, 4);
  const CityCounts written = write({150'000, 4, 0}, "city.ply");
  EXPECT_EQ(counted.triangles, written.triangles);
  EXPECT_EQ(counted.vertices, written.vertices);
  EXPECT_EQ(counted.bytes, written.bytes);
}

TEST_F(CityTest, NeedsNoMoreMemoryWhenItIsLarger) {
  count(1'000'000);
  const uint64_t before = peakRssBytes();
  count(12'000'000);
  // Held in memory it would be 350 MB more; sanitizers keep some of what was freed.
  EXPECT_LT(peakRssBytes() - before, uint64_t{200} << 20);
}

TEST_F(CityTest, RefusesSizesThatMakeNoSense) {
  Progress silent(false);
  const auto tiny = writeCity({kMinCityTriangles - 1, 1, 0}, directory_ / "tiny.ply", silent);
  ASSERT_FALSE(tiny);
  EXPECT_EQ(tiny.error().kind, ErrorKind::invalidArgument);
  EXPECT_FALSE(writeCity({10'000, 1, 0}, directory_ / "missing" / "city.ply", silent));
  EXPECT_TRUE(std::filesystem::is_empty(directory_));
}

TEST_F(CityTest, BlocksGoRoundInASquareSpiral) {
  std::set<std::pair<int64_t, int64_t>> seen;
  for (int64_t ring = 0, index = 0; ring < 20; ++ring)
    for (; index < (2 * ring + 1) * (2 * ring + 1); ++index) {
      const city::BlockKey key = city::blockAt(static_cast<uint64_t>(index));
      EXPECT_EQ(std::max(std::abs(key.x), std::abs(key.y)), ring);
      EXPECT_TRUE(seen.insert({key.x, key.y}).second);
    }
}

TEST_F(CityTest, NeighbouringBlocksMeetInTheMiddleOfTheStreet) {
  for (int64_t axis = 0; axis < 2; ++axis)
    for (int64_t i = -30; i < 30; ++i) {
      const city::Span span = city::blockSpan(9, axis, i);
      EXPECT_EQ(span.high, city::blockSpan(9, axis, i + 1).low);
      EXPECT_EQ(span.halfStreetHighM, city::blockSpan(9, axis, i + 1).halfStreetLowM);
      EXPECT_GT(span.innerHigh() - span.innerLow(), 40);
    }
}

TEST_F(CityTest, RollsGently) {
  for (int i = -200; i < 200; ++i)
    for (int j = -20; j < 20; ++j) {
      const double x = 13.7 * i;
      const double y = 131.3 * j;
      const double dx = city::groundHeight(5, x + 0.5, y) - city::groundHeight(5, x - 0.5, y);
      const double dy = city::groundHeight(5, x, y + 0.5) - city::groundHeight(5, x, y - 0.5);
      ASSERT_LT(std::sqrt(dx * dx + dy * dy), 0.08);
    }
}

TEST_F(CityTest, ABlockStaysOnItsPlot) {
  city::Mesh mesh;
  for (uint64_t i = 0; i < 60; ++i) {
    const city::BlockKey key = city::blockAt(i);
    city::buildBlock(mesh, 1, key, UINT64_MAX);
    const city::Span x = city::blockSpan(1, 0, key.x);
    const city::Span y = city::blockSpan(1, 1, key.y);
    ASSERT_GT(mesh.triangles().size(), 5'000u);
    for (const city::Vertex& vertex : mesh.vertices()) {
      ASSERT_GT(vertex.x, x.low - 1e-3);
      ASSERT_LT(vertex.x, x.high + 1e-3);
      ASSERT_GT(vertex.y, y.low - 1e-3);
      ASSERT_LT(vertex.y, y.high + 1e-3);
    }
    for (const auto& triangle : mesh.triangles())
      for (const uint32_t index : triangle) ASSERT_LT(index, mesh.vertices().size());
  }
}

}  // namespace
}  // namespace farcell
