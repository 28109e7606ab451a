#include "preprocess/read/gltf/primitive_vertices.h"

#include <cstring>
#include <limits>

namespace farcell {
namespace {

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

}  // namespace

Result<> loadVertices(const PrimitiveElements& elements, const GltfPrimitive& primitive, VertexWindow window,
                      PrimitiveVertices& out) {
  const Elements& position = elements.position;
  out.divisor = position.isNormalized ? fullScale(position.type) : 1;
  FARCELL_TRY(loadPoints(position, window, 1, out.positions));
  out.normals.clear();
  out.colours.clear();
  out.textureCoordinates.clear();
  // Integers are normals only when normalised.
  if (elements.normal) FARCELL_TRY(loadPoints(*elements.normal, window, fullScale(elements.normal->type), out.normals));
  out.colour = primitive.plainColour;
  if (elements.colour) FARCELL_TRY(loadColours(*elements.colour, window, primitive.look.factor, out.colours));
  if (elements.textureCoordinates)
    FARCELL_TRY(
        loadTextureCoordinates(*elements.textureCoordinates, window, primitive.look.transform, out.textureCoordinates));
  return {};
}

}  // namespace farcell
