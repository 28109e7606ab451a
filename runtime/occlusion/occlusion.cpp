#include "runtime/occlusion/occlusion.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "cache/schema/view_frame.h"

namespace farcell {
namespace {

constexpr size_t kKeptLeaves = 512;  // at most 304 KB each
constexpr size_t kMostLeaves = 64;   // of a frame
constexpr uint64_t kMostTriangles = 32768;
constexpr double kLeastAreaPx = 4;  // of a triangle, seen from the front
constexpr double kMarginPx = 2;
constexpr double kImpostorTexels = 1;                // that a filter reaches beyond the content
constexpr double kMeshErrors = 1.25;                 // that a simplified mesh may reach beyond it; measured at samples
constexpr double kDepthMargin = 1e-4;                // of a depth
constexpr double kNearRootSides = 1.01 / (1 << 20);  // the renderer's least near distance

// Of one core (tests/bench/occlusion/results.md).
constexpr double kTriangleMs = 3e-4;
constexpr double kTileMs = 1e-4;
constexpr double kCellMs = 1e-3;

double distanceSteps(glm::dvec3 eye, const GridBox& box) {
  return glm::length(eye - glm::clamp(eye, glm::dvec3(box.min), glm::dvec3(box.max)));
}

}  // namespace

Result<std::span<const Occluder>> OccluderCache::of(uint32_t leaf, uint64_t& bytesRead) {
  auto found = kept_.find(leaf);
  if (found == kept_.end()) {
    FARCELL_ASSIGN(std::vector<Occluder> occluders, readOccluders(pack_, leaf));
    const CellRecord& cell = pack_.directory().cells[leaf];
    for (uint32_t part = 0; part < cell.geometryPageCount; ++part)
      bytesRead += pack_.directory().pages[cell.firstGeometryPage + part].storedBytes;
    if (kept_.size() >= kKeptLeaves)
      kept_.erase(std::min_element(kept_.begin(), kept_.end(),
                                   [](const auto& a, const auto& b) { return a.second.lastUse < b.second.lastUse; }));
    found = kept_.emplace(leaf, Kept{std::move(occluders), 0}).first;
  }
  found->second.lastUse = ++clock_;
  return std::span<const Occluder>(found->second.occluders);
}

Occlusion::Occlusion(const Directory& directory, const Camera& camera, const OcclusionView& view)
    : directory_(directory),
      eye_((camera.position - directory.model.grid.origin) / directory.model.grid.step()),
      axes_(cameraAxes(camera)),
      focalPx_(view.height / (2 * std::tan(camera.fovYRad / 2))),
      centrePx_(glm::dvec2(view.width, view.height) * 0.5 + view.jitterPx),
      near_(std::ldexp(kNearRootSides, directory.model.grid.bits)),
      tiles_(view.width, view.height, view.samples) {}

Result<Occlusion> Occlusion::of(const Directory& directory, const Camera& camera, const OcclusionView& view,
                                const Cut& cut, OccluderCache& cache, uint64_t& bytesRead) {
  Occlusion occlusion(directory, camera, view);
  for (const CutEntry& entry : cut.entries) {
    if (occlusion.leaves_.size() >= kMostLeaves || occlusion.triangles_ >= kMostTriangles) break;
    const bool whole = entry.representation == Representation::triangles && entry.shares == kAllShares;
    if (!whole || occlusion.hides(entry.cell)) continue;
    FARCELL_ASSIGN(const std::span<const Occluder> occluders, cache.of(entry.cell, bytesRead));
    occlusion.add(entry.cell, occluders);
  }
  std::sort(occlusion.leaves_.begin(), occlusion.leaves_.end());
  return occlusion;
}

void Occlusion::add(uint32_t leaf, std::span<const Occluder> occluders) {
  const uint64_t before = triangles_;
  const double distance = std::max(distanceSteps(eye_, directory_.cells[leaf].content), near_);
  const double leastArea = kLeastAreaPx * distance * distance / (focalPx_ * focalPx_);
  for (const Occluder& occluder : occluders) {
    if (static_cast<double>(occluder.area) < leastArea) break;
    add(occluder);
  }
  if (triangles_ > before) leaves_.push_back(leaf);
}

// Cut at the near plane: a triangle, or two.
void Occlusion::add(const Occluder& occluder) {
  std::array<glm::dvec3, 4> kept;
  std::array<bool, 4> keptInner{};  // of the edge to the next; that along the near plane is not
  size_t count = 0;
  std::array<glm::dvec3, 3> corners;
  for (size_t i = 0; i < 3; ++i) corners[i] = cameraSpace(glm::dvec3(occluder.corners[i]));
  for (size_t i = 0; i < 3; ++i) {
    const glm::dvec3 &a = corners[i], &b = corners[(i + 1) % 3];
    const bool isInner = inner(a, b, corners[(i + 2) % 3], cameraSpace(glm::dvec3(occluder.across[i])));
    if (a.z >= near_) {
      keptInner[count] = isInner;
      kept[count++] = screen(a);
    }
    if ((a.z < near_) != (b.z < near_)) {
      glm::dvec3 cut = a + (b - a) * ((near_ - a.z) / (b.z - a.z));
      cut.z = near_;
      keptInner[count] = isInner && a.z < near_;
      kept[count++] = screen(cut);
    }
  }
  if (count < 3) return;
  ++triangles_;
  for (size_t i = 2; i < count; ++i)
    tiles_.add({kept[0], kept[i - 1], kept[i]},
               {keptInner[0] || i > 2, keptInner[i - 1], keptInner[i] || i + 1 < count});
}

// By the plane through the eye and the edge; a neighbour that snapping could flatten or turn over does not count.
bool Occlusion::inner(glm::dvec3 a, glm::dvec3 b, glm::dvec3 own, glm::dvec3 across) const {
  if (across.z < near_) return false;
  const glm::dvec3 normal = glm::cross(a, b);
  const double beyond = glm::dot(normal, across) * (glm::dot(normal, own) > 0 ? -1 : 1);
  return beyond * focalPx_ > kSnapPixels * across.z * std::hypot(normal.x, normal.y);
}

bool Occlusion::hides(uint32_t index) const {
  const CellRecord& cell = directory_.cells[index];
  const Model& model = directory_.model;
  const double halfSide = std::ldexp(0.5, model.grid.bits - static_cast<int>(cell.key.level));
  const double viewPad = cell.firstViewPage == kNone ? 0 : kImpostorTexels * texelSize(cell.form.imageSize) * halfSide;
  const double pad = std::max(viewPad, kMeshErrors * cell.geometricError / model.grid.step());
  glm::dvec2 min(INFINITY), max(-INFINITY);
  double nearest = 0;
  for (int corner = 0; corner < 8; ++corner) {
    glm::dvec3 steps;
    for (int axis = 0; axis < 3; ++axis)
      steps[axis] = corner >> axis & 1 ? cell.content.max[axis] + pad : cell.content.min[axis] - pad;
    const glm::dvec3 at = cameraSpace(steps);
    if (at.z < near_) return false;
    const glm::dvec3 pixel = screen(at);
    min = glm::min(min, glm::dvec2(pixel.x, pixel.y));
    max = glm::max(max, glm::dvec2(pixel.x, pixel.y));
    nearest = std::max(nearest, pixel.z);
  }
  return tiles_.covers(min - kMarginPx, max + kMarginPx, nearest * (1 + kDepthMargin));
}

double Occlusion::expectedMs(size_t cells) const {
  return kTriangleMs * static_cast<double>(triangles_) + kTileMs * static_cast<double>(tilesTouched()) +
         kCellMs * static_cast<double>(cells);
}

bool Occlusion::needs(uint32_t cell) const { return std::binary_search(leaves_.begin(), leaves_.end(), cell); }

glm::dvec3 Occlusion::cameraSpace(glm::dvec3 steps) const {
  const glm::dvec3 from = steps - eye_;
  return {glm::dot(from, axes_.right), glm::dot(from, axes_.up), -glm::dot(from, axes_.back)};
}

glm::dvec3 Occlusion::screen(glm::dvec3 camera) const {
  return {camera.x / camera.z * focalPx_ + centrePx_.x, camera.y / camera.z * focalPx_ + centrePx_.y, 1 / camera.z};
}

}  // namespace farcell
