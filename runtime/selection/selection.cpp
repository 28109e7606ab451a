#include "runtime/selection/selection.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "cache/schema/view_frame.h"

namespace farcell {
namespace {

constexpr double kMaxEyeSteps = 1e30;  // farther away, a model is less than nothing; products stay finite

// Everything is in grid steps from the grid's origin: exact for cells, whatever the model's scale and offset.
struct View {
  glm::dvec3 eye{0};
  std::array<glm::dvec3, 4> sides{};  // inward unit normals of the frustum's side planes, which pass through the eye
  double pixelAngle = 0;              // edge of a pixel at distance 1 from the eye
};

View makeView(const Grid& grid, const Camera& camera, int width, int height) {
  View view;
  for (int axis = 0; axis < 3; ++axis)
    view.eye[axis] = std::clamp((camera.position[axis] - grid.origin[axis]) / grid.step(), -kMaxEyeSteps, kMaxEyeSteps);
  const CameraAxes axes = cameraAxes(camera);
  const double tanY = std::tan(camera.fovYRad / 2);
  const double tanX = tanY * width / height;
  view.sides = {glm::normalize(axes.right - axes.back * tanX), glm::normalize(-axes.right - axes.back * tanX),
                glm::normalize(axes.up - axes.back * tanY), glm::normalize(-axes.up - axes.back * tanY)};
  view.pixelAngle = 2 * tanY / height;
  return view;
}

// Conservative: a box that meets the frustum is never called outside.
bool outside(const View& view, const GridBox& box) {
  for (const glm::dvec3& side : view.sides) {
    glm::dvec3 corner;
    for (int axis = 0; axis < 3; ++axis) corner[axis] = side[axis] >= 0 ? box.max[axis] : box.min[axis];
    corner -= view.eye;
    if (glm::dot(corner, side) < -1e-12 * glm::length(corner)) return true;
  }
  return false;
}

double distanceSteps(glm::dvec3 eye, const GridBox& box) {
  glm::dvec3 nearest;
  for (int axis = 0; axis < 3; ++axis)
    nearest[axis] = std::clamp(eye[axis], static_cast<double>(box.min[axis]), static_cast<double>(box.max[axis]));
  return glm::length(eye - nearest);
}

constexpr double kLargest = 1e300;  // of errors: what is inside a content box still compares
constexpr double kNever = std::numeric_limits<double>::infinity();

// A cell in view that no cell above it stands for as an impostor. Errors are in multiples of what they may be;
// kNever: it cannot be drawn so.
struct Node {
  uint32_t cell;
  uint32_t end;  // index after the last node below it
  double viewError = kNever;
  double meshError = kNever;
  uint64_t triangles = 0;  // of the cell as `drawn` says, with all below it
  enum class Drawn : uint8_t { asViews, asMesh, byChildren } drawn = Drawn::byChildren;
};

class Selector {
 public:
  Selector(const Directory& directory, const Viewpoints& viewpoints, const Camera& camera, const View& view,
           const SelectionSettings& settings)
      : directory_(directory),
        viewpoints_(viewpoints),
        back_(cameraAxes(camera).back),
        view_(view),
        settings_(settings),
        imageTexel_(texelSize(directory.model.settings.imageSize)) {}

  Cut run() {
    if (!directory_.cells.empty()) visit(0);
    if (settings_.mode == RenderMode::automatic)
      decideWithinBudget();
    else
      decide(settings_.mode == RenderMode::impostors ? kLargest : 1);
    collect();
    return std::move(cut_);
  }

 private:
  // Nodes front to back, each followed by those below it.
  void visit(uint32_t index) {
    const CellRecord& cell = directory_.cells[index];
    if (cell.content.empty()) return;
    if (settings_.mode != RenderMode::full && outside(view_, cell.content)) {
      ++cut_.culled;
      return;
    }
    const size_t place = nodes_.size();
    nodes_.push_back({.cell = index, .end = 0, .viewError = viewError(cell), .meshError = meshError(cell)});
    if (nodes_[place].viewError > 1) visitChildren(cell);
    nodes_[place].end = static_cast<uint32_t>(nodes_.size());
  }

  // A ray from the eye crosses each plane between the children at most once, away from the eye's side: an octant can
  // hide another only if it differs from the eye's octant in a subset of the other's axes. Counting up in
  // (octant xor eye's octant) visits subsets first.
  void visitChildren(const CellRecord& cell) {
    if (cell.childCount == 0) return;
    const GridBox box = cellBox(directory_.model.grid, cell.key);
    uint32_t eyeOctant = 0;
    for (int axis = 0; axis < 3; ++axis)
      if (2 * view_.eye[axis] >= static_cast<double>(box.min[axis]) + box.max[axis]) eyeOctant |= 1u << axis;
    std::array<uint32_t, 8> children;
    children.fill(kNone);
    for (uint32_t child = cell.firstChild; child < cell.firstChild + cell.childCount; ++child)
      children[directory_.cells[child].key.octant()] = child;
    for (uint32_t i = 0; i < 8; ++i)
      if (children[i ^ eyeOctant] != kNone) visit(children[i ^ eyeOctant]);
  }

