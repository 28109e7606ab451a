#include "runtime/draw/geometry_store.h"

#include <algorithm>
#include <cstddef>
#include <map>

#include "cache/base/check.h"

namespace farcell {
namespace {

// A chunk's shares: flat-shaded meshes have about as many vertices as triangles.
constexpr uint64_t kChunkVertices = 400'000;
constexpr uint64_t kChunkIndices = 1'200'000;
uint64_t chunkBytes(uint64_t vertexBytes) { return kChunkVertices * vertexBytes + kChunkIndices * sizeof(uint32_t); }

// Layout fixed by OpenGL (glMultiDrawElementsIndirect).
struct DrawCommand {
  uint32_t indexCount;
  uint32_t instanceCount;
  uint32_t firstIndex;
  int32_t baseVertex;
  uint32_t baseInstance;  // which of the tints
};

constexpr GLuint kTintAttribute = 3;
constexpr GLuint kTintBinding = 1;
constexpr GLuint kCoordinatesAttribute = 4;
constexpr GLuint kCoordinatesBinding = 2;
constexpr GLuint kAtlasUnit = 3;

GlVertexArray createLayout() {
  GlVertexArray layout = createVertexArray();
  const GLuint name = layout.name();
  for (GLuint attribute = 0; attribute < 3; ++attribute) {
    glEnableVertexArrayAttrib(name, attribute);
    glVertexArrayAttribBinding(name, attribute, 0);
  }
  glVertexArrayAttribIFormat(name, 0, 3, GL_INT, offsetof(GpuVertex, position));
  glVertexArrayAttribFormat(name, 1, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(GpuVertex, colour));
  glVertexArrayAttribFormat(name, 2, 2, GL_SHORT, GL_TRUE, offsetof(GpuVertex, normal));
  glVertexArrayAttribFormat(name, kTintAttribute, 4, GL_UNSIGNED_BYTE, GL_TRUE, 0);
  glVertexArrayAttribBinding(name, kTintAttribute, kTintBinding);
  glVertexArrayBindingDivisor(name, kTintBinding, 1);
  glVertexArrayAttribFormat(name, kCoordinatesAttribute, 2, GL_UNSIGNED_SHORT, GL_TRUE, 0);
  glVertexArrayAttribBinding(name, kCoordinatesAttribute, kCoordinatesBinding);
  return layout;
}

}  // namespace

GeometryStore::GeometryStore(uint64_t budgetBytes, bool textured)
    : budgetBytes_(budgetBytes),
      textured_(textured),
      vertexBytes_(sizeof(GpuVertex) + (textured ? sizeof(uint32_t) : 0)) {}

bool GeometryStore::keep(uint32_t page) {
  const auto found = residents_.find(page);
  if (found == residents_.end()) return false;
  found->second.portion = portion_;
  return true;
}

bool GeometryStore::add(uint32_t page, const GpuMesh& mesh) {
  FARCELL_CHECK(!mesh.indices.empty() && residents_.count(page) == 0);
  FARCELL_CHECK(textured_ || mesh.coordinates.empty());
  const uint64_t needBytes = mesh.vertices.size() * vertexBytes_ + mesh.indices.size() * sizeof(uint32_t);
  while (!place(page, mesh)) {
    if (usedBytes_ + std::max(needBytes, std::min(chunkBytes(vertexBytes_), budgetBytes_)) <= budgetBytes_) {
      addChunk(mesh);
    } else if (!evictOldest()) {
      if (!residents_.empty()) return false;
      addChunk(mesh);
    }
  }
  return true;
}

bool GeometryStore::place(uint32_t page, const GpuMesh& mesh) {
  const auto vertexCount = static_cast<uint32_t>(mesh.vertices.size());
  const auto indexCount = static_cast<uint32_t>(mesh.indices.size());
  for (auto chunk = chunks_.begin(); chunk != chunks_.end(); ++chunk) {
    const auto firstVertex = chunk->vertexRanges.allocate(vertexCount);
    if (!firstVertex) continue;
    const auto firstIndex = chunk->indexRanges.allocate(indexCount);
    if (!firstIndex) {
      chunk->vertexRanges.release(*firstVertex, vertexCount);
      continue;
    }
    glNamedBufferSubData(chunk->vertices.name(), static_cast<GLintptr>(*firstVertex * sizeof(GpuVertex)),
                         static_cast<GLsizeiptr>(vertexCount * sizeof(GpuVertex)), mesh.vertices.data());
    glNamedBufferSubData(chunk->indices.name(), static_cast<GLintptr>(*firstIndex * sizeof(uint32_t)),
                         static_cast<GLsizeiptr>(indexCount * sizeof(uint32_t)), mesh.indices.data());
    if (!mesh.coordinates.empty())
      glNamedBufferSubData(chunk->coordinates.name(), static_cast<GLintptr>(*firstVertex * sizeof(uint32_t)),
                           static_cast<GLsizeiptr>(vertexCount * sizeof(uint32_t)), mesh.coordinates.data());
    residents_[page] = {chunk, *firstVertex, vertexCount, *firstIndex, indexCount, portion_};
    return true;
  }
  return false;
}

void GeometryStore::addChunk(const GpuMesh& mesh) {
  // A small budget gets smaller chunks; a mesh larger than a chunk one of its own.
  const uint64_t most = chunkBytes(vertexBytes_), bytes = std::min(most, budgetBytes_);
  const auto vertices = static_cast<uint32_t>(std::max<uint64_t>(mesh.vertices.size(), kChunkVertices * bytes / most));
  const auto indices = static_cast<uint32_t>(std::max<uint64_t>(mesh.indices.size(), kChunkIndices * bytes / most));
  const uint64_t sizeBytes = vertices * vertexBytes_ + indices * sizeof(uint32_t);
  chunks_.push_back({createBuffer(), createBuffer(), textured_ ? createBuffer() : GlBuffer(), RangeAllocator(vertices),
                     RangeAllocator(indices), sizeBytes});
  const Chunk& chunk = chunks_.back();
  if (textured_)
    glNamedBufferStorage(chunk.coordinates.name(), static_cast<GLsizeiptr>(vertices * sizeof(uint32_t)), nullptr,
                         GL_DYNAMIC_STORAGE_BIT);
  glNamedBufferStorage(chunk.vertices.name(), static_cast<GLsizeiptr>(vertices * sizeof(GpuVertex)), nullptr,
                       GL_DYNAMIC_STORAGE_BIT);
  glNamedBufferStorage(chunk.indices.name(), static_cast<GLsizeiptr>(indices * sizeof(uint32_t)), nullptr,
                       GL_DYNAMIC_STORAGE_BIT);
  usedBytes_ += sizeBytes;
}

bool GeometryStore::evictOldest() {
  const auto oldest = std::min_element(residents_.begin(), residents_.end(), [](const auto& l, const auto& r) {
    return l.second.portion < r.second.portion;
  });
  if (oldest == residents_.end() || oldest->second.portion == portion_) return false;
  const Resident resident = oldest->second;
  residents_.erase(oldest);
  resident.chunk->vertexRanges.release(resident.firstVertex, resident.vertexCount);
  resident.chunk->indexRanges.release(resident.firstIndex, resident.indexCount);
  if (resident.chunk->vertexRanges.empty()) {
    usedBytes_ -= resident.chunk->sizeBytes;
    chunks_.erase(resident.chunk);
  }
  return true;
}

void GeometryStore::bindTints(const std::vector<Tint>& tints) {
  if (tints.empty()) return glDisableVertexArrayAttrib(layout_.name(), kTintAttribute);
  if (!tints_) tints_ = createBuffer();
  glNamedBufferData(tints_.name(), static_cast<GLsizeiptr>(tints.size() * sizeof(Tint)), tints.data(), GL_STREAM_DRAW);
  glVertexArrayVertexBuffer(layout_.name(), kTintBinding, tints_.name(), 0, sizeof(Tint));
  glEnableVertexArrayAttrib(layout_.name(), kTintAttribute);
}

void GeometryStore::bindChunk(const Chunk& chunk, bool coordinates) {
  glVertexArrayVertexBuffer(layout_.name(), 0, chunk.vertices.name(), 0, sizeof(GpuVertex));
  glVertexArrayElementBuffer(layout_.name(), chunk.indices.name());
  if (coordinates)
    glVertexArrayVertexBuffer(layout_.name(), kCoordinatesBinding, chunk.coordinates.name(), 0, sizeof(uint32_t));
}

void GeometryStore::draw(const std::vector<uint32_t>& pages, const std::vector<Tint>& tints,
                         const std::vector<GLuint>& atlases) {
  if (pages.empty()) return;
  FARCELL_CHECK(tints.empty() || tints.size() == pages.size());
  FARCELL_CHECK(atlases.empty() || atlases.size() == pages.size());
  if (!layout_) layout_ = createLayout();
  if (!commands_) commands_ = createBuffer();
  bindTints(tints);
  // What is drawn at once: of one buffer, looking at one atlas.
  using Together = std::pair<const Chunk*, GLuint>;
  std::map<Together, std::vector<DrawCommand>> batches;
  for (uint32_t i = 0; i < pages.size(); ++i) {
    const Resident& resident = residents_.at(pages[i]);
    batches[{&*resident.chunk, atlases.empty() ? 0 : atlases[i]}].push_back(
        {resident.indexCount, 1, resident.firstIndex, static_cast<int32_t>(resident.firstVertex), i});
  }
  std::vector<DrawCommand> commands;
  for (const auto& [together, list] : batches) commands.insert(commands.end(), list.begin(), list.end());
  glNamedBufferData(commands_.name(), static_cast<GLsizeiptr>(commands.size() * sizeof(DrawCommand)), commands.data(),
                    GL_STREAM_DRAW);
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands_.name());
  glBindVertexArray(layout_.name());
  (atlases.empty() ? glDisableVertexArrayAttrib : glEnableVertexArrayAttrib)(layout_.name(), kCoordinatesAttribute);
  size_t first = 0;
  const Chunk* bound = nullptr;
  for (const auto& [together, list] : batches) {
    const auto& [chunk, atlas] = together;
    if (chunk != bound) bindChunk(*chunk, !atlases.empty());
    bound = chunk;
    if (atlas != 0) glBindTextureUnit(kAtlasUnit, atlas);
    glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT,
                                reinterpret_cast<const void*>(first * sizeof(DrawCommand)),
                                static_cast<GLsizei>(list.size()), 0);
    first += list.size();
  }
}

}  // namespace farcell
