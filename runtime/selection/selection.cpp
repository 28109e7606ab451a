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

constexpr double kNever = std::numeric_limits<double>::infinity();

// The budget is met by raising the price of a triangle: at this one none is worth it, whatever the size of a picture.
constexpr double kHighestPrice = 1e12;
constexpr double kPriceFactor = 16;
constexpr int kPriceSteps = 20;  // halvings of the logarithm between two prices

// A cell in view that no cell above it stands for as an impostor. Losses: of each way to draw it (selection.h), without
// the price of its triangles; kNever: it is not drawn so.
struct Node {
  uint32_t cell;
  uint32_t end = 0;   // index after the last node below it
  bool open = false;  // those below it may be drawn instead
  double areaPixels = 0;
  double viewLoss = kNever;
  double meshLoss = kNever;
  // As `drawn` says, with all below it.
  enum class Drawn : uint8_t { asViews, asMesh, byChildren } drawn = Drawn::byChildren;
  double cost = 0;  // loss and the price of triangles
  uint64_t triangles = 0;
};

class Selector {
 public:
  Selector(const Directory& directory, const Viewpoints& viewpoints, const Camera& camera, const View& view, int width,
           int height, const SelectionSettings& settings)
      : directory_(directory),
        viewpoints_(viewpoints),
        back_(cameraAxes(camera).back),
        view_(view),
        settings_(settings),
        imageTexel_(texelSize(directory.model.settings.imageSize)),
        picturePixels_(static_cast<double>(width) * height * settings.detail * settings.detail) {}

  Cut run() {
    if (!directory_.cells.empty()) visit(0);
    decideWithinBudget();
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
    const bool views = mayHaveViews() && cell.firstViewPage != kNone;
    const bool far = views && farEnough(cell);
    nodes_.push_back({.cell = index, .open = cell.childCount > 0 && !far});
    if (nodes_[place].open) visitChildren(cell);
    Node& node = nodes_[place];
    node.end = static_cast<uint32_t>(nodes_.size());
    node.areaPixels = node.open ? areaBelow(place) : areaPixels(cell);
    if (views && !node.open) node.viewLoss = node.areaPixels * impostorLoss(texelPixels(cell));
    if (mayBeMesh(cell) && !far)
      node.meshLoss = settings_.mode == RenderMode::automatic ? node.areaPixels * meshLoss(meshPixels(cell)) : 0;
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

  bool mayHaveViews() const {
    return settings_.mode == RenderMode::automatic || settings_.mode == RenderMode::impostors;
  }
  bool mayBeMesh(const CellRecord& cell) const {
    if (cell.childCount == 0) return settings_.mode != RenderMode::impostors || cell.firstViewPage == kNone;
    const bool wanted = settings_.mode == RenderMode::automatic || settings_.mode == RenderMode::meshes;
    return wanted && settings_.meshPixels > 0 && cell.firstGeometryPage != kNone &&
           meshPixels(cell) <= settings_.meshPixels;
  }

  bool farEnough(const CellRecord& cell) const {
    const GridBox cube = cellBox(directory_.model.grid, cell.key);
    const double halfSide = (cube.max.x - cube.min.x) * 0.5;
    if (glm::length(view_.eye - glm::dvec3(cube.min + cube.max) * 0.5) <= std::sqrt(3.0) * halfSide) return false;
    return texelPixels(cell) <= settings_.texelPixels;
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
    return imageTexel_ * halfSide / (distanceSteps(view_.eye, cell.content) * view_.pixelAngle);
  }
  double meshPixels(const CellRecord& cell) const {
    if (cell.geometricError == 0) return 0;  // all leaves
    const double errorSteps = cell.geometricError / directory_.model.grid.step();
    return errorSteps / (distanceSteps(view_.eye, cell.content) * view_.pixelAngle);
  }

  // The cut of the least loss where a triangle has this price; returns its triangles. A higher price never gives more.
  uint64_t decide(double price) {
    for (size_t i = nodes_.size(); i-- > 0;) {
      Node& node = nodes_[i];
      node.drawn = Node::Drawn::byChildren;
      node.cost = node.open ? 0 : kNever;
      node.triangles = 0;
      for (size_t child = i + 1; child < node.end; child = nodes_[child].end) {
        node.cost += nodes_[child].cost;
        node.triangles += nodes_[child].triangles;
      }
      const uint64_t triangles = directory_.cells[node.cell].meshTriangles;
      const double meshCost = node.meshLoss + price * static_cast<double>(triangles);
      if (meshCost < node.cost) {
        node.drawn = Node::Drawn::asMesh;
        node.cost = meshCost;
        node.triangles = triangles;
      }
      if (node.viewLoss < node.cost) {
        node.drawn = Node::Drawn::asViews;
        node.cost = node.viewLoss;
        node.triangles = 0;
      }
    }
    return nodes_.empty() ? 0 : nodes_[0].triangles;
  }

  void decideWithinBudget() {
    double low = kTrianglePrice;
    if (decide(low) <= settings_.triangleBudget || settings_.mode != RenderMode::automatic) return;
    double high = low * kPriceFactor;
    while (high < kHighestPrice && decide(high) > settings_.triangleBudget) {
      low = high;
      high *= kPriceFactor;
    }
    for (int step = 0; step < kPriceSteps; ++step) {
      const double middle = std::sqrt(low * high);
      (decide(middle) > settings_.triangleBudget ? low : high) = middle;
    }
    decide(high);
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
    const auto [nearest, second] = nearestTwo(glm::normalize(direction));
    const Viewpoints::Triple blend = viewpoints_.hasTriangles()
                                         ? viewpoints_.nearestThree(direction)
                                         : Viewpoints::Triple{{nearest, second, second}, {1, 0, 0}};
    cut_.entries.push_back({index, Representation::impostor, static_cast<uint32_t>(nearest),
                            static_cast<uint32_t>(second), blend, texelPixels(directory_.cells[index])});
  }
  // The nearest to the direction as it leans; then the nearest other one, as it is.
  std::array<int, 2> nearestTwo(glm::dvec3 direction) const {
    const auto [nearest, second] = viewpoints_.nearestTwo(direction);
    const int leaning = viewpoints_.nearest(direction + settings_.lean);
    return {leaning, leaning == nearest ? second : nearest};
  }
  void addMesh(uint32_t index) {
    const CellRecord& cell = directory_.cells[index];
    const bool leaf = cell.childCount == 0;
    cut_.entries.push_back({.cell = index,
                            .representation = leaf ? Representation::triangles : Representation::mesh,
                            .errorPixels = meshPixels(cell)});
    cut_.triangles += cell.meshTriangles;
  }

  const Directory& directory_;
  const Viewpoints& viewpoints_;
  const glm::dvec3 back_;
  const View view_;
  const SelectionSettings settings_;
  const double imageTexel_;
  const double picturePixels_;
  std::vector<Node> nodes_;
  Cut cut_;
};

}  // namespace

double impostorLoss(double texelPixels) {
  return std::min(0.1 + 0.4 * texelPixels, 4.0) + kTrianglePrice * kTrianglesPerPixel;
}
double meshLoss(double errorPixels) { return 0.4 + 0.25 * errorPixels; }

Cut selectCut(const Directory& directory, const Viewpoints& viewpoints, const Camera& camera, int width, int height,
              const SelectionSettings& settings) {
  const View view = makeView(directory.model.grid, camera, width, height, settings.detail);
  return Selector(directory, viewpoints, camera, view, width, height, settings).run();
}

}  // namespace farcell
