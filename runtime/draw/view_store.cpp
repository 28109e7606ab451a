#include "runtime/draw/view_store.h"

#include <algorithm>

#include "cache/pack/view_mips.h"

namespace farcell {
namespace {

constexpr int kFirstLayers = 64;

uint64_t layerBytes(int imageSize, bool withNormals) {
  uint64_t texels = 0;
  for (uint64_t edge = static_cast<uint64_t>(imageSize); edge > 0; edge /= 2) texels += edge * edge;
  return texels * (withNormals ? 8 : 4) + static_cast<uint64_t>(imageSize) * static_cast<uint64_t>(imageSize);
}

int layerLimit(uint64_t bytesPerLayer, uint64_t budgetBytes) {
  GLint limit = 0;
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &limit);
  return static_cast<int>(std::clamp<uint64_t>(budgetBytes / bytesPerLayer, 3, static_cast<uint64_t>(limit)));
}

GlTexture createArray(GLenum format, int imageSize, int levels, int layers, GLenum minFilter, GLenum magFilter) {
  GlTexture texture = createTexture(GL_TEXTURE_2D_ARRAY);
  glTextureStorage3D(texture.name(), levels, format, imageSize, imageSize, layers);
  glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, static_cast<GLint>(minFilter));
  glTextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, static_cast<GLint>(magFilter));
  // The border colour is transparent black unless set.
  glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
  glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
  return texture;
}

void copyLayers(const GlTexture& from, const GlTexture& to, int imageSize, int levels, int layers) {
  for (int level = 0; level < levels; ++level)
    glCopyImageSubData(from.name(), GL_TEXTURE_2D_ARRAY, level, 0, 0, 0, to.name(), GL_TEXTURE_2D_ARRAY, level, 0, 0, 0,
                       imageSize >> level, imageSize >> level, layers);
}

template <class Mips>
void uploadMips(const GlTexture& texture, int layer, int imageSize, GLenum type, const Mips& mips) {
  for (int level = 0; level < static_cast<int>(mips.size()); ++level)
    glTextureSubImage3D(texture.name(), level, 0, 0, layer, imageSize >> level, imageSize >> level, 1, GL_RGBA, type,
                        mips[static_cast<size_t>(level)].data());
}

}  // namespace

ViewStore::ViewStore(int imageSize, uint64_t budgetBytes, bool withNormals)
    : imageSize_(imageSize),
      withNormals_(withNormals),
      maxLayers_(layerLimit(layerBytes(imageSize, withNormals), budgetBytes)) {}

uint64_t ViewStore::usedBytes() const { return static_cast<uint64_t>(layers_) * layerBytes(imageSize_, withNormals_); }

const ResidentView* ViewStore::keep(uint32_t cell, uint32_t view) {
  const auto found = entries_.find({cell, view});
  if (found == entries_.end()) return nullptr;
  found->second.portion = portion_;
  return &found->second.view;
}

const ResidentView* ViewStore::add(uint32_t cell, uint32_t view, const ViewImage& image) {
  ResidentView resident = residentView(image, -1);
  if (image.width > 0) {
    resident.layer = takeLayer();
    if (resident.layer < 0) return nullptr;
    upload(resident.layer, image);
  }
  return &entries_.insert_or_assign({cell, view}, Entry{resident, portion_}).first->second.view;
}

void ViewStore::beginPortion() {
  ++portion_;
  if (!wantsAllLayers_) return;
  wantsAllLayers_ = false;
  entries_.clear();
  freeLayers_.clear();
  colours_.reset();
  depths_.reset();
  normals_.reset();
  layers_ = 0;
  grow(maxLayers_);
}

int ViewStore::takeLayer() {
  if (freeLayers_.empty() && layers_ < maxLayers_) {
    // Old and new layers exist side by side while they are copied, and the budget holds then too.
    const int wanted = std::min(maxLayers_, std::max(kFirstLayers, 2 * layers_));
    if (layers_ + wanted <= maxLayers_ || layers_ == 0) {
      grow(wanted);
    } else {
      wantsAllLayers_ = true;
    }
  }
  if (freeLayers_.empty() && !evictOldest()) return -1;
  const int layer = freeLayers_.back();
  freeLayers_.pop_back();
  return layer;
}

void ViewStore::grow(int layers) {
  const int levels = mipLevelCount(imageSize_);
  GlTexture colours = createArray(GL_RGBA8, imageSize_, levels, layers, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR);
  GlTexture depths = createArray(GL_R8, imageSize_, 1, layers, GL_NEAREST, GL_NEAREST);
  colours.label("view colours");
  depths.label("view depths");
  if (layers_ > 0) {
    copyLayers(colours_, colours, imageSize_, levels, layers_);
    copyLayers(depths_, depths, imageSize_, 1, layers_);
  }
  if (withNormals_) {
    GlTexture normals = createArray(GL_RGBA8_SNORM, imageSize_, levels, layers, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR);
    normals.label("view normals");
    if (layers_ > 0) copyLayers(normals_, normals, imageSize_, levels, layers_);
    normals_ = std::move(normals);
  }
  colours_ = std::move(colours);
  depths_ = std::move(depths);
  for (int layer = layers - 1; layer >= layers_; --layer) freeLayers_.push_back(layer);
  layers_ = layers;
}

bool ViewStore::evictOldest() {
  auto oldest = entries_.end();
  for (auto entry = entries_.begin(); entry != entries_.end(); ++entry)
    if (entry->second.view.layer >= 0 && (oldest == entries_.end() || entry->second.portion < oldest->second.portion))
      oldest = entry;
  if (oldest == entries_.end() || oldest->second.portion == portion_) return false;
  freeLayers_.push_back(oldest->second.view.layer);
  entries_.erase(oldest);
  return true;
}

void ViewStore::upload(int layer, const ViewImage& image) const {
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  uploadMips(colours_, layer, imageSize_, GL_UNSIGNED_BYTE, buildColourMips(image, imageSize_));
  const auto depth = buildDepthImage(image, imageSize_);
  glTextureSubImage3D(depths_.name(), 0, 0, 0, layer, imageSize_, imageSize_, 1, GL_RED, GL_UNSIGNED_BYTE,
                      depth.data());
  if (withNormals_) uploadMips(normals_, layer, imageSize_, GL_BYTE, buildNormalMips(image, imageSize_));
}

void ViewStore::bind() const {
  glBindTextureUnit(0, colours_.name());
  glBindTextureUnit(1, depths_.name());
  if (withNormals_) glBindTextureUnit(2, normals_.name());
}

}  // namespace farcell
