#include "preprocess/atlas/charts.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

#include "cache/base/check.h"

namespace farcell {
namespace {

constexpr int kTileTexels = 32;     // at most, of the image
constexpr int64_t kMaxTiles = 256;  // along an edge of what is looked at; tiles are larger where these do not do
constexpr double kLargest = 1e6;    // filter.cpp: of coordinates
constexpr int kMaxPasses = 8;
// An image that is looked at so much is taken whole, so that others' atlases are the same.
constexpr double kMostOfImage = 0.5;

using Tile = glm::i64vec2;
struct TileBox {
  Tile min, max;  // max is outside
};

double saneCoordinate(float x) {
  return std::isfinite(x) ? std::clamp(static_cast<double>(x), -kLargest, kLargest) : 0.0;
}

double periodOf(TextureWrap wrap) { return wrap == TextureWrap::repeat ? 1 : wrap == TextureWrap::mirror ? 2 : 0; }

std::array<glm::dvec2, 3> towardsImage(const TriangleTexture& texture, const TextureShape& shape) {
  std::array<glm::dvec2, 3> moved;
  for (size_t k = 0; k < 3; ++k)
    moved[k] = glm::dvec2(saneCoordinate(texture.coordinates[k].x), saneCoordinate(texture.coordinates[k].y));
  for (int axis = 0; axis < 2; ++axis) {
    const double period = periodOf(axis == 0 ? shape.wrapU : shape.wrapV);
    if (period == 0) continue;
    const double least = std::min({moved[0][axis], moved[1][axis], moved[2][axis]});
    for (glm::dvec2& corner : moved) corner[axis] -= period * std::floor(least / period);
  }
  return moved;
}

// Counts over a grid of tiles, given as boxes; each box costs the same, however large.
class TileCounts {
 public:
  explicit TileCounts(Tile size) : size_(size), counts_(static_cast<size_t>((size.x + 1) * (size.y + 1))) {}
  void add(Tile min, Tile max) {
    if (min.x >= max.x || min.y >= max.y) return;
    ++at(min.x, min.y);
    --at(max.x, min.y);
    --at(min.x, max.y);
    ++at(max.x, max.y);
  }
  void sum() {
    for (int64_t y = 0; y <= size_.y; ++y)
      for (int64_t x = 1; x <= size_.x; ++x) at(x, y) += at(x - 1, y);
    for (int64_t y = 1; y <= size_.y; ++y)
      for (int64_t x = 0; x <= size_.x; ++x) at(x, y) += at(x, y - 1);
  }
  int64_t& at(int64_t x, int64_t y) { return counts_[static_cast<size_t>(y * (size_.x + 1) + x)]; }

 private:
  Tile size_;
  std::vector<int64_t> counts_;
};

// Which component of tiles each box belongs to: boxes that share a tile belong together.
class TileComponents {
 public:
  TileComponents(Tile size, std::span<const TileBox> boxes)
      : size_(size), numbers_(static_cast<size_t>(size.x * size.y), -1) {
    TileCounts covered(size), right(size), up(size);  // a tile; and that it is in one box with its neighbour
    for (const TileBox& box : boxes) {
      covered.add(box.min, box.max);
      right.add(box.min, {box.max.x - 1, box.max.y});
      up.add(box.min, {box.max.x, box.max.y - 1});
    }
    for (TileCounts* counts : {&covered, &right, &up}) counts->sum();
    for (int64_t y = 0; y < size.y; ++y)
      for (int64_t x = 0; x < size.x; ++x)
        if (covered.at(x, y) > 0 && number(x, y) < 0) fill({x, y}, right, up);
  }

  const std::vector<TileBox>& bounds() const { return bounds_; }
  size_t of(const TileBox& box) const {
    return static_cast<size_t>(numbers_[static_cast<size_t>(box.min.y * size_.x + box.min.x)]);
  }

 private:
  int64_t& number(int64_t x, int64_t y) { return numbers_[static_cast<size_t>(y * size_.x + x)]; }

  void fill(Tile first, TileCounts& right, TileCounts& up) {
    const auto component = static_cast<int64_t>(bounds_.size());
    TileBox box{first, first + Tile(1)};
    std::vector<Tile> open = {first};
    number(first.x, first.y) = component;
    const auto visit = [&](Tile tile, bool linked) {
      if (!linked || number(tile.x, tile.y) >= 0) return;
      number(tile.x, tile.y) = component;
      open.push_back(tile);
    };
    while (!open.empty()) {
      const Tile t = open.back();
      open.pop_back();
      box.min = {std::min(box.min.x, t.x), std::min(box.min.y, t.y)};
      box.max = {std::max(box.max.x, t.x + 1), std::max(box.max.y, t.y + 1)};
      if (t.x + 1 < size_.x) visit({t.x + 1, t.y}, right.at(t.x, t.y) > 0);
      if (t.y + 1 < size_.y) visit({t.x, t.y + 1}, up.at(t.x, t.y) > 0);
      if (t.x > 0) visit({t.x - 1, t.y}, right.at(t.x - 1, t.y) > 0);
      if (t.y > 0) visit({t.x, t.y - 1}, up.at(t.x, t.y - 1) > 0);
    }
    bounds_.push_back(box);
  }

