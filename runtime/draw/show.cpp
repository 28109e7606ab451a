#include "runtime/draw/show.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace farcell {
namespace {

using Colour = std::array<uint8_t, 3>;

// Told apart by all eyes (Okabe, Ito, Color Universal Design, 2008).
constexpr Colour kTriangles = {230, 159, 0};
constexpr Colour kMesh = {86, 180, 233};
constexpr Colour kFlat = {204, 121, 167};
constexpr Colour kDepthCorrected = {0, 158, 115};
constexpr Colour kBlended = {0, 114, 178};

// By level; neighbours differ in hue and brightness.
constexpr std::array<Colour, kMaxLevel + 1> kLevels = {{{120, 120, 120},
                                                        {230, 80, 60},
                                                        {250, 170, 50},
                                                        {245, 230, 70},
                                                        {110, 190, 60},
                                                        {40, 150, 120},
                                                        {90, 200, 230},
                                                        {60, 110, 220},
                                                        {140, 80, 200},
                                                        {225, 110, 200},
                                                        {160, 90, 50},
                                                        {215, 180, 140},
                                                        {150, 150, 40},
                                                        {30, 100, 60},
                                                        {180, 220, 250},
                                                        {240, 240, 240}}};

// From no error to the most a legend names.
constexpr std::array<Colour, 5> kHeat = {{{70, 90, 220}, {60, 190, 230}, {90, 200, 90}, {250, 210, 50}, {220, 40, 30}}};
constexpr double kHeatTop = 4;  // times what selection allows

constexpr size_t kDepthMarks = 5;
constexpr double kLeastDepth = 1.0 / (1 << 20);  // root sides: the nearest that is drawn

Colour heatColour(double share) {
  const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(kHeat.size() - 1);
  const size_t low = std::min(static_cast<size_t>(at), kHeat.size() - 2);
  Colour colour;
  for (size_t i = 0; i < 3; ++i)
    colour[i] = static_cast<uint8_t>(std::lerp(kHeat[low][i], kHeat[low + 1][i], at - static_cast<double>(low)) + 0.5);
  return colour;
}

const char* nameOf(Representation representation, ImpostorKind kind) {
  if (representation == Representation::triangles) return "triangles";
  if (representation == Representation::mesh) return "simplified mesh";
  if (kind == ImpostorKind::flat) return "flat impostor";
  return kind == ImpostorKind::blended ? "impostor of kind B" : "impostor of kind A";
}

void planKinds(ShowPlan& plan, const Cut& cut, ImpostorKind kind) {
  for (const CutEntry& entry : cut.entries) {
    const Colour colour = lineColour(entry.representation, kind);
    plan.tints.push_back({colour[0], colour[1], colour[2], 255});
  }
  for (const Representation representation :
       {Representation::triangles, Representation::mesh, Representation::impostor})
    plan.legend.push_back({nameOf(representation, kind), lineColour(representation, kind)});
}

void planLevels(ShowPlan& plan, const Directory& directory, const Cut& cut) {
  std::array<bool, kMaxLevel + 1> drawn{};
  for (const CutEntry& entry : cut.entries) {
    const uint32_t level = directory.cells[entry.cell].key.level;
    const Colour& colour = kLevels[level];
    plan.tints.push_back({colour[0], colour[1], colour[2], 255});
    drawn[level] = true;
  }
  for (size_t level = 0; level < drawn.size(); ++level)
    if (drawn[level]) plan.legend.push_back({fmt::format("level {}", level), kLevels[level]});
}

void planError(ShowPlan& plan, const Cut& cut, double allowedTexelPixels) {
  const double topPixels = kHeatTop * allowedTexelPixels;
  for (const CutEntry& entry : cut.entries) {
    const Colour colour = heatColour(entry.errorPixels / topPixels);
    plan.tints.push_back({colour[0], colour[1], colour[2], 255});
  }
  for (size_t i = 0; i < kHeat.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(kHeat.size() - 1);
    plan.legend.push_back(
        {fmt::format("{:.3g} px{}", share * topPixels, i + 1 == kHeat.size() ? " or more" : ""), heatColour(share)});
  }
}

// Depths of the corners of what is drawn, along the view axis.
void planDepth(ShowPlan& plan, const Directory& directory, const Cut& cut, const FrameCamera& camera) {
  double nearest = INFINITY, farthest = 0;
  const glm::dvec3 axis(camera.uniforms.clipW.x, camera.uniforms.clipW.y, camera.uniforms.clipW.z);
  for (const CutEntry& entry : cut.entries) {
    const GridBox& box = directory.cells[entry.cell].content;
    for (int i = 0; i < 8; ++i) {
      const glm::dvec3 corner(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y,
                              i & 4 ? box.max.z : box.min.z);
      const double depth = glm::dot(axis, corner - camera.eyeSteps);
      nearest = std::min(nearest, depth);
      farthest = std::max(farthest, depth);
    }
  }
  nearest = std::max({kLeastDepth, nearest, static_cast<double>(camera.uniforms.eyeFraction.w)});
  farthest = std::max(farthest, nearest * 1.001);
  const double octaves = std::log2(farthest / nearest);
  plan.depthScale = glm::vec4(static_cast<float>(std::log2(nearest)), static_cast<float>(1 / octaves), 0.0f, 0.0f);
  for (size_t i = 0; i < kDepthMarks; ++i) {
    const double share = static_cast<double>(i) / (kDepthMarks - 1);
    const auto grey = static_cast<uint8_t>(255 * (1 - share) + 0.5);
    plan.legend.push_back(
        {fmt::format("{:.6g} model units", nearest * std::exp2(share * octaves) * directory.model.grid.side),
         {grey, grey, grey}});
  }
}

void planNormals(ShowPlan& plan) {
  for (size_t axis = 0; axis < 3; ++axis)
    for (const bool positive : {true, false}) {
      Colour colour = {128, 128, 128};
      colour[axis] = positive ? 255 : 0;
      plan.legend.push_back({fmt::format("{}{}", positive ? '+' : '-', "xyz"[axis]), colour});
    }
}

}  // namespace

