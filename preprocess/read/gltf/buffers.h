// The bytes a glTF file brings: its buffers - files beside it, a chunk of it, or text in its JSON - and the views of
// them, some compressed by EXT_meshopt_compression. Nothing is read before it is asked for.
#pragma once

#include <deque>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "preprocess/read/gltf/container.h"
#include "preprocess/read/gltf/meshopt_view.h"
#include "preprocess/read/gltf/place.h"

namespace farcell {

struct GltfView {
  uint32_t buffer = 0;
  uint64_t offset = 0;
  uint64_t size = 0;
  uint32_t stride = 0;                  // 0: elements lie side by side
  std::optional<MeshoptCoding> coding;  // then buffer and offset mean nothing
};

class GltfBuffers {
 public:
  GltfBuffers(InputFile file, std::shared_ptr<ReadMemory> memory) : memory_(std::move(memory)) {
    files_.push_back(std::move(file));
  }
  GltfBuffers(const GltfBuffers&) = delete;  // ranges point into it
  GltfBuffers& operator=(const GltfBuffers&) = delete;

  // Opens the buffers of the checked JSON (gltf_shape.h) and takes its views.
  Result<> open(const nlohmann::json& root, const std::optional<ByteRange>& binary);

  const InputFile& file() const { return files_.front(); }
  const std::string& path() const { return file().path(); }
  const std::shared_ptr<ReadMemory>& memory() const { return memory_; }
  Result<MemoryClaim> claim(const GltfPlace& place, uint64_t bytes);
  // Of what lives as long as the buffers.
  Result<> claimTable(const GltfPlace& place, uint64_t bytes);
  GltfPlace place(std::string where) const { return {path(), std::move(where)}; }
  // The opened file first, each file once.
  std::vector<std::filesystem::path> files() const;
  // A file beside the opened one, open already or not.
  Result<const InputFile*> openBeside(const GltfPlace& place, const std::string& uri);

  size_t viewCount() const { return views_.size(); }
  // Whether the view lies within its buffer, and that one in its file; `user` is who names the view.
  Result<const GltfView*> checkedView(const GltfPlace& user, uint64_t view) const;
  // Where its bytes lie in a file or in memory. REQUIRES: a checked view that is not compressed.
  ByteRange plainBytes(const GltfView& view) const;
  // REQUIRES: a checked view. Decompressed where it must be, whole; these are kept while there is memory.
  Result<ByteRange> bytes(uint64_t view);

 private:
  struct Decoded {
    uint64_t view = 0;
    ByteRange bytes;
  };
  Result<std::optional<ByteRange>> openBuffer(const GltfPlace& place, const nlohmann::json& buffer, bool mayBeBinary,
                                              const std::optional<ByteRange>& binary);
  Result<> checkExtent(const GltfPlace& place, uint32_t buffer, uint64_t offset, uint64_t size) const;

  const std::shared_ptr<ReadMemory> memory_;
  MemoryClaim tables_;
  std::deque<InputFile> files_;                    // never moved
  std::vector<std::optional<ByteRange>> buffers_;  // none: a fallback that was left out
  std::vector<GltfView> views_;
  uint64_t dataUriBytes_ = 0;
  std::deque<Decoded> decoded_;  // last used first
};

}  // namespace farcell
