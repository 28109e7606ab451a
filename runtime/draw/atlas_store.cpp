#include "runtime/draw/atlas_store.h"

#include <algorithm>

#include "cache/base/check.h"

namespace farcell {
namespace {

constexpr uint64_t kTexelBytes = 4;  // drivers keep three channels as four

GLenum formatOf(const TexturePage& shape) { return shape.channels == 4 ? GL_RGBA : GL_RGB; }

uint64_t bytesFrom(const TexturePage& shape, uint32_t firstLevel) {
  uint64_t bytes = 0;
  for (uint32_t level = firstLevel; level < shape.levelCount; ++level)
    bytes += kTexelBytes * (shape.width >> level) * (shape.height >> level);
  return bytes;
}

void upload(const GlTexture& texture, const TexturePage& page, uint32_t firstLevel) {
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  for (uint32_t i = 0; i < page.levels.size(); ++i) {
    const uint32_t level = page.firstLevel + i;
    glTextureSubImage2D(texture.name(), static_cast<GLint>(level - firstLevel), 0, 0,
                        static_cast<GLsizei>(page.width >> level), static_cast<GLsizei>(page.height >> level),
                        formatOf(page), GL_UNSIGNED_BYTE, page.levels[i].data());
  }
}

}  // namespace

const AtlasStore::Resident* AtlasStore::keep(uint32_t number) {
  const auto found = entries_.find(number);
  if (found == entries_.end()) return nullptr;
  found->second.portion = portion_;
  return &found->second.resident;
}

const AtlasStore::Resident* AtlasStore::add(uint32_t number, const TexturePage& coarse) {
  FARCELL_CHECK(entries_.count(number) == 0 && coarse.firstLevel + coarse.levels.size() == coarse.levelCount);
  const uint64_t bytes = bytesFrom(coarse, coarse.firstLevel);
  makeRoom(bytes);
  if (usedBytes_ + bytes > budgetBytes_ && !entries_.empty()) return nullptr;
  Entry& entry = entries_[number];
  entry.texture = create(coarse, coarse.firstLevel);
  upload(entry.texture, coarse, coarse.firstLevel);
  entry.bytes = bytes;
  entry.portion = portion_;
  usedBytes_ += bytes;
  entry.resident = {entry.texture.name(), coarse, coarse.firstLevel};
  entry.resident.shape.levels.clear();
  return &entry.resident;
}

uint32_t AtlasStore::finestLevel(uint32_t number, uint32_t wanted) const {
  const Entry& entry = entries_.at(number);
  uint64_t others = 0;
  for (const auto& [key, other] : entries_)
    if (key != number && other.portion == portion_) others += other.bytes;
  // While it is copied, it is there twice.
  const auto fits = [&](uint32_t level) {
    return others + entry.bytes + bytesFrom(entry.resident.shape, level) <= budgetBytes_;
  };
  uint32_t level = std::min(wanted, entry.resident.firstLevel);
  while (level < entry.resident.firstLevel && !fits(level)) ++level;
  return level;
}

const AtlasStore::Resident* AtlasStore::refine(uint32_t number, std::span<const TexturePage> finer) {
  Entry& entry = entries_.at(number);
  entry.portion = portion_;
  TexturePage& shape = entry.resident.shape;
  const uint32_t before = entry.resident.firstLevel, first = finer.back().firstLevel;
  const uint64_t bytes = bytesFrom(shape, first);
  makeRoom(bytes);
  GlTexture texture = create(shape, first);
  for (const TexturePage& page : finer) upload(texture, page, first);
  for (uint32_t level = before; level < shape.levelCount; ++level)
    glCopyImageSubData(entry.texture.name(), GL_TEXTURE_2D, static_cast<GLint>(level - before), 0, 0, 0, texture.name(),
                       GL_TEXTURE_2D, static_cast<GLint>(level - first), 0, 0, 0,
                       static_cast<GLsizei>(shape.width >> level), static_cast<GLsizei>(shape.height >> level), 1);
  usedBytes_ += bytes - entry.bytes;
  entry.bytes = bytes;
  entry.texture = std::move(texture);
  entry.resident.texture = entry.texture.name();
  entry.resident.firstLevel = first;
  return &entry.resident;
}

GlTexture AtlasStore::create(const TexturePage& shape, uint32_t firstLevel) const {
  GlTexture texture = createTexture(GL_TEXTURE_2D);
  const GLuint name = texture.name();
  glTextureStorage2D(name, static_cast<GLsizei>(shape.levelCount - firstLevel),
                     shape.channels == 4 ? GL_RGBA8 : GL_RGB8, static_cast<GLsizei>(shape.width >> firstLevel),
                     static_cast<GLsizei>(shape.height >> firstLevel));
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  texture.label("atlas");
  return texture;
}

// Of what this portion does not use, until there is, or nothing is left.
void AtlasStore::makeRoom(uint64_t bytes) {
  while (usedBytes_ + bytes > budgetBytes_) {
    const auto oldest = std::min_element(entries_.begin(), entries_.end(), [](const auto& l, const auto& r) {
      return l.second.portion < r.second.portion;
    });
    if (oldest == entries_.end() || oldest->second.portion == portion_) return;
    usedBytes_ -= oldest->second.bytes;
    entries_.erase(oldest);
  }
}

}  // namespace farcell
