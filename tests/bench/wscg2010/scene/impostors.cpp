#include "tests/bench/wscg2010/scene/impostors.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>

#include "cache/base/check.h"
#include "cache/base/parallel.h"

namespace farcell::wscg {

ImpostorSet::ImpostorSet(const CellIndex& index, const ImpostorSettings& settings, Viewpoints viewpoints)
    : index_(&index), settings_(settings), viewpoints_(std::move(viewpoints)), images_(index.occupied().size()) {}

Result<ImpostorSet> ImpostorSet::bake(const CellIndex& index, const ImpostorSettings& settings,
                                      std::span<const glm::dvec3> eyes, int threads) {
  FARCELL_ASSIGN(Viewpoints viewpoints, Viewpoints::create(settings.views));
  ImpostorSet set(index, settings, std::move(viewpoints));
  const int workers = threadCount(threads);
  std::vector<std::optional<ImageBaker>> bakers(static_cast<size_t>(workers));
  parallelFor(set.images_.size(), workers, [&](size_t cell, int worker) {
    const CellKey& key = index.occupied()[cell];
    std::map<int, CellImage>& images = set.images_[cell];
    for (const glm::dvec3& eye : eyes) images.try_emplace(set.viewpoints_.nearest(eye - cellCentre(key)));
    auto& baker = bakers[static_cast<size_t>(worker)];
    if (!baker) baker.emplace(settings.image, index.scene().sun);
    const CellContent content = index.content(key, settings.content);
    for (auto& [view, image] : images)
      image = baker->bake(content, set.viewpoints_.directions()[static_cast<size_t>(view)]);
  });
  return set;
}

Billboard ImpostorSet::billboard(uint32_t cell, int view, const CellImage& image) const {
  const ViewFrame frame = viewFrame(viewpoints_.directions()[static_cast<size_t>(view)]);
  const double half = imageRadius(index_->depth(), settings_.content) * imageHalfWidth(settings_.image.fovRad);
  const double texel = 2 * half / settings_.image.size;
  Billboard result;
  result.centre = cellCentre(index_->occupied()[cell]);
  result.origin = result.centre + frame.right * (image.x0 * texel - half) + frame.up * (image.y0 * texel - half);
  result.alongX = frame.right * (image.width * texel);
  result.alongY = frame.up * (image.height * texel);
  result.image = &image;
  result.cell = cell;
  result.view = view;
  return result;
}

std::vector<Billboard> ImpostorSet::seenFrom(glm::dvec3 eye) const {
  std::vector<Billboard> billboards;
  for (uint32_t cell = 0; cell < images_.size(); ++cell) {
    const int view = viewpoints_.nearest(eye - cellCentre(index_->occupied()[cell]));
    const auto found = images_[cell].find(view);
    FARCELL_CHECK(found != images_[cell].end());
    if (found->second.width > 0) billboards.push_back(billboard(cell, view, found->second));
  }
  const auto distance = [&](const Billboard& b) { return glm::length(b.centre - eye); };
  std::stable_sort(billboards.begin(), billboards.end(),
                   [&](const Billboard& a, const Billboard& b) { return distance(a) > distance(b); });
  return billboards;
}

}  // namespace farcell::wscg
