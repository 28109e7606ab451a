#include "preprocess/build/cell_bake.h"

#include <chrono>
#include <memory>

#include "cache/base/interrupt.h"
#include "preprocess/encode/geometry_page.h"
#include "preprocess/encode/vertex_colours.h"
#include "preprocess/encode/view_image.h"

namespace farcell {
namespace {

class Stopwatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

Result<> checkSampler(const TextureSampler* textures) {
  if (textures != nullptr && textures->failure()) return tl::unexpected<Error>(*textures->failure());
  return {};
}

// The views that are baked together with their antipodes.
std::vector<int> pairLeaders(const Viewpoints& viewpoints) {
  std::vector<int> leaders;
  for (int view = 0; view < viewpoints.count(); ++view)
    if (view < viewpoints.antipode(view)) leaders.push_back(view);
  return leaders;
}

using BakedViews = std::vector<ViewImage>;  // by view index

void finishPair(ViewBaker& baker, int view, const Viewpoints& viewpoints, int imageSize, BakedViews& images) {
  BakedView front, back;
  baker.finish(front, back);
  const int antipode = viewpoints.antipode(view);
  images[view] = quantisedView(front, static_cast<uint32_t>(view), imageSize);
  images[antipode] = quantisedView(back, static_cast<uint32_t>(antipode), imageSize);
}

ViewFrame frameOf(const Viewpoints& viewpoints, int view) { return viewFrame(viewpoints.directions()[view]); }

Result<BakedViews> bakeGathered(uint32_t cell, const SoupSource& source, const std::vector<uint32_t>& leaves,
                                const BakeSettings& settings, const Viewpoints& viewpoints, TextureSampler* textures) {
  CellSoup soup;
  for (const uint32_t leaf : leaves) FARCELL_TRY(source.append(cell, leaf, soup));
  BakedViews images(static_cast<size_t>(viewpoints.count()));
  ViewBaker baker(settings, textures);
  for (const int view : pairLeaders(viewpoints)) {
    FARCELL_TRY(checkInterrupt());
    baker.begin(frameOf(viewpoints, view));
    baker.add(soup);
    finishPair(baker, view, viewpoints, settings.imageSize, images);
  }
  return images;
}

Result<BakedViews> bakeStreamed(uint32_t cell, const SoupSource& source, const std::vector<uint32_t>& leaves,
                                const BakeSettings& settings, const Viewpoints& viewpoints, TextureSampler* textures) {
  const std::vector<int> leaders = pairLeaders(viewpoints);
  std::vector<ViewBaker> bakers;
  for (const int view : leaders) bakers.emplace_back(settings, textures).begin(frameOf(viewpoints, view));
  CellSoup soup;
  for (const uint32_t leaf : leaves) {
    FARCELL_TRY(checkInterrupt());
    soup.clear();
    FARCELL_TRY(source.append(cell, leaf, soup));
    for (ViewBaker& baker : bakers) baker.add(soup);
  }
  BakedViews images(static_cast<size_t>(viewpoints.count()));
  for (size_t pair = 0; pair < leaders.size(); ++pair)
    finishPair(bakers[pair], leaders[pair], viewpoints, settings.imageSize, images);
  return images;
}

Result<BakedViews> bakeViews(uint32_t cell, const Model& model, const CellTree& tree, const Partition& partition,
                             const Viewpoints& viewpoints, TextureSampler* textures, uint64_t gatherTriangles) {
  const BakeSettings settings{model.settings.imageSize, model.settings.samples, sunDirection(model.settings.up),
                              model.settings.bakeNormals};
  const SoupSource source(model, tree, partition);
  const std::vector<uint32_t> leaves = source.leavesInside(cell);
  const bool gather = tree.cells[cell].triangles <= gatherTriangles;
  return (gather ? bakeGathered : bakeStreamed)(cell, source, leaves, settings, viewpoints, textures);
}

void encodeViews(BakedViews images, const Viewpoints& viewpoints, CellPages& result) {
  std::vector<ViewPage> groups(static_cast<size_t>(viewpoints.groupCount()));
  for (ViewImage& image : images) {
    ++result.viewsBaked;
    if (image.width == 0) {
      ++result.viewsEmpty;
      continue;
    }
    ++result.viewsKept;
    result.impostorRawBytes += image.rgba.size() + image.depth.size() + image.normal.size();
    groups[static_cast<size_t>(viewpoints.group(static_cast<int>(image.view)))].views.push_back(std::move(image));
  }
  for (size_t group = 0; group < groups.size(); ++group) {
    if (groups[group].views.empty()) continue;
    result.pages.push_back({PageKind::views, static_cast<uint32_t>(group), decodedSizeBytes(groups[group]),
                            encodeViewPage(groups[group])});
  }
}

Result<> encodeGeometry(uint32_t cell, const Model& model, const CellTree& tree, const Partition& partition,
                        TextureSampler* textures, CellPages& result) {
  FARCELL_ASSIGN(GridTriangles list, partition.triangles.read(partition.leaves[tree.leafOf[cell]].list));
  const std::vector<GridTriangle> triangles = withTexturesAsColours(std::move(list), textures);
  FARCELL_TRY(checkSampler(textures));
  const GridPoint cellMin = cellBox(model.grid, tree.cells[cell].key).min;
  const GeometryPage page = optimisedOrder(geometryPage(triangles, cellMin, model));
  result.pages.push_back({PageKind::geometry, 0, decodedSizeBytes(page), encodeGeometryPage(page)});
  return {};
}

}  // namespace

Result<CellPages> bakeCell(uint32_t cell, const Model& model, const CellTree& tree, const Partition& partition,
                           const Viewpoints& viewpoints, TextureSampler* textures, uint64_t gatherTriangles) {
  CellPages result;
  Stopwatch watch;
  const bool leaf = tree.cells[cell].childCount == 0;
  if (leaf) FARCELL_TRY(encodeGeometry(cell, model, tree, partition, textures, result));
  result.encodeSeconds += watch.lap();
  if (leaf && tree.cells[cell].triangles < kTrianglesCheaperThanView) {
    result.viewsCheaperAsTriangles = static_cast<uint64_t>(viewpoints.count());
    return result;
  }
  FARCELL_ASSIGN(BakedViews images, bakeViews(cell, model, tree, partition, viewpoints, textures, gatherTriangles));
  FARCELL_TRY(checkSampler(textures));
  result.bakeSeconds += watch.lap();
  encodeViews(std::move(images), viewpoints, result);
  result.encodeSeconds += watch.lap();
  return result;
}

}  // namespace farcell
