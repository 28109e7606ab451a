#include "preprocess/lod/output.h"

#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "shaders/shared/shading.h"

namespace farcell::lod {
namespace {

constexpr uint32_t kNone = UINT32_MAX;

glm::vec3 unitOf(uint32_t packed) {
  const auto component = [](uint32_t bits) { return static_cast<float>(static_cast<int16_t>(bits)) / 32767.0f; };
  return shared::unitFromOctahedral(glm::vec2(component(packed & 0xffff), component(packed >> 16)));
}

class VertexChoice {
 public:
  explicit VertexChoice(const WeldedMesh& mesh) : mesh_(mesh), starts_(mesh.places.size() + 2) {
    for (const uint32_t place : mesh.placeOfVertex) ++starts_[place + 2];
    for (size_t i = 2; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    vertices_.resize(mesh.placeOfVertex.size());
    for (uint32_t vertex = 0; vertex < mesh.placeOfVertex.size(); ++vertex)
      vertices_[starts_[mesh.placeOfVertex[vertex] + 1]++] = vertex;
  }

  // The vertex of the place that is most like `vertex`; of equals the first.
  uint32_t at(uint32_t place, uint32_t vertex) const {
    if (mesh_.placeOfVertex[vertex] == place) return vertex;
    uint32_t best = vertices_[starts_[place]];
    if (starts_[place + 1] - starts_[place] == 1) return best;
    float least = difference(best, vertex);
    for (uint32_t i = starts_[place] + 1; i < starts_[place + 1]; ++i) {
      const float other = difference(vertices_[i], vertex);
      if (other < least) best = vertices_[i];
      least = std::min(least, other);
    }
    return best;
  }

 private:
  // Black against white counts as much as opposite normals.
  float difference(uint32_t a, uint32_t b) const {
    float sum = 0;
    if (!mesh_.colours.empty())
      for (int shift = 0; shift < 24; shift += 8)
        sum +=
            static_cast<float>(std::abs(int(mesh_.colours[a] >> shift & 255) - int(mesh_.colours[b] >> shift & 255))) /
            765;
    if (!mesh_.normals.empty()) sum += 0.5f - 0.5f * glm::dot(unitOf(mesh_.normals[a]), unitOf(mesh_.normals[b]));
    return sum;
  }

  const WeldedMesh& mesh_;
  std::vector<uint32_t> starts_;
  std::vector<uint32_t> vertices_;  // by place
};

}  // namespace

LodMesh outputMesh(const WeldedMesh& mesh, const Reduction& reduction) {
  const VertexChoice choice(mesh);
  std::vector<uint32_t> numberOf(mesh.placeOfVertex.size(), kNone);
  LodMesh result;
  result.indices.reserve(3 * reduction.triangles.size());
  for (size_t t = 0; t < reduction.triangles.size(); ++t) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t place = reduction.triangles[t][k];
      const uint32_t vertex = choice.at(place, mesh.corners[reduction.origins[t]][k]);
      if (numberOf[vertex] == kNone) {
        numberOf[vertex] = static_cast<uint32_t>(result.positions.size());
        result.positions.push_back(reduction.places[place]);
        if (!mesh.colours.empty()) result.colours.push_back(mesh.colours[vertex]);
        if (!mesh.normals.empty()) result.normals.push_back(mesh.normals[vertex]);
      }
      result.indices.push_back(numberOf[vertex]);
    }
  }
  return result;
}

}  // namespace farcell::lod