  Tile size_;
  std::vector<int64_t> numbers_;
  std::vector<TileBox> bounds_;
};

// The triangles of one texture.
class TextureCharts {
 public:
  TextureCharts(uint32_t texture, const TextureShape& shape, std::span<const uint32_t> triangles,
                std::span<const ChartedTriangle> charted)
      : texture_(texture), shape_(shape), image_(shape.width, shape.height) {
    glm::dvec2 low(kLargest), high(-kLargest);
    for (const uint32_t triangle : triangles)
      for (const glm::dvec2& corner : charted[triangle].coordinates) {
        low = {std::min(low.x, corner.x), std::min(low.y, corner.y)};
        high = {std::max(high.x, corner.x), std::max(high.y, corner.y)};
      }
    for (int axis = 0; axis < 2; ++axis) chooseTiles(axis, low[axis] * image_[axis], high[axis] * image_[axis]);
    for (const uint32_t triangle : triangles) boxes_.push_back(boxOf(charted[triangle]));
  }

  // Appends the charts, and says of each triangle which it is.
  std::vector<uint32_t> append(std::vector<Chart>& charts) const {
    std::vector<size_t> component(boxes_.size());
    std::vector<TileBox> bounds = boxes_;
    for (size_t i = 0; i < component.size(); ++i) component[i] = i;
    for (int pass = 0; pass < kMaxPasses; ++pass) {
      const TileComponents components(size_, bounds);
      for (size_t& of : component) of = components.of(bounds[of]);
      const bool settled = pass > 0 && components.bounds().size() == bounds.size();
      bounds = components.bounds();
      if (settled) break;
    }
    const auto first = static_cast<uint32_t>(charts.size());
    for (const TileBox& box : bounds) charts.push_back(chartOf(box));
    std::vector<uint32_t> numbers;
    for (const size_t of : component) numbers.push_back(first + static_cast<uint32_t>(of));
    return numbers;
  }

 private:
  void chooseTiles(int axis, double low, double high) {
    tile_[axis] =
        static_cast<double>(std::bit_floor(static_cast<uint32_t>(std::min<double>(kTileTexels, image_[axis]))));
    const auto tiles = [&](double texel) { return static_cast<int64_t>(std::floor(texel / tile_[axis])); };
    while (tiles(high) - tiles(low) + 2 > kMaxTiles) tile_[axis] *= 2;
    first_[axis] = tiles(low);
    size_[axis] = tiles(high) - tiles(low) + 1;
  }

  TileBox boxOf(const ChartedTriangle& triangle) const {
    TileBox box;
    const auto& [a, b, c] = triangle.coordinates;
    for (int axis = 0; axis < 2; ++axis) {
      const double low = std::min({a[axis], b[axis], c[axis]}), high = std::max({a[axis], b[axis], c[axis]});
      const double scale = image_[axis] / tile_[axis];
      box.min[axis] =
          std::clamp(static_cast<int64_t>(std::floor(low * scale)) - first_[axis], int64_t{0}, size_[axis] - 1);
      box.max[axis] =
          std::clamp(static_cast<int64_t>(std::ceil(high * scale)) - first_[axis], box.min[axis] + 1, size_[axis]);
    }
    return box;
  }

  Chart chartOf(const TileBox& box) const {
    Chart chart{texture_, {}, {}, {}};
    glm::dvec2 low, high;
    for (int axis = 0; axis < 2; ++axis) {
      low[axis] = static_cast<double>(box.min[axis] + first_[axis]) * tile_[axis];
      high[axis] = static_cast<double>(box.max[axis] + first_[axis]) * tile_[axis];
    }
    const glm::dvec2 inside(std::min(high.x, image_.x), std::min(high.y, image_.y));
    const bool most = low.x >= 0 && low.y >= 0 && inside.x - low.x > 0 && inside.y - low.y > 0 &&
                      (inside.x - low.x) * (inside.y - low.y) > kMostOfImage * image_.x * image_.y;
    if (most) {
      low = {0, 0};
      high = {std::max(high.x, image_.x), std::max(high.y, image_.y)};
    }
    chart.min = low / image_;
    chart.texels = high - low;
    chart.size = chart.texels / image_;
    return chart;
  }

  uint32_t texture_;
  TextureShape shape_;
  glm::dvec2 image_;  // texels
  glm::dvec2 tile_{1};
  Tile first_{0}, size_{1};
  std::vector<TileBox> boxes_;
};

}  // namespace

Charts chartsOf(std::span<const TriangleTexture> textures, const TextureSampler& sampler) {
  Charts result;
  result.triangles.resize(textures.size());
  std::map<uint32_t, std::vector<uint32_t>> byTexture;
  for (uint32_t i = 0; i < textures.size(); ++i) {
    const uint32_t texture = textures[i].texture;
    const TextureShape shape = texture == kNoTexture ? TextureShape{} : sampler.shape(texture);
    const bool there = shape.width > 0;
    byTexture[there ? texture : kNoTexture].push_back(i);
    if (there)
      result.triangles[i].coordinates = towardsImage(textures[i], shape);
    else
      result.triangles[i].coordinates.fill(glm::dvec2(0.5));
  }
  for (const auto& [texture, triangles] : byTexture) {
    if (texture == kNoTexture) {
      for (const uint32_t i : triangles) result.triangles[i].chart = static_cast<uint32_t>(result.charts.size());
      result.charts.push_back({});
      continue;
    }
    const TextureCharts charts(texture, sampler.shape(texture), triangles, result.triangles);
    const std::vector<uint32_t> numbers = charts.append(result.charts);
    for (size_t i = 0; i < triangles.size(); ++i) result.triangles[triangles[i]].chart = numbers[i];
  }
  return result;
}

}  // namespace farcell