Look lookOf(Show show) {
  switch (show) {
    case Show::levels:
    case Show::kinds:
    case Show::error:
      return Look::tint;
    case Show::depth:
      return Look::depth;
    case Show::normals:
      return Look::normals;
    case Show::picture:
    case Show::cells:
    case Show::billboards:
      break;
  }
  return Look::picture;
}

ShowPlan planShow(Show show, const Directory& directory, const Cut& cut, const FrameCamera& camera, ImpostorKind kind,
                  double allowedTexelPixels) {
  ShowPlan plan{.show = show, .look = lookOf(show), .tints = {}, .legend = {}};
  switch (show) {
    case Show::picture:
      break;
    case Show::cells:
      planKinds(plan, cut, kind);
      plan.tints.clear();
      break;
    case Show::billboards:
      plan.legend.push_back({kind == ImpostorKind::flat ? "flat impostor" : "first view of an impostor",
                             lineColour(Representation::impostor, kind)});
      break;
    case Show::levels:
      planLevels(plan, directory, cut);
      break;
    case Show::kinds:
      planKinds(plan, cut, kind);
      break;
    case Show::error:
      planError(plan, cut, allowedTexelPixels);
      break;
    case Show::depth:
      planDepth(plan, directory, cut, camera);
      break;
    case Show::normals:
      planNormals(plan);
      break;
  }
  return plan;
}

std::array<uint8_t, 3> lineColour(Representation representation, ImpostorKind kind) {
  if (representation == Representation::triangles) return kTriangles;
  if (representation == Representation::mesh) return kMesh;
  if (kind == ImpostorKind::flat) return kFlat;
  return kind == ImpostorKind::blended ? kBlended : kDepthCorrected;
}

}  // namespace farcell
