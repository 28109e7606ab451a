#include "runtime/selection/selection.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

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

// A leaf that is too near for its views.
struct Candidate {
  size_t entry;
  double texelPixels;  // of its views, at its nearest point: the error that triangles would remove
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
    spendBudget();
    return std::move(cut_);
  }

 private:
  void visit(uint32_t index) {
    const CellRecord& cell = directory_.cells[index];
    if (cell.content.empty()) return;
    if (settings_.mode != RenderMode::full && outside(view_, cell.content)) {
      ++cut_.culled;
      return;
    }
    const bool wantsViews = settings_.mode == RenderMode::automatic || settings_.mode == RenderMode::impostors;
    if (wantsViews && cell.firstViewPage != kNone && farEnough(cell)) {
      addImpostor(index);
    } else if (cell.childCount > 0) {
      visitChildren(cell);
    } else if (!wantsViews || cell.firstViewPage == kNone) {
      addTriangles(index);
    } else if (settings_.mode == RenderMode::impostors) {
      addImpostor(index);
    } else {
      candidates_.push_back({cut_.entries.size(), texelPixels(cell)});
      addImpostor(index);
    }
  }

  // A ray from the eye crosses each plane between the children at most once, away from the eye's side: an octant can
  // hide another only if it differs from the eye's octant in a subset of the other's axes. Counting up in
  // (octant xor eye's octant) visits subsets first.
  void visitChildren(const CellRecord& cell) {
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

  bool farEnough(const CellRecord& cell) const {
    const GridBox cube = cellBox(directory_.model.grid, cell.key);
    const double halfSide = (cube.max.x - cube.min.x) * 0.5;
    if (glm::length(view_.eye - glm::dvec3(cube.min + cube.max) * 0.5) <= std::sqrt(3.0) * halfSide) return false;
    return texelPixels(cell) <= settings_.texelPixels;
  }

  // Edge of a texel of the cell's views at the cell's nearest point; infinite inside the content box.
  double texelPixels(const CellRecord& cell) const {
    const double halfSide = std::ldexp(0.5, directory_.model.grid.bits - static_cast<int>(cell.key.level));
    return imageTexel_ * halfSide / (distanceSteps(view_.eye, cell.content) * view_.pixelAngle);
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
  void addTriangles(uint32_t index) {
    cut_.entries.push_back({index});
    cut_.triangles += directory_.cells[index].triangles;
  }

  // Cells without views have been counted already: the rest of the budget goes to the worst candidates.
  void spendBudget() {
    std::stable_sort(candidates_.begin(), candidates_.end(),
                     [](const Candidate& l, const Candidate& r) { return l.texelPixels > r.texelPixels; });
    for (const Candidate& candidate : candidates_) {
      CutEntry& entry = cut_.entries[candidate.entry];
      const uint64_t triangles = directory_.cells[entry.cell].triangles;
      if (cut_.triangles > settings_.triangleBudget || triangles > settings_.triangleBudget - cut_.triangles) return;
      cut_.triangles += triangles;
      entry = {entry.cell};
    }
  }

  const Directory& directory_;
  const Viewpoints& viewpoints_;
  const glm::dvec3 back_;
  const View view_;
  const SelectionSettings settings_;
  const double imageTexel_;
  std::vector<Candidate> candidates_;
  Cut cut_;
};

}  // namespace

Cut selectCut(const Directory& directory, const Viewpoints& viewpoints, const Camera& camera, int width, int height,
              const SelectionSettings& settings) {
  const View view = makeView(directory.model.grid, camera, width, height);
  return Selector(directory, viewpoints, camera, view, settings).run();
}

}  // namespace farcell
