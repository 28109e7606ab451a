#include "runtime/selection/selection.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "cache/schema/view_frame.h"
#include "runtime/selection/cut_optimiser.h"
#include "runtime/selection/loss.h"

namespace farcell {
namespace {

constexpr double kMaxEyeSteps = 1e30;  // farther away, a model is less than nothing; products stay finite
// Where time, texels or bytes are short, an impostor's texel may be larger than allowed by this factor.
constexpr double kCoarsest = 8;

// Everything is in grid steps from the grid's origin: exact for cells, whatever the model's scale and offset.
struct View {
  glm::dvec3 eye{0};
  std::array<glm::dvec3, 4> sides{};  // inward unit normals of the frustum's side planes, which pass through the eye
  double pixelAngle = 0;              // edge of a pixel at distance 1 from the eye
};

View makeView(const Grid& grid, const Camera& camera, int width, int height, double detail) {
  View view;
  for (int axis = 0; axis < 3; ++axis)
    view.eye[axis] = std::clamp((camera.position[axis] - grid.origin[axis]) / grid.step(), -kMaxEyeSteps, kMaxEyeSteps);
  const CameraAxes axes = cameraAxes(camera);
  const double tanY = std::tan(camera.fovYRad / 2);
  const double tanX = tanY * width / height;
  view.sides = {glm::normalize(axes.right - axes.back * tanX), glm::normalize(-axes.right - axes.back * tanX),
                glm::normalize(axes.up - axes.back * tanY), glm::normalize(-axes.up - axes.back * tanY)};
  view.pixelAngle = 2 * tanY / (height * detail);
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

class Selector {
 public:
  Selector(const Directory& directory, const Camera& camera, const View& view, int width, int height,
           const SelectionSettings& settings, const HiddenCells* hidden)
      : directory_(directory),
        back_(cameraAxes(camera).back),
        view_(view),
        settings_(settings),
        hidden_(hidden),
        picturePixels_(static_cast<double>(width) * height * settings.detail * settings.detail) {}

  Cut run() {
    if (!directory_.cells.empty()) visit(0);
    if (nodes_.empty()) return std::move(cut_);
    CutDecision decision = decideCut(nodes_, prices(), budgets());
    if (hidden_ != nullptr && decision.budgetBinds) {
      prune_ = true;
      nodes_.clear();
      cut_.culled = 0;
      visit(0);
      decision = decideCut(nodes_, prices(), budgets());
    }
    cut_.loss = decision.loss;
    cut_.lossBound = decision.bound - (decision.cost - decision.loss);
    collect(decision.drawn);
    return std::move(cut_);
  }

 private:
  // Nodes front to back, each followed by those below it. Returns whether a leaf that hides others is among them: it
  // stays as it is, and nothing above it is drawn.
  bool visit(uint32_t index) {
    const CellRecord& cell = directory_.cells[index];
    if (cell.content.empty()) return false;
    if (settings_.mode != RenderMode::full && outside(view_, cell.content)) {
      ++cut_.culled;
      return false;
    }
    bool needed = prune_ && hidden_->needs(index);
    const size_t place = nodes_.size();
    const bool views = mayHaveViews() && cell.firstViewPage != kNone && (cell.childCount == 0 || isOutside(cell));
    const bool far = views && isOutside(cell) && texelPixels(cell) <= settings_.texelPixels;
    const bool weighs = far && weighsOtherWays(cell);
    nodes_.push_back({.cell = index, .open = cell.childCount > 0 && (!far || weighs)});
    if (prune_ && !needed && hidden_->hides(index)) {
      nodes_[place].end = static_cast<uint32_t>(nodes_.size());
      nodes_[place].mesh = nodes_[place].views = {.loss = 0, .amounts = {}};
      return false;
    }
    if (nodes_[place].open) needed |= visitChildren(cell);
    CutNode& node = nodes_[place];
    node.end = static_cast<uint32_t>(nodes_.size());
    node.areaPixels = node.open ? areaBelow(place) : areaPixels(cell);
    if (views && !needed && (far || !node.open || mayBeCoarse(cell))) node.views = asViews(cell, node.areaPixels);
    if (mayBeMesh(cell) && (!far || weighs) && (!needed || cell.childCount == 0))
      node.mesh = asMesh(cell, node.areaPixels);
    return needed;
  }

  // Meshes alone: the fewest triangles.
  Amounts prices() const {
    Amounts prices{};
    if (settings_.mode != RenderMode::automatic)
      at(prices, Resource::triangles) = 1;
    else if (settings_.timeBudgetMs == 0)
      at(prices, Resource::milliseconds) = settings_.millisecondPrice;
    return prices;
  }
  Amounts budgets() const {
    Amounts budgets = kNoBudgets;
    if (settings_.mode != RenderMode::automatic) return budgets;
    at(budgets, Resource::triangles) = static_cast<double>(settings_.triangleBudget);
    if (settings_.timeBudgetMs > 0)
      at(budgets, Resource::milliseconds) = settings_.timeBudgetMs - settings_.costs.picturePixelMs * picturePixels_;
    if (settings_.texelBudget > 0) at(budgets, Resource::texels) = static_cast<double>(settings_.texelBudget);
    if (settings_.byteBudget > 0) at(budgets, Resource::bytes) = static_cast<double>(settings_.byteBudget);
    return budgets;
  }

  Way asViews(const CellRecord& cell, double areaBelowPixels) const {
    const double texel = texelPixels(cell);
    const double area = areaPixels(cell);
    Way way{.loss = areaBelowPixels * impostorLoss(cell, texel), .amounts = {}};
    at(way.amounts, Resource::milliseconds) = expectedMs(settings_.costs, workOf(cell, true));
    at(way.amounts, Resource::texels) = area / (texel * texel);
    if (settings_.byteBudget > 0) at(way.amounts, Resource::bytes) = viewBytes(cell);
    return way;
  }
  Way asMesh(const CellRecord& cell, double areaBelowPixels) const {
    const auto triangles = static_cast<double>(cell.meshTriangles);
    const double density = static_cast<double>(cell.triangles) / areaBelowPixels;
    const double loss =
        settings_.mode == RenderMode::automatic ? meshLoss(cell, texelPixels(cell), meshPixels(cell), density) : 0;
    Way way{.loss = areaBelowPixels * loss, .amounts = {}};
    at(way.amounts, Resource::milliseconds) = expectedMs(settings_.costs, workOf(cell, false));
    at(way.amounts, Resource::triangles) = triangles;
    if (settings_.byteBudget > 0) at(way.amounts, Resource::bytes) = meshBytes(cell);
    return way;
  }

  // Of the page of the nearest view, as far as it matters: a mean page.
  double viewBytes(const CellRecord& cell) const {
    double sum = 0;
    for (uint32_t page = 0; page < cell.viewPageCount; ++page)
      sum += directory_.pages[cell.firstViewPage + page].storedBytes;
    return cell.viewPageCount > 0 ? sum / cell.viewPageCount : 0;
  }
  double meshBytes(const CellRecord& cell) const {
    double sum = 0;
    for (uint32_t page = 0; page < cell.geometryPageCount; ++page)
      sum += directory_.pages[cell.firstGeometryPage + page].storedBytes;
    return sum;
  }

  // A ray from the eye crosses each plane between the children at most once, away from the eye's side: an octant can
  // hide another only if it differs from the eye's octant in a subset of the other's axes. Counting up in
  // (octant xor eye's octant) visits subsets first.
  bool visitChildren(const CellRecord& cell) {
    const GridBox box = cellBox(directory_.model.grid, cell.key);
    uint32_t eyeOctant = 0;
    for (int axis = 0; axis < 3; ++axis)
      if (2 * view_.eye[axis] >= static_cast<double>(box.min[axis]) + box.max[axis]) eyeOctant |= 1u << axis;
    std::array<uint32_t, 8> children;
    children.fill(kNone);
    for (uint32_t child = cell.firstChild; child < cell.firstChild + cell.childCount; ++child)
      children[directory_.cells[child].key.octant()] = child;
    bool needed = false;
    for (uint32_t i = 0; i < 8; ++i)
      if (children[i ^ eyeOctant] != kNone) needed |= visit(children[i ^ eyeOctant]);
    return needed;
  }

  bool mayHaveViews() const {
    return settings_.mode == RenderMode::automatic || settings_.mode == RenderMode::impostors;
  }
  bool mayBeMesh(const CellRecord& cell) const {
    if (cell.childCount == 0) return settings_.mode != RenderMode::impostors || cell.firstViewPage == kNone;
    const bool wanted = settings_.mode == RenderMode::automatic || settings_.mode == RenderMode::meshes;
    return wanted && settings_.meshPixels > 0 && cell.firstGeometryPage != kNone &&
           meshPixels(cell) <= settings_.meshPixels;
  }

  bool isOutside(const CellRecord& cell) const {
    const GridBox cube = cellBox(directory_.model.grid, cell.key);
    const double halfSide = (cube.max.x - cube.min.x) * 0.5;
    return glm::length(view_.eye - glm::dvec3(cube.min + cube.max) * 0.5) > std::sqrt(3.0) * halfSide;
  }
  bool mayBeCoarse(const CellRecord& cell) const {
    const bool isShort = settings_.timeBudgetMs > 0 || settings_.texelBudget > 0 || settings_.byteBudget > 0;
    return settings_.mode == RenderMode::automatic && isShort && texelPixels(cell) <= kCoarsest * settings_.texelPixels;
  }

  // Of a cell that is far enough for its views: with measured errors its mesh and, until its texels are half as large
  // as they may be, those below it are weighed against them.
  bool weighsOtherWays(const CellRecord& cell) const {
    return settings_.mode == RenderMode::automatic && cell.errors.knows(ErrorWay::depthCorrected) &&
           texelPixels(cell) > settings_.texelPixels / 2;
  }

  // What a convex body of the box's size covers, mean over directions: a quarter of its surface (Cauchy).
  double areaPixels(const CellRecord& cell) const {
    const glm::dvec3 size =
        glm::dvec3(cell.content.max - cell.content.min) / (distanceSteps(view_.eye, cell.content) * view_.pixelAngle);
    const double area = (size.x * size.y + size.y * size.z + size.z * size.x) / 2;
    return area < picturePixels_ ? area : picturePixels_;  // also where the eye is in the box
  }
  double areaBelow(size_t place) const {
    double area = 0;
    for (size_t child = place + 1; child < nodes_[place].end; child = nodes_[child].end)
      area += nodes_[child].areaPixels;
    return area;
  }

  // Edge of a texel of the cell's views, and geometric error of its mesh.
  double texelPixels(const CellRecord& cell) const {
    const double halfSide = std::ldexp(0.5, directory_.model.grid.bits - static_cast<int>(cell.key.level));
    return texelSize(cell.form.imageSize) * halfSide / (distanceSteps(view_.eye, cell.content) * view_.pixelAngle);
  }
  double meshPixels(const CellRecord& cell) const {
    if (cell.geometricError == 0) return 0;  // all leaves
    const double errorSteps = cell.geometricError / directory_.model.grid.step();
    return errorSteps / (distanceSteps(view_.eye, cell.content) * view_.pixelAngle);
  }

  void collect(const std::vector<Drawn>& drawn) {
    cut_.work.picturePixels = picturePixels_;
    for (size_t i = 0; i < nodes_.size();) {
      if (drawn[i] == Drawn::byChildren) {
        ++i;
        continue;
      }
      const bool views = drawn[i] == Drawn::asViews;
      const CellRecord& cell = directory_.cells[nodes_[i].cell];
      cut_.nearestSteps = std::min(cut_.nearestSteps, distanceSteps(view_.eye, cell.content));
      if (hidden_ != nullptr && !hidden_->needs(nodes_[i].cell) && hidden_->hides(nodes_[i].cell))
        leaveOut(cell, views);
      else if (views)
        addImpostor(nodes_[i].cell);
      else
        addMesh(nodes_[i].cell);
      i = nodes_[i].end;
    }
    cut_.triangles = static_cast<uint64_t>(cut_.work.triangles);
  }

  FrameWork workOf(const CellRecord& cell, bool views) const {
    const double area = areaPixels(cell);
    if (views) return {.impostors = 1, .impostorPixels = area};
    return {.triangles = static_cast<double>(cell.meshTriangles), .meshPixels = area};
  }
  void leaveOut(const CellRecord& cell, bool views) {
    ++cut_.hidden.cells;
    cut_.hidden.work += workOf(cell, views);
    cut_.hidden.storedBytes += static_cast<uint64_t>(views ? viewBytes(cell) : meshBytes(cell));
  }
  void addImpostor(uint32_t index) {
    const GridBox& content = directory_.cells[index].content;
    glm::dvec3 direction = view_.eye - glm::dvec3(content.min + content.max) * 0.5;
    if (direction == glm::dvec3(0)) direction = back_;
    const Viewpoints& viewpoints = Viewpoints::of(directory_.cells[index].form.views);
    const auto [nearest, second] = nearestTwo(viewpoints, glm::normalize(direction));
    const Viewpoints::Triple blend = viewpoints.hasTriangles()
                                         ? viewpoints.nearestThree(direction)
                                         : Viewpoints::Triple{{nearest, second, second}, {1, 0, 0}};
    cut_.entries.push_back({index, Representation::impostor, static_cast<uint32_t>(nearest),
                            static_cast<uint32_t>(second), blend, texelPixels(directory_.cells[index])});
    cut_.work += workOf(directory_.cells[index], true);
  }
  // The nearest to the direction as it leans; then the nearest other one, as it is.
  std::array<int, 2> nearestTwo(const Viewpoints& viewpoints, glm::dvec3 direction) const {
    const auto [nearest, second] = viewpoints.nearestTwo(direction);
    const int leaning = viewpoints.nearest(direction + settings_.lean);
    return {leaning, leaning == nearest ? second : nearest};
  }
  void addMesh(uint32_t index) {
    const CellRecord& cell = directory_.cells[index];
    const bool leaf = cell.childCount == 0;
    cut_.entries.push_back({.cell = index,
                            .representation = leaf ? Representation::triangles : Representation::mesh,
                            .errorPixels = meshPixels(cell)});
    cut_.work += workOf(cell, false);
  }

  const Directory& directory_;
  const glm::dvec3 back_;
  const View view_;
  const SelectionSettings settings_;
  const HiddenCells* const hidden_;
  bool prune_ = false;
  const double picturePixels_;
  std::vector<CutNode> nodes_;
  Cut cut_;
};

}  // namespace

Cut selectCut(const Directory& directory, const Camera& camera, int width, int height,
              const SelectionSettings& settings, const HiddenCells* hidden) {
  const View view = makeView(directory.model.grid, camera, width, height, settings.detail);
  return Selector(directory, camera, view, width, height, settings, hidden).run();
}

}  // namespace farcell