  // Views of an inner cell keep to what they may or its children's are better; a leaf's are what is left.
  double viewError(const CellRecord& cell) const {
    const bool wanted = settings_.mode == RenderMode::automatic || settings_.mode == RenderMode::impostors;
    if (!wanted || cell.firstViewPage == kNone) return kNever;
    const double error = std::min(texelPixels(cell) / settings_.texelPixels, kLargest);
    if (error <= 1 && outsideSphere(cell)) return error;
    // The least above 1: a leaf whose sphere the eye is in has no impostor that keeps to what it may.
    return cell.childCount == 0 ? std::max(error, std::nextafter(1.0, 2.0)) : kNever;
  }
  double meshError(const CellRecord& cell) const {
    if (cell.childCount == 0) return 0;
    const bool wanted = settings_.mode == RenderMode::automatic || settings_.mode == RenderMode::meshes;
    if (!wanted || settings_.meshPixels == 0 || cell.firstGeometryPage == kNone) return kNever;
    return std::min(meshPixels(cell) / settings_.meshPixels, kLargest);
  }

  bool outsideSphere(const CellRecord& cell) const {
    const GridBox cube = cellBox(directory_.model.grid, cell.key);
    const double halfSide = (cube.max.x - cube.min.x) * 0.5;
    return glm::length(view_.eye - glm::dvec3(cube.min + cube.max) * 0.5) > std::sqrt(3.0) * halfSide;
  }

  // Edge of a texel of the cell's views, and geometric error of its mesh.
  double texelPixels(const CellRecord& cell) const {
    const double halfSide = std::ldexp(0.5, directory_.model.grid.bits - static_cast<int>(cell.key.level));
    return imageTexel_ * halfSide / (distanceSteps(view_.eye, cell.content) * view_.pixelAngle);
  }
  double meshPixels(const CellRecord& cell) const {
    if (cell.geometricError == 0) return 0;
    const double errorSteps = cell.geometricError / directory_.model.grid.step();
    return errorSteps / (distanceSteps(view_.eye, cell.content) * view_.pixelAngle);
  }

  // The fewest triangles with errors of at most `allowed`; returns how many. Of equal counts, the smaller errors.
  uint64_t decide(double allowed) {
    for (size_t i = nodes_.size(); i-- > 0;) {
      Node& node = nodes_[i];
      const CellRecord& cell = directory_.cells[node.cell];
      node.triangles = 0;
      node.drawn = Node::Drawn::byChildren;
      for (size_t child = i + 1; child < node.end; child = nodes_[child].end) node.triangles += nodes_[child].triangles;
      if (node.viewError <= allowed) {
        node.drawn = Node::Drawn::asViews;
      } else if (cell.childCount == 0 || (node.meshError <= allowed && cell.meshTriangles < node.triangles)) {
        node.drawn = Node::Drawn::asMesh;
        node.triangles = cell.meshTriangles;
      }
    }
    return nodes_.empty() ? 0 : nodes_[0].triangles;
  }

  void decideWithinBudget() {
    if (decide(1) <= settings_.triangleBudget) return;
    std::vector<double> steps;  // where what is allowed makes a difference
    for (const Node& node : nodes_)
      for (const double error : {node.viewError, node.meshError})
        if (error > 1 && error < kNever) steps.push_back(error);
    std::sort(steps.begin(), steps.end());
    const auto least = std::partition_point(steps.begin(), steps.end(),
                                            [&](double allowed) { return decide(allowed) > settings_.triangleBudget; });
    decide(least == steps.end() ? kLargest : *least);
  }

  void collect() {
    for (size_t i = 0; i < nodes_.size();) {
      const Node& node = nodes_[i];
      if (node.drawn == Node::Drawn::byChildren) {
        ++i;
        continue;
      }
      if (node.drawn == Node::Drawn::asViews)
        addImpostor(node.cell);
      else
        addMesh(node.cell);
      i = node.end;
    }
  }

  void addImpostor(uint32_t index) {
    const GridBox& content = directory_.cells[index].content;
    glm::dvec3 direction = view_.eye - glm::dvec3(content.min + content.max) * 0.5;
    if (direction == glm::dvec3(0)) direction = back_;
    const auto [nearest, second] = viewpoints_.nearestTwo(direction);
    const Viewpoints::Triple blend = viewpoints_.hasTriangles()
                                         ? viewpoints_.nearestThree(direction)
                                         : Viewpoints::Triple{{nearest, second, second}, {1, 0, 0}};
    cut_.entries.push_back({index, Representation::impostor, static_cast<uint32_t>(nearest),
                            static_cast<uint32_t>(second), blend, texelPixels(directory_.cells[index])});
  }
  void addMesh(uint32_t index) {
    const CellRecord& cell = directory_.cells[index];
    const bool leaf = cell.childCount == 0;
    cut_.entries.push_back({.cell = index,
                            .representation = leaf ? Representation::triangles : Representation::mesh,
                            .errorPixels = leaf ? 0 : meshPixels(cell)});
    cut_.triangles += cell.meshTriangles;
  }

  const Directory& directory_;
  const Viewpoints& viewpoints_;
  const glm::dvec3 back_;
  const View view_;
  const SelectionSettings settings_;
  const double imageTexel_;
  std::vector<Node> nodes_;
  Cut cut_;
};

}  // namespace

Cut selectCut(const Directory& directory, const Viewpoints& viewpoints, const Camera& camera, int width, int height,
              const SelectionSettings& settings) {
  const View view = makeView(directory.model.grid, camera, width, height);
  return Selector(directory, viewpoints, camera, view, settings).run();
}

}  // namespace farcell
