#include "preprocess/read/gltf/buffers.h"

#include <nlohmann/json.hpp>

#include "preprocess/read/gltf/uri.h"

namespace farcell {
namespace {

using nlohmann::json;

constexpr size_t kMaxFiles = 512;                           // each stays open
constexpr uint64_t kMaxDataUriBytes = uint64_t{256} << 20;  // of all buffers together
constexpr uint32_t kMaxStrideBytes = 252;

MeshoptCoding codingOf(const json& extension) {
  MeshoptCoding coding;
  coding.buffer = extension["buffer"].get<uint32_t>();
  coding.offset = extension.value("byteOffset", uint64_t{0});
  coding.size = extension["byteLength"].get<uint64_t>();
  coding.stride = extension["byteStride"].get<uint32_t>();
  coding.count = extension["count"].get<uint64_t>();
  coding.mode = extension["mode"].get<std::string>();
  coding.filter = extension.value("filter", std::string("NONE"));
  return coding;
}

GltfView viewOf(const json& object) {
  GltfView view;
  view.buffer = object["buffer"].get<uint32_t>();
  view.offset = object.value("byteOffset", uint64_t{0});
  view.size = object["byteLength"].get<uint64_t>();
  view.stride = object.value("byteStride", uint32_t{0});
  if (const auto extensions = object.find("extensions"); extensions != object.end())
    if (const auto found = extensions->find("EXT_meshopt_compression"); found != extensions->end())
      view.coding = codingOf(*found);
  if (view.coding && view.coding->mode == "ATTRIBUTES" && view.stride == 0) view.stride = view.coding->stride;
  return view;
}

// Its bytes may be left out: every view of it is compressed and lies elsewhere.
bool isFallback(const json& buffer) {
  const auto extensions = buffer.find("extensions");
  return extensions != buffer.end() && extensions->contains("EXT_meshopt_compression");
}

}  // namespace

Result<> GltfBuffers::open(const json& root, const std::optional<ByteRange>& binary) {
  const json none = json::array();
  const json& buffers = root.contains("buffers") ? root["buffers"] : none;
  for (size_t i = 0; i < buffers.size(); ++i) {
    FARCELL_ASSIGN(std::optional<ByteRange> bytes,
                   openBuffer(place(fmt::format("buffers[{}]", i)), buffers[i], i == 0, binary));
    buffers_.push_back(std::move(bytes));
  }
  if (!root.contains("bufferViews")) return {};
  for (const json& view : root["bufferViews"]) views_.push_back(viewOf(view));
  return {};
}

Result<std::optional<ByteRange>> GltfBuffers::openBuffer(const GltfPlace& place, const json& buffer, bool mayBeBinary,
                                                         const std::optional<ByteRange>& binary) {
  const auto uri = buffer.find("uri");
  ByteRange bytes;
  if (uri == buffer.end()) {
    const bool isBinary = mayBeBinary && binary;
    if (!isBinary && isFallback(buffer)) return std::nullopt;
    if (!isBinary) return place.bad("a uri, or to be the first buffer of a .glb with a binary chunk", "neither");
    bytes = *binary;
  } else if (const auto& text = uri->get_ref<const std::string&>(); isDataUri(text)) {
    FARCELL_ASSIGN(MemoryClaim room, claim(place.in("uri"), text.size()));
    FARCELL_ASSIGN(std::vector<std::byte> decoded,
                   decodeDataUri(place.in("uri"), text, kMaxDataUriBytes - dataUriBytes_));
    dataUriBytes_ += decoded.size();
    bytes = inMemory(std::move(room), std::move(decoded));
  } else {
    FARCELL_ASSIGN(const InputFile* file, openBeside(place.in("uri"), text));
    bytes = {file, nullptr, 0, file->sizeBytes()};
  }
  const auto length = buffer["byteLength"].get<uint64_t>();
  if (length > bytes.size)
    return place.in("byteLength").bad(fmt::format("at most {}", bytes.size), std::to_string(length));
  return bytes.part(0, length);
}

std::vector<std::filesystem::path> GltfBuffers::files() const {
  std::vector<std::filesystem::path> paths;
  for (const InputFile& file : files_) paths.emplace_back(file.path());
  return paths;
}

Result<const InputFile*> GltfBuffers::openBeside(const GltfPlace& place, const std::string& uri) {
  FARCELL_ASSIGN(const std::filesystem::path relative, pathFromUri(place, uri));
  const std::filesystem::path whole = (std::filesystem::path(path()).parent_path() / relative).lexically_normal();
  for (const InputFile& file : files_)
    if (std::filesystem::path(file.path()).lexically_normal() == whole) return &file;
  if (files_.size() >= kMaxFiles)
    return place.failed(ErrorKind::exhausted, fmt::format("at most {} files", kMaxFiles), "more");
  FARCELL_ASSIGN(InputFile file, InputFile::open(whole));
  files_.push_back(std::move(file));
  return &files_.back();
}

Result<MemoryClaim> GltfBuffers::claim(const GltfPlace& place, uint64_t bytes) {
  const std::string what = fmt::format("{}: {}", place.path, place.where);
  // What was decoded before can be decoded again.
  for (; !decoded_.empty(); decoded_.pop_back())
    if (Result<MemoryClaim> room = memory_->claim(bytes, what)) return room;
  return memory_->claim(bytes, what);
}

Result<> GltfBuffers::claimTable(const GltfPlace& place, uint64_t bytes) {
  FARCELL_ASSIGN(MemoryClaim room, claim(place, bytes));
  tables_.add(std::move(room));
  return {};
}

Result<> GltfBuffers::checkExtent(const GltfPlace& place, uint32_t buffer, uint64_t offset, uint64_t size) const {
  if (buffer >= buffers_.size())
    return place.in("buffer").bad(fmt::format("one of {} buffers", buffers_.size()), std::to_string(buffer));
  if (!buffers_[buffer]) return place.in("buffer").bad("a buffer that has bytes", std::to_string(buffer));
  const uint64_t end = buffers_[buffer]->size;
  if (offset > end || size > end - offset)
    return place.bad(fmt::format("bytes within buffers[{}] of {}", buffer, end), fmt::format("{} + {}", offset, size));
  return {};
}

Result<const GltfView*> GltfBuffers::checkedView(const GltfPlace& user, uint64_t index) const {
  if (index >= views_.size())
    return user.bad(fmt::format("one of {} bufferViews", views_.size()), std::to_string(index));
  const GltfView& view = views_[index];
  const GltfPlace at = place(fmt::format("bufferViews[{}]", index));
  if (view.stride != 0 && (view.stride % 4 != 0 || view.stride > kMaxStrideBytes))
    return at.in("byteStride").bad("a multiple of 4, at most 252", std::to_string(view.stride));
  if (!view.coding) {
    FARCELL_TRY(checkExtent(at, view.buffer, view.offset, view.size));
    return &view;
  }
  if (view.stride != 0 && view.stride != view.coding->stride)
    return at.in("byteStride")
        .bad(fmt::format("that of its coding, {}", view.coding->stride), std::to_string(view.stride));
  const GltfPlace codingAt = at.in("extensions.EXT_meshopt_compression");
  FARCELL_TRY(checkExtent(codingAt, view.coding->buffer, view.coding->offset, view.coding->size));
  FARCELL_TRY(checkMeshoptCoding(codingAt, *view.coding, view.size));
  return &view;
}

ByteRange GltfBuffers::plainBytes(const GltfView& view) const {
  FARCELL_CHECK(!view.coding);
  return buffers_[view.buffer]->part(view.offset, view.size);
}

Result<ByteRange> GltfBuffers::bytes(uint64_t index) {
  const GltfView& view = views_[index];
  if (!view.coding) return plainBytes(view);
  const auto found =
      std::find_if(decoded_.begin(), decoded_.end(), [&](const Decoded& decoded) { return decoded.view == index; });
  Decoded decoded{index, {}};
  if (found != decoded_.end()) {
    decoded = std::move(*found);
    decoded_.erase(found);
  } else {
    const ByteRange coded = buffers_[view.coding->buffer]->part(view.coding->offset, view.coding->size);
    const GltfPlace at = place(fmt::format("bufferViews[{}].extensions.EXT_meshopt_compression", index));
    FARCELL_ASSIGN(MemoryClaim room, claim(at, coded.size + view.size));
    FARCELL_ASSIGN(std::vector<std::byte> bytes, decodeMeshopt(at, *view.coding, coded));
    room.shrink(view.size);
    decoded.bytes = inMemory(std::move(room), std::move(bytes));
  }
  // Views that many primitives share are decoded once; what was used longest ago goes first.
  decoded_.push_front(decoded);
  return decoded.bytes;
}

}  // namespace farcell
