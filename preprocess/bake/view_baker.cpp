#include "preprocess/bake/view_baker.h"

#include <optional>

#include "cache/base/check.h"
#include "preprocess/bake/rasterise.h"
#include "preprocess/bake/resolve.h"
#include "preprocess/bake/settle.h"

namespace farcell {

void CellSoup::clear() {
  for (size_t k = 0; k < 3; ++k) {
    x[k].clear();
    y[k].clear();
    z[k].clear();
    colours[k].clear();
    normals[k].clear();
    u[k].clear();
    v[k].clear();
  }
  textures.clear();
}

struct ViewBaker::Impl {
  Impl(const BakeSettings& wanted, TextureSampler* sampler)
      : settings(wanted), textures(sampler), image(wanted.imageSize, wanted.samples, wanted.relightable) {}

  std::optional<glm::vec3> sun() const { return settings.relightable ? std::nullopt : std::optional(settings.sun); }

  BakeSettings settings;
  TextureSampler* textures;
  bake::SampleImage image;
  bake::Projection projection{};
  bake::RasterScratch raster;
  bake::SettleScratch settling;
  bool begun = false;
};

ViewBaker::ViewBaker(const BakeSettings& settings, TextureSampler* textures)
    : impl_(std::make_unique<Impl>(settings, textures)) {}
ViewBaker::~ViewBaker() = default;
ViewBaker::ViewBaker(ViewBaker&&) noexcept = default;

void ViewBaker::begin(const ViewFrame& frame) {
  impl_->image.clear();
  impl_->projection = bake::projectionOf(frame, impl_->image);
  impl_->begun = true;
}

void ViewBaker::add(const CellSoup& chunk) {
  FARCELL_CHECK(impl_->begun);
  for (size_t k = 0; k < 3; ++k) {
    FARCELL_CHECK_EQ(chunk.x[k].size(), chunk.size());
    FARCELL_CHECK_EQ(chunk.y[k].size(), chunk.size());
    FARCELL_CHECK_EQ(chunk.z[k].size(), chunk.size());
    FARCELL_CHECK_EQ(chunk.colours[k].size(), chunk.size());
    FARCELL_CHECK(chunk.normals[k].size() == (chunk.normals[0].empty() ? 0 : chunk.size()));
    FARCELL_CHECK_EQ(chunk.u[k].size(), chunk.textures.size());
    FARCELL_CHECK_EQ(chunk.v[k].size(), chunk.textures.size());
  }
  FARCELL_CHECK(chunk.textures.empty() || (impl_->textures != nullptr && chunk.textures.size() == chunk.size()));
  const bool flat = chunk.normals[0].empty();
  impl_->raster.planes = flat && !impl_->settings.relightable;
  const bake::TexelRect touched =
      bake::rasterise(chunk, impl_->projection, impl_->textures, impl_->image, impl_->raster);
  impl_->image.touched.include(touched);
  const bake::Winners winners{
      chunk, impl_->projection, impl_->sun(), impl_->raster.largeTriangles, impl_->raster.largeSlots, impl_->textures};
  bake::settle(winners, touched, impl_->image, impl_->settling);
}

void ViewBaker::finish(BakedView& view, BakedView& antipode) {
  FARCELL_CHECK(impl_->begun);
  bake::resolve(impl_->image, view, antipode);
  impl_->begun = false;
}

}  // namespace farcell
