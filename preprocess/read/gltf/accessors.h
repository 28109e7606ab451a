// The typed arrays of a glTF file: checked when it is opened, their elements found when they are needed.
#pragma once

#include <array>
#include <span>

#include "preprocess/read/gltf/buffers.h"

namespace tinygltf {
struct Accessor;
}

namespace farcell {

inline constexpr uint32_t kNoAccessor = 0xffffffffu;

enum class ComponentType : uint32_t { int8 = 5120, uint8, int16, uint16, uint32 = 5125, float32 };
size_t sizeBytes(ComponentType type);
// An integer's largest value, what 1 is when it is normalised; 1 for floats.
double fullScale(ComponentType type);

// Equal elements somewhere in a range of bytes.
struct Elements {
  ByteRange bytes;
  uint64_t count = 0;
  uint32_t stride = 0;
  ComponentType type = ComponentType::float32;
  uint32_t components = 0;
  bool isNormalized = false;

  size_t elementBytes() const { return components * sizeBytes(type); }
};

struct SparsePart {
  uint64_t count = 0;
  uint64_t indexView = 0;
  uint64_t indexOffset = 0;
  ComponentType indexType = ComponentType::uint32;
  uint64_t valueView = 0;
  uint64_t valueOffset = 0;
};

struct GltfAccessor {
  std::optional<uint64_t> view;  // none: zeros, or bytes that an extension brings
  uint64_t offset = 0;
  uint64_t count = 0;
  uint32_t type = 0;        // as in the file; a ComponentType once checked
  uint32_t components = 0;  // of a vector; 0 for matrices, which nothing here uses
  bool isNormalized = false;
  std::optional<SparsePart> sparse;
};

// What an accessor is used for decides what it may be.
struct AccessorUse {
  const char* name;
  std::span<const ComponentType> types;
  uint32_t minComponents;
  uint32_t maxComponents;
  bool mayHaveStride = true;
};
extern const AccessorUse kIndicesUse;
extern const AccessorUse kPositionUse;
extern const AccessorUse kNormalUse;
extern const AccessorUse kColourUse;
extern const AccessorUse kTextureCoordinatesUse;

class GltfAccessors {
 public:
  // `noView`: the view that stands for none. `buffers` must outlive the accessors.
  GltfAccessors(GltfBuffers& buffers, std::span<const tinygltf::Accessor> accessors, uint64_t noView);

  GltfPlace place(uint64_t accessor) const { return buffers_.place(fmt::format("accessors[{}]", accessor)); }
  // Type and number fit the use; `user` is who names the accessor.
  Result<const GltfAccessor*> checkedType(const GltfPlace& user, uint64_t accessor, const AccessorUse& use) const;
  // The same, and every element lies within its view.
  Result<const GltfAccessor*> checked(const GltfPlace& user, uint64_t accessor, const AccessorUse& use) const;
  // Whether anything of the file stands for its elements.
  bool hasBytes(uint64_t accessor) const;
  // REQUIRES: a checked accessor. In memory where it is sparse.
  Result<Elements> elements(uint64_t accessor);
  // REQUIRES: a checked type. Without bytes.
  Elements typeOnly(uint64_t accessor) const;

 private:
  Result<> checkExtent(uint64_t index, const AccessorUse& use) const;
  Result<> checkSparse(uint64_t index) const;
  Result<Elements> withSparse(uint64_t index, const Elements& dense);

  GltfBuffers& buffers_;
  std::vector<GltfAccessor> accessors_;
};

// Explained in KHR_mesh_quantization: -128 and -32768 count as the value above them where integers are normalised.
double loadComponent(const std::byte* at, ComponentType type);

}  // namespace farcell
