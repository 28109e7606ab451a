#include "preprocess/texture/pyramid.h"

#include <algorithm>

namespace farcell {
namespace {

// Each pixel of the smaller row is the sum of what it covers of the larger one, in parts of the small row's width: a
// large pixel x spans [x small, (x+1) small), a small pixel i [i large, (i+1) large).
void sumAcross(std::span<const uint32_t> row, size_t smallWidth, std::vector<uint64_t>& sums) {
  sums.assign(4 * smallWidth, 0);
  for (size_t i = 0; i < smallWidth; ++i) {
    const size_t begin = i * row.size(), end = begin + row.size();
    for (size_t x = begin / smallWidth; x * smallWidth < end; ++x) {
      const uint64_t share = std::min(end, (x + 1) * smallWidth) - std::max(begin, x * smallWidth);
      const uint64_t weight = share * (row[x] >> 24);
      for (size_t channel = 0; channel < 3; ++channel) sums[4 * i + channel] += weight * (row[x] >> 8 * channel & 0xff);
      sums[4 * i + 3] += weight;
    }
  }
}

std::vector<uint32_t> whatIsLeft(std::span<const uint32_t> row, const SurfaceKind& mask) {
  std::vector<uint32_t> left(row.begin(), row.end());
  for (uint32_t& pixel : left) {
    const bool kept = passes(mask, static_cast<float>(pixel >> 24) / 255.0f);
    pixel = (pixel & 0xffffff) | (kept ? 0xff000000u : 0u);
  }
  return left;
}

PyramidLevel levelOf(int width, int height, uint64_t firstTile) {
  const auto tiles = [](int edge) { return static_cast<uint32_t>((edge + kTileEdge - 1) / kTileEdge); };
  return {width, height, tiles(width), tiles(height), firstTile};
}

std::vector<uint32_t> meanRow(const std::vector<uint64_t>& sums, uint64_t whole) {
  std::vector<uint32_t> row(sums.size() / 4);
  const auto mean = [](uint64_t sum, uint64_t weight) { return static_cast<uint32_t>((sum + weight / 2) / weight); };
  for (size_t i = 0; i < row.size(); ++i) {
    const uint64_t alpha = sums[4 * i + 3];
    row[i] = mean(alpha, whole) << 24;
    for (size_t channel = 0; channel < 3 && alpha > 0; ++channel)
      row[i] |= mean(sums[4 * i + channel], alpha) << 8 * channel;
  }
  return row;
}

}  // namespace

std::vector<PyramidLevel> pyramidLevels(int width, int height) {
  std::vector<PyramidLevel> levels = {levelOf(width, height, 0)};
  while (levels.back().width > 1 || levels.back().height > 1) {
    const PyramidLevel& last = levels.back();
    levels.push_back(levelOf(std::max(1, last.width / 2), std::max(1, last.height / 2), tileCount(levels)));
  }
  return levels;
}

uint64_t tileCount(std::span<const PyramidLevel> levels) {
  const PyramidLevel& last = levels.back();
  return last.firstTile + uint64_t{last.tilesAcross} * last.tilesDown;
}

PyramidBuilder::PyramidBuilder(std::span<const PyramidLevel> levels, const SurfaceKind& surface, const Sink& sink)
    : levels_(levels), surface_(surface), sink_(sink), rows_(levels.size()) {
  for (size_t i = 0; i < levels.size(); ++i) {
    rows_[i].tiles.resize(levels[i].tilesAcross * kTilePixels);
    if (i + 1 < levels.size()) rows_[i].sums.resize(4 * static_cast<size_t>(levels[i + 1].width));
  }
}

Result<> PyramidBuilder::addRow(size_t level, std::span<const uint32_t> row) {
  const PyramidLevel& size = levels_[level];
  LevelRows& own = rows_[level];
  const auto inTile = static_cast<size_t>(own.rows % kTileEdge);
  for (size_t x = 0; x < row.size(); x += kTileEdge)
    std::copy_n(row.begin() + static_cast<ptrdiff_t>(x), std::min<size_t>(kTileEdge, row.size() - x),
                own.tiles.begin() + static_cast<ptrdiff_t>(x / kTileEdge * kTilePixels + inTile * kTileEdge));
  if (level + 1 < levels_.size()) {
    const bool mask = level == 0 && surface_.alpha == AlphaMode::mask;
    FARCELL_TRY(mask ? halve(level, whatIsLeft(row, surface_)) : halve(level, row));
  }
  ++own.rows;
  if (own.rows % kTileEdge != 0 && own.rows != size.height) return {};
  const auto tileRow = static_cast<uint64_t>((own.rows - 1) / kTileEdge);
  FARCELL_TRY(sink_(size.firstTile + tileRow * size.tilesAcross, own.tiles));
  std::fill(own.tiles.begin(), own.tiles.end(), 0);
  return {};
}

// Down the image as sumAcross does along a row. A row covers parts of two rows of the next level at most.
Result<> PyramidBuilder::halve(size_t level, std::span<const uint32_t> row) {
  const auto large = static_cast<uint64_t>(levels_[level].height),
             small = static_cast<uint64_t>(levels_[level + 1].height);
  const uint64_t whole = large * row.size();
  LevelRows& own = rows_[level];
  Sums across;
  sumAcross(row, static_cast<size_t>(levels_[level + 1].width), across);
  const auto add = [&](uint64_t share) {
    for (size_t i = 0; i < across.size(); ++i) own.sums[i] += share * across[i];
  };
  const uint64_t begin = static_cast<uint64_t>(own.rows) * small, end = begin + small;
  const uint64_t border = (begin / large + 1) * large;  // where the next level's row ends
  add(std::min(end, border) - begin);
  if (end < border) return {};
  FARCELL_TRY(addRow(level + 1, meanRow(own.sums, whole)));
  std::fill(own.sums.begin(), own.sums.end(), 0);
  add(end - border);
  return {};
}

}  // namespace farcell
