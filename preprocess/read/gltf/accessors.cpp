#include "preprocess/read/gltf/accessors.h"

#include <tiny_gltf.h>

#include <cstring>

#include "preprocess/read/gltf/extent.h"

namespace farcell {
namespace {

using enum ComponentType;

// All that KHR_mesh_quantization allows, whether the file names the extension or not.
constexpr std::array kIndexTypes = {uint8, uint16, uint32};
constexpr std::array kVertexTypes = {int8, uint8, int16, uint16, float32};
constexpr std::array kNormalTypes = {int8, int16, float32};
constexpr std::array kColourTypes = {uint8, uint16, float32};

// Zeros that no byte of the file stands for; real files have none to speak of.
constexpr uint64_t kMaxZeroElements = uint64_t{4} << 20;

template <class T>
double load(const std::byte* at) {
  T value;
  std::memcpy(&value, at, sizeof(T));
  return static_cast<double>(value);
}

bool isOneOf(std::span<const ComponentType> types, uint32_t type) {
  return std::find(types.begin(), types.end(), static_cast<ComponentType>(type)) != types.end();
}

GltfAccessor convert(const tinygltf::Accessor& from, uint64_t noView) {
  GltfAccessor accessor;
  if (const auto view = static_cast<uint64_t>(from.bufferView); view != noView) accessor.view = view;
  accessor.offset = from.byteOffset;
  accessor.count = from.count;
  accessor.type = static_cast<uint32_t>(from.componentType);
  accessor.components = from.type == TINYGLTF_TYPE_SCALAR ? 1
                        : from.type <= TINYGLTF_TYPE_VEC4 ? static_cast<uint32_t>(from.type)
                                                          : 0;
  accessor.isNormalized = from.normalized;
  if (!from.sparse.isSparse) return accessor;
  const auto& indices = from.sparse.indices;
  const auto& values = from.sparse.values;
  accessor.sparse =
      SparsePart{static_cast<uint64_t>(from.sparse.count),  static_cast<uint64_t>(indices.bufferView),
                 static_cast<uint64_t>(indices.byteOffset), static_cast<ComponentType>(indices.componentType),
                 static_cast<uint64_t>(values.bufferView),  static_cast<uint64_t>(values.byteOffset)};
  return accessor;
}

// offset + (count - 1) * stride + elementBytes within the view, for count > 0.
Result<> checkFits(const GltfPlace& place, const GltfView& view, uint64_t offset, uint64_t count, uint64_t stride,
                   uint64_t elementBytes) {
  const std::optional<uint64_t> last = count == 0 ? 0 : productPlus(count - 1, stride, elementBytes);
  const std::optional<uint64_t> end = last ? productPlus(1, *last, offset) : std::nullopt;
  if (end && *end <= view.size) return {};
  return place.bad(fmt::format("elements within the {} bytes of its bufferView", view.size),
                   fmt::format("{} of {} bytes, every {}, from {}", count, elementBytes, stride, offset));
}

Result<std::vector<std::byte>> packed(const Elements& elements) {
  const size_t elementBytes = elements.elementBytes();
  std::vector<std::byte> all(elements.count * elementBytes);
  std::byte* out = all.data();
  FARCELL_TRY(forEachElement(elements.bytes, elements.count, elements.stride, elementBytes, [&](const std::byte* at) {
    std::memcpy(out, at, elementBytes);
    out += elementBytes;
    return true;
  }));
  return all;
}

// Puts values, one after the other, where the indices say.
Result<> replaceElements(const GltfPlace& place, const ByteRange& indices, ComponentType indexType,
                         std::span<const std::byte> values, size_t elementBytes, std::vector<std::byte>& all) {
  const double count = double(all.size() / elementBytes);
  const size_t indexBytes = sizeBytes(indexType);
  const std::byte* value = values.data();
  double next = 0;  // the least the index may be: they must rise
  double index = 0;
  FARCELL_TRY(forEachElement(indices, values.size() / elementBytes, indexBytes, indexBytes, [&](const std::byte* at) {
    index = loadComponent(at, indexType);
    if (index < next || index >= count) return false;
    std::memcpy(all.data() + static_cast<size_t>(index) * elementBytes, value, elementBytes);
    value += elementBytes;
    next = index + 1;
    return true;
  }));
  if (value == values.data() + values.size()) return {};
  return place.bad(fmt::format("an index of {} to {}", next, count - 1), fmt::format("{}", index));
}

}  // namespace

const AccessorUse kIndicesUse{"indices", kIndexTypes, 1, 1, false};
const AccessorUse kPositionUse{"POSITION", kVertexTypes, 3, 3};
const AccessorUse kNormalUse{"NORMAL", kNormalTypes, 3, 3};
const AccessorUse kColourUse{"COLOR_0", kColourTypes, 3, 4};
const AccessorUse kTextureCoordinatesUse{"TEXCOORD", kVertexTypes, 2, 2};

size_t sizeBytes(ComponentType type) {
  return type == int8 || type == uint8 ? 1 : type == int16 || type == uint16 ? 2 : 4;
}

double fullScale(ComponentType type) {
  constexpr std::array kScales = {127.0, 255.0, 32767.0, 65535.0, 1.0, 4294967295.0, 1.0};
  return kScales[static_cast<uint32_t>(type) - static_cast<uint32_t>(int8)];
}

double loadComponent(const std::byte* at, ComponentType type) {
  switch (type) {
    case int8:
      return load<int8_t>(at);
    case uint8:
      return load<uint8_t>(at);
    case int16:
      return load<int16_t>(at);
    case uint16:
      return load<uint16_t>(at);
    case uint32:
      return load<uint32_t>(at);
    case float32:
      return load<float>(at);
  }
  return 0;
}

GltfAccessors::GltfAccessors(GltfBuffers& buffers, std::span<const tinygltf::Accessor> accessors, uint64_t noView)
    : buffers_(buffers) {
  for (const tinygltf::Accessor& accessor : accessors) accessors_.push_back(convert(accessor, noView));
}

Result<const GltfAccessor*> GltfAccessors::checkedType(const GltfPlace& user, uint64_t index,
                                                       const AccessorUse& use) const {
  if (index >= accessors_.size())
    return user.bad(fmt::format("one of {} accessors", accessors_.size()), std::to_string(index));
  const GltfAccessor& accessor = accessors_[index];
  if (!isOneOf(use.types, accessor.type))
    return place(index).in("componentType").bad(fmt::format("a type for {}", use.name), std::to_string(accessor.type));
  if (accessor.components < use.minComponents || accessor.components > use.maxComponents)
    return place(index).in("type").bad(fmt::format("{} numbers for {}", use.maxComponents, use.name),
                                       fmt::format("{}", accessor.components));
  return &accessor;
}

Result<const GltfAccessor*> GltfAccessors::checked(const GltfPlace& user, uint64_t index,
                                                   const AccessorUse& use) const {
  FARCELL_ASSIGN(const GltfAccessor* accessor, checkedType(user, index, use));
  FARCELL_TRY(checkExtent(index, use));
  if (accessor->sparse) FARCELL_TRY(checkSparse(index));
  return accessor;
}

Result<> GltfAccessors::checkExtent(uint64_t index, const AccessorUse& use) const {
  const GltfAccessor& accessor = accessors_[index];
  if (!accessor.view) {
    if (accessor.count <= kMaxZeroElements) return {};
    return place(index).failed(ErrorKind::exhausted, fmt::format("at most {} elements without bytes", kMaxZeroElements),
                               std::to_string(accessor.count));
  }
  FARCELL_ASSIGN(const GltfView* view, buffers_.checkedView(place(index).in("bufferView"), *accessor.view));
  const size_t elementBytes = accessor.components * sizeBytes(static_cast<ComponentType>(accessor.type));
  const uint64_t stride = view->stride != 0 ? view->stride : elementBytes;
  if (use.mayHaveStride ? stride < elementBytes : stride != elementBytes)
    return place(index).bad(fmt::format("a byteStride for {} of {} bytes", use.name, elementBytes),
                            std::to_string(stride));
  return checkFits(place(index), *view, accessor.offset, accessor.count, stride, elementBytes);
}

Result<> GltfAccessors::checkSparse(uint64_t index) const {
  const GltfAccessor& accessor = accessors_[index];
  const SparsePart& sparse = *accessor.sparse;
  const GltfPlace at = place(index).in("sparse");
  if (sparse.count > accessor.count)
    return at.in("count").bad(fmt::format("at most {}", accessor.count), std::to_string(sparse.count));
  if (!isOneOf(kIndexTypes, static_cast<uint32_t>(sparse.indexType)))
    return at.in("indices.componentType")
        .bad("a type for indices", std::to_string(static_cast<uint32_t>(sparse.indexType)));
  FARCELL_ASSIGN(const GltfView* indices, buffers_.checkedView(at.in("indices.bufferView"), sparse.indexView));
  const size_t indexBytes = sizeBytes(sparse.indexType);
  FARCELL_TRY(checkFits(at.in("indices"), *indices, sparse.indexOffset, sparse.count, indexBytes, indexBytes));
  FARCELL_ASSIGN(const GltfView* values, buffers_.checkedView(at.in("values.bufferView"), sparse.valueView));
  const size_t elementBytes = accessor.components * sizeBytes(static_cast<ComponentType>(accessor.type));
  return checkFits(at.in("values"), *values, sparse.valueOffset, sparse.count, elementBytes, elementBytes);
}

bool GltfAccessors::hasBytes(uint64_t index) const {
  return index < accessors_.size() && (accessors_[index].view || accessors_[index].sparse);
}

Elements GltfAccessors::typeOnly(uint64_t index) const {
  const GltfAccessor& accessor = accessors_[index];
  Elements elements;
  elements.count = accessor.count;
  elements.type = static_cast<ComponentType>(accessor.type);
  elements.components = accessor.components;
  elements.isNormalized = accessor.isNormalized;
  elements.stride = static_cast<uint32_t>(elements.elementBytes());
  return elements;
}

Result<Elements> GltfAccessors::elements(uint64_t index) {
  const GltfAccessor& accessor = accessors_[index];
  Elements elements = typeOnly(index);
  if (accessor.view) {
    FARCELL_ASSIGN(const ByteRange view, buffers_.bytes(*accessor.view));
    FARCELL_ASSIGN(const GltfView* checked, buffers_.checkedView(place(index), *accessor.view));
    if (checked->stride != 0) elements.stride = checked->stride;
    elements.bytes = view.part(accessor.offset, view.size - accessor.offset);
  } else {
    const uint64_t size = accessor.count * elements.elementBytes();
    FARCELL_ASSIGN(MemoryClaim room, buffers_.claim(place(index), size));
    elements.bytes = inMemory(std::move(room), std::vector<std::byte>(size));
  }
  if (accessor.sparse) return withSparse(index, elements);
  return elements;
}

Result<Elements> GltfAccessors::withSparse(uint64_t index, const Elements& dense) {
  const SparsePart& sparse = *accessors_[index].sparse;
  const size_t elementBytes = dense.elementBytes();
  const GltfPlace at = place(index).in("sparse");
  FARCELL_ASSIGN(MemoryClaim room, buffers_.claim(at, dense.count * elementBytes));
  FARCELL_ASSIGN(MemoryClaim replacingRoom, buffers_.claim(at, sparse.count * elementBytes));
  FARCELL_ASSIGN(std::vector<std::byte> all, packed(dense));
  FARCELL_ASSIGN(const ByteRange values, buffers_.bytes(sparse.valueView));
  std::vector<std::byte> replacing(sparse.count * elementBytes);
  FARCELL_TRY(values.part(sparse.valueOffset, replacing.size()).read(replacing));
  FARCELL_ASSIGN(ByteRange indices, buffers_.bytes(sparse.indexView));
  indices = indices.part(sparse.indexOffset, sparse.count * sizeBytes(sparse.indexType));
  FARCELL_TRY(replaceElements(at.in("indices"), indices, sparse.indexType, replacing, elementBytes, all));
  Elements whole = dense;
  whole.bytes = inMemory(std::move(room), std::move(all));
  whole.stride = static_cast<uint32_t>(elementBytes);
  return whole;
}

}  // namespace farcell
