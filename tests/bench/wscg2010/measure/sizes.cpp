#include "tests/bench/wscg2010/measure/sizes.h"

#include <array>
#include <chrono>
#include <functional>

#include "cache/base/interrupt.h"
#include "cache/base/parallel.h"
#include "cache/schema/viewpoints.h"
#include "tests/bench/wscg2010/measure/coders.h"

namespace farcell::wscg {
namespace {

constexpr int kZlibLevel = 6;
constexpr int kWebpMethod = 4;
constexpr uint32_t kXzPreset = 6;

Result<size_t> sizeOf(Result<std::vector<std::byte>> coded) {
  if (!coded) return tl::unexpected<Error>(std::move(coded).error());
  return coded->size();
}

// One cell's figures.
struct CellSizes {
  std::array<size_t, kCodingCount> bytes{};
  std::array<double, kCodingCount> seconds{};
  size_t images = 0, emptyImages = 0;

  Result<> count(Coding coding, const std::function<Result<size_t>()>& code) {
    const auto start = std::chrono::steady_clock::now();
    FARCELL_ASSIGN(const size_t size, code());
    const auto i = static_cast<size_t>(coding);
    bytes[i] += size;
    seconds[i] += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return {};
  }
};

Result<CellSizes> codeCell(const std::vector<CellImage>& images, int imageSize) {
  CellSizes sizes;
  std::vector<uint8_t> all;
  for (const CellImage& image : images) {
    ++sizes.images;
    sizes.bytes[static_cast<size_t>(Coding::raw)] += size_t{4} * static_cast<size_t>(imageSize * imageSize);
    if (image.width == 0) {
      ++sizes.emptyImages;
      continue;
    }
    sizes.bytes[static_cast<size_t>(Coding::cropped)] += image.rgba.size();
    all.insert(all.end(), image.rgba.begin(), image.rgba.end());
    FARCELL_TRY(sizes.count(Coding::zlibImages, [&] { return sizeOf(zlibCoded(image.rgba, kZlibLevel)); }));
    FARCELL_TRY(sizes.count(Coding::planes, [&]() -> Result<size_t> { return planesCoded(image).size(); }));
    FARCELL_TRY(sizes.count(Coding::webp, [&] { return sizeOf(webpCoded(image, kWebpMethod)); }));
  }
  FARCELL_TRY(sizes.count(Coding::zlibCell, [&] { return sizeOf(zlibCoded(all, kZlibLevel)); }));
  FARCELL_TRY(sizes.count(Coding::xzCell, [&] { return sizeOf(xzCoded(all, kXzPreset)); }));
  return sizes;
}

Result<CellSizes> measureCell(const CellIndex& index, size_t cell, const Variant& variant,
                              const Viewpoints& viewpoints) {
  FARCELL_TRY(checkInterrupt());
  ImageBaker baker(variant.impostors.image, index.scene().sun);
  const CellContent content = index.content(index.occupied()[cell], variant.impostors.content);
  std::vector<CellImage> images;
  for (const glm::dvec3& direction : viewpoints.directions()) images.push_back(baker.bake(content, direction));
  return codeCell(images, variant.impostors.image.size);
}

}  // namespace

const char* codingName(Coding coding) {
  constexpr std::array<const char*, kCodingCount> kNames = {
      "raw RGBA, 128^2",          "cropped",       "zlib 6, per image", "zlib 6, per cell", "pack's planes, per image",
      "WebP lossless, per image", "xz 6, per cell"};
  return kNames[static_cast<size_t>(coding)];
}

double SizeResult::share(Coding coding) const {
  return bytes(Coding::cropped) > 0 ? bytes(coding) / bytes(Coding::cropped) : 0;
}

Result<SizeResult> measureSizes(const CellIndex& index, const Variant& variant, const SizeSettings& settings) {
  FARCELL_ASSIGN(const Viewpoints viewpoints, Viewpoints::create(variant.impostors.views));
  SizeResult result;
  result.scene = index.scene().name;
  result.variant = variant.name;
  result.occupiedCells = index.occupied().size();
  result.sampledCells = std::min(result.occupiedCells, static_cast<size_t>(settings.cells));
  std::vector<Result<CellSizes>> cells(result.sampledCells, CellSizes{});
  parallelFor(cells.size(), threadCount(0), [&](size_t i, int) {
    cells[i] = measureCell(index, (2 * i + 1) * result.occupiedCells / (2 * cells.size()), variant, viewpoints);
  });
  for (auto& cell : cells) {
    if (!cell) return tl::unexpected<Error>(std::move(cell).error());
    result.images += cell->images;
    result.emptyImages += cell->emptyImages;
    for (size_t i = 0; i < kCodingCount; ++i) {
      result.bytesPerCell[i] += static_cast<double>(cell->bytes[i]) / static_cast<double>(cells.size());
      result.secondsPerCell[i] += cell->seconds[i] / static_cast<double>(cells.size());
    }
  }
  return result;
}

}  // namespace farcell::wscg
