#include "preprocess/lod/openmesh.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wdeprecated-copy"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wsign-compare"
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#pragma GCC diagnostic pop

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numeric>
#include <utility>

namespace farcell::lod {
namespace {

constexpr float kMostTurnDegrees = 80;
// A result of less area than this share is not what OpenMesh is asked for.
constexpr double kLeastAreaKept = 0.97;

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using Mesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

// Of a vertex: the faces of the cell's cube that it lies on.
using Faces = std::vector<uint8_t>;

// Keeps the triangles that have an edge in a face of the cell's cube.
template <class M>
class ModCellFaces : public OpenMesh::Decimater::ModBaseT<M> {
 public:
  DECIMATING_MODULE(ModCellFaces, M, CellFaces);
  explicit ModCellFaces(M& mesh) : Base(mesh, true) {}

  void setFaces(const Faces* faces) { faces_ = faces; }
  float collapse_priority(const CollapseInfo& info) override {
    const auto inFace = [&](auto apex) { return apex.is_valid() && (of(info.v1) & of(apex)) != 0; };
    return inFace(info.vl) || inFace(info.vr) ? float(Base::ILLEGAL_COLLAPSE) : float(Base::LEGAL_COLLAPSE);
  }

 private:
  uint8_t of(typename M::VertexHandle vertex) const { return (*faces_)[static_cast<size_t>(vertex.idx())]; }
  const Faces* faces_ = nullptr;
};

struct Input {
  Mesh mesh;
  std::vector<uint32_t> places;  // of the vertices
  Faces faces;
};

// OpenMesh complains on std::cerr and leaves faces out that make an edge or a vertex complex.
bool fill(const WeldedMesh& welded, Input& input) {
  std::vector<Mesh::VertexHandle> handles(welded.places.size());
  for (const Triangle& t : welded.triangles) {
    std::array<Mesh::VertexHandle, 3> corners;
    for (size_t k = 0; k < 3; ++k) {
      Mesh::VertexHandle& handle = handles[t[k]];
      if (!handle.is_valid()) {
        const glm::dvec3 p(welded.places[t[k]] - welded.box.min);
        handle = input.mesh.add_vertex({p.x, p.y, p.z});
        input.places.push_back(t[k]);
        input.faces.push_back(welded.faces[t[k]]);
      }
      corners[k] = handle;
    }
    if (!input.mesh.add_face(corners[0], corners[1], corners[2]).is_valid()) return false;
  }
  return input.mesh.n_faces() == welded.triangles.size();
}

void decimate(Input& input, size_t target) {
  Mesh& mesh = input.mesh;
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_face_status();
  mesh.request_face_normals();
  mesh.update_face_normals();
  for (const Mesh::VertexHandle vertex : mesh.vertices())
    mesh.status(vertex).set_locked(input.faces[static_cast<size_t>(vertex.idx())] != 0);
  OpenMesh::Decimater::DecimaterT<Mesh> decimater(mesh);
  OpenMesh::Decimater::ModQuadricT<Mesh>::Handle quadric;
  OpenMesh::Decimater::ModNormalFlippingT<Mesh>::Handle flipping;
  ModCellFaces<Mesh>::Handle cellFaces;
  decimater.add(quadric);
  decimater.add(flipping);
  decimater.add(cellFaces);
  decimater.module(quadric).unset_max_err();
  decimater.module(flipping).set_max_normal_deviation(kMostTurnDegrees);
  decimater.module(cellFaces).setFaces(&input.faces);
  decimater.initialize();
  decimater.decimate_to_faces(0, target);
}

// The corner order in which most corners are where they were.
Triangle turnedLike(const Triangle& before, const Triangle& now) {
  Triangle best = now;
  int most = -1;
  for (size_t turn = 0; turn < 3; ++turn) {
    const Triangle turned = {now[turn], now[(turn + 1) % 3], now[(turn + 2) % 3]};
    const int same = (turned[0] == before[0]) + (turned[1] == before[1]) + (turned[2] == before[2]);
    if (same > most) best = turned;
    most = std::max(most, same);
  }
  return best;
}

double areaOf(std::span<const GridPoint> places, std::span<const Triangle> triangles) {
  double sum = 0;
  for (const Triangle& t : triangles)
    sum += glm::length(glm::cross(glm::dvec3(places[t[1]] - places[t[0]]), glm::dvec3(places[t[2]] - places[t[0]])));
  return sum;
}

}  // namespace

std::optional<Reduction> reduceByOpenMesh(const WeldedMesh& welded, size_t target) {
  ::omerr().disable();
  Input input;
  if (!fill(welded, input)) return std::nullopt;
  decimate(input, target);
  Reduction result{welded.places, {}, {}, std::vector<uint32_t>(welded.places.size())};
  std::iota(result.targets.begin(), result.targets.end(), 0u);
  for (const Mesh::FaceHandle face : input.mesh.faces()) {
    if (input.mesh.status(face).deleted()) continue;
    Triangle t;
    size_t k = 0;
    for (const Mesh::VertexHandle vertex : input.mesh.fv_range(face))
      t[k++] = input.places[static_cast<size_t>(vertex.idx())];
    const auto origin = static_cast<uint32_t>(face.idx());
    result.triangles.push_back(turnedLike(welded.triangles[origin], t));
    result.origins.push_back(origin);
  }
  if (result.triangles.size() > target) return std::nullopt;
  if (areaOf(result.places, result.triangles) < kLeastAreaKept * areaOf(welded.places, welded.triangles))
    return std::nullopt;
  return result;
}

}  // namespace farcell::lod
