#include "preprocess/read/gltf/primitive_vertices.h"

#include <cstring>
#include <limits>

namespace farcell {
namespace {

struct VertexWindow {
  uint64_t first = 0;
  uint64_t count = 0;
};

// Calls take(numbers) for the window's elements: numbers as in the file, -128 and -32768 of normalised ones as the
// values above them (glTF 2.0, 3.6.2.2); components that are not there are 0.
template <class Take>
Result<> forEachVector(const Elements& elements, VertexWindow window, const Take& take) {
  if (window.count == 0) return {};
  const ByteRange part =
      elements.bytes.part(window.first * elements.stride, elements.bytes.size - window.first * elements.stride);
  const double least = elements.isNormalized ? -fullScale(elements.type) : -std::numeric_limits<double>::infinity();
  const bool isFloat = elements.type == ComponentType::float32;
  const size_t componentBytes = sizeBytes(elements.type);
  return forEachElement(part, window.count, elements.stride, elements.elementBytes(), [&](const std::byte* at) {
    std::array<double, 4> numbers{};
    for (uint32_t i = 0; i < elements.components; ++i, at += componentBytes)
      numbers[i] = loadComponent(at, elements.type);
    if (!isFloat)
      for (double& number : numbers) number = std::max(number, least);
    take(numbers);
    return true;
  });
}

Result<> loadFloats(const Elements& elements, VertexWindow window, std::vector<glm::vec3>& out) {
  const ByteRange part =
      elements.bytes.part(window.first * elements.stride, elements.bytes.size - window.first * elements.stride);
  return forEachElement(part, window.count, elements.stride, sizeof(glm::vec3), [&](const std::byte* at) {
    std::memcpy(&out.emplace_back(), at, sizeof(glm::vec3));
    return true;
  });
}

// Rounded to floats: bytes and shorts are exact.
Result<> loadPoints(const Elements& elements, VertexWindow window, double divisor, std::vector<glm::vec3>& out) {
  out.clear();
  out.reserve(window.count);
  if (window.count > 0 && elements.type == ComponentType::float32) return loadFloats(elements, window, out);
  return forEachVector(elements, window, [&](const std::array<double, 4>& numbers) {
    out.push_back(glm::vec3(glm::dvec3(numbers[0], numbers[1], numbers[2]) / divisor));
  });
}

Result<> loadColours(const Elements& elements, VertexWindow window, glm::dvec3 factor, std::vector<uint32_t>& out) {
  out.clear();
  out.reserve(window.count);
  // Integers are colours only as parts of their largest value, also where a writer forgot to say so.
  const double full = fullScale(elements.type);
  std::array<double, 4> last{};
  uint32_t colour = displayColour(glm::dvec3(0));
  return forEachVector(elements, window, [&](const std::array<double, 4>& numbers) {
    if (numbers != last) colour = displayColour(factor * glm::dvec3(numbers[0], numbers[1], numbers[2]) / full);
    last = numbers;
    out.push_back(colour);
  });
}

Result<> loadTextureCoordinates(const Elements& elements, VertexWindow window, const TextureTransform& transform,
                                std::vector<glm::vec2>& out) {
  out.clear();
  out.reserve(window.count);
  const double full = elements.isNormalized ? fullScale(elements.type) : 1;
  return forEachVector(elements, window, [&](const std::array<double, 4>& numbers) {
    const glm::dvec2 uv = transform.apply(glm::dvec2(numbers[0], numbers[1]) / full);
    out.emplace_back(static_cast<float>(uv.x), static_cast<float>(1 - uv.y));
  });
}

// Makes rows of vertices of the elements.
class RowLoader {
 public:
  RowLoader(const PrimitiveElements& elements, const GltfPrimitive& primitive, VertexShape shape)
      : elements_(elements), look_(primitive.look), shape_(shape) {}

  Result<> operator()(uint64_t first, std::span<std::byte> out) {
    const uint32_t rowBytes = shape_.rowBytes();
    const VertexWindow window{first, out.size() / rowBytes};
    FARCELL_TRY(load(window));
    Vertex vertex;
    for (size_t i = 0; i < window.count; ++i) {
      vertex.position = glm::dvec3(positions_[i]);
      if (shape_.hasColours) vertex.colour = colours_[i];
      if (shape_.hasNormals) vertex.normal = normals_[i];
      if (shape_.hasTextureCoordinates) vertex.textureCoordinates = textureCoordinates_[i];
      shape_.put(vertex, out.data() + i * rowBytes);
    }
    return {};
  }

 private:
  Result<> load(VertexWindow window) {
    FARCELL_TRY(loadPoints(elements_.position, window, 1, positions_));
    // Integers are normals only when normalised.
    if (elements_.normal)
      FARCELL_TRY(loadPoints(*elements_.normal, window, fullScale(elements_.normal->type), normals_));
    if (elements_.colour) FARCELL_TRY(loadColours(*elements_.colour, window, look_.factor, colours_));
    if (elements_.textureCoordinates)
      FARCELL_TRY(loadTextureCoordinates(*elements_.textureCoordinates, window, look_.transform, textureCoordinates_));
    return {};
  }

  PrimitiveElements elements_;
  GltfLook look_;
  VertexShape shape_;
  std::vector<glm::vec3> positions_;
  std::vector<glm::vec3> normals_;
  std::vector<uint32_t> colours_;
  std::vector<glm::vec2> textureCoordinates_;
};

}  // namespace

Result<PrimitiveVertices> primitiveVertices(const PrimitiveElements& elements, const GltfPrimitive& primitive,
                                            const std::shared_ptr<ReadMemory>& memory) {
  const VertexShape shape{.hasColours = elements.colour.has_value(),
                          .hasNormals = elements.normal.has_value(),
                          .hasTextureCoordinates = elements.textureCoordinates.has_value()};
  FARCELL_ASSIGN(Vertices vertices,
                 Vertices::loaded(memory, shape, primitive.vertices, RowLoader(elements, primitive, shape)));
  const Elements& position = elements.position;
  return PrimitiveVertices{std::move(vertices), position.isNormalized ? fullScale(position.type) : 1,
                           primitive.plainColour};
}

}  // namespace farcell
