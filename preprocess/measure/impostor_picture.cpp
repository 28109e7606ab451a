#include "preprocess/measure/impostor_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <type_traits>

#include "cache/base/check.h"
#include "cache/pack/view_mips.h"
#include "cache/schema/view_frame.h"
#include "shaders/shared/shading.h"

FARCELL_SHARED_BEGIN

// The surroundings of the shader's text. `lod`: of all rays, as the distance to the eye is.
template <int VIEWS>
class Look {
 public:
  std::array<const ViewTexels*, VIEWS> images{};
  float lod = 0;
  vec3 light{};
  vec4 eye{};
  vec3 boxMin{}, boxMax{};
  std::array<vec4, VIEWS> viewEye{}, viewMin{}, viewMax{};

  float depthValue(vec2 texel, float layer) const {
    const ViewTexels& image = *images[static_cast<size_t>(layer)];
    if (image.depths.empty()) return 0;
    const int last = image.imageSize - 1;
    const int x = std::clamp(static_cast<int>(std::floor(texel.x)), 0, last);
    const int y = std::clamp(static_cast<int>(std::floor(texel.y)), 0, last);
    return image.depths[static_cast<size_t>(y) * static_cast<size_t>(image.imageSize) + static_cast<size_t>(x)];
  }

  vec4 colourAt(vec2 texel, float layer, float) const {
    const ViewTexels& image = *images[static_cast<size_t>(layer)];
    if (image.colours.empty()) return vec4(0.0f);
    const float coarsest = static_cast<float>(image.colours.size() - 1);
    const float level = std::clamp(lod, 0.0f, coarsest);
    const auto finer = static_cast<size_t>(level);
    const float part = level - static_cast<float>(finer);
    const auto filtered = [&](const auto& mips) {
      const vec4 value = bilinear(mips, finer, image.imageSize, texel);
      return part > 0 ? value + part * (bilinear(mips, finer + 1, image.imageSize, texel) - value) : value;
    };
    const vec4 colour = filtered(image.colours);
    return image.normals.empty() ? colour : relit(colour, vec3(filtered(image.normals)), light);
  }

#include "shaders/shared/look.h"

 private:
  // Outside the image everything is transparent.
  template <class Mips>
  static vec4 bilinear(const Mips& mips, size_t level, int imageSize, vec2 texel) {
    const int edge = imageSize >> level;
    const float scale = 1.0f / static_cast<float>(1 << level);
    const float x = texel.x * scale - 0.5f, y = texel.y * scale - 0.5f;
    const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
    const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
    const auto& texels = mips[level];
    const auto at = [&](int column, int row) {
      if (column < 0 || row < 0 || column >= edge || row >= edge) return vec4(0.0f);
      const auto* t = texels.data() + 4 * (static_cast<size_t>(row) * static_cast<size_t>(edge) + column);
      return vec4(t[0], t[1], t[2], t[3]) * (1.0f / std::numeric_limits<std::remove_cvref_t<decltype(*t)>>::max());
    };
    const vec4 low = at(x0, y0) * (1 - fx) + at(x0 + 1, y0) * fx;
    const vec4 high = at(x0, y0 + 1) * (1 - fx) + at(x0 + 1, y0 + 1) * fx;
    return low * (1 - fy) + high * fy;
  }
};

FARCELL_SHARED_END

namespace farcell {
namespace {

// A ray's points s = 0 and s = -1 lie so far behind and before the centre: outside every box.
constexpr double kReach = 2;
// Where the object's outline differs from the view's, no texel knows how much of the pixel it covers: rays do. These
// are where the renderer's four samples of a pixel lie.
constexpr std::array<glm::vec2, 4> kRayOffsets = {glm::vec2(-0.125f, -0.375f), glm::vec2(0.375f, -0.125f),
                                                  glm::vec2(0.125f, 0.375f), glm::vec2(-0.375f, 0.125f)};

template <int VIEWS>
class Painter {
 public:
  Painter(const LocalBox& content, std::span<const WeightedView> views, glm::dvec3 toward, glm::vec3 light, int edge)
      : frame_(viewFrame(toward)), pixel_(2 * kViewHalfExtent / edge), edge_(edge) {
    const double texel = texelSize(views[0].texels->imageSize);
    const float pad = static_cast<float>(texel) * shared::kBoxPadTexels;
    look_.light = light;
    look_.boxMin = content.min;
    look_.boxMax = content.max;
    for (int axis = 0; axis < 3; ++axis) {  // not towards the eye, as in impostor.vert
      if (toward[axis] >= 0) look_.boxMin[axis] -= pad;
      if (toward[axis] <= 0) look_.boxMax[axis] += pad;
    }
    look_.lod = static_cast<float>(std::log2(pixel_ / texel) - std::log2(static_cast<double>(kRayOffsets.size())) / 2) +
                shared::kLodBias;
    for (size_t i = 0; i < VIEWS; ++i) {
      const ViewTexels& texels = *views[i].texels;
      ResidentView resident = texels.view;
      if (resident.layer >= 0) resident.layer = static_cast<int>(i);
      look_.images[i] = &texels;
      views_[i] = impostorView(resident, texels.direction, views[i].weight, glm::dvec3(0), texel);
      look_.viewMin[i] = views_[i].boxMin;
      look_.viewMax[i] = views_[i].boxMax;
    }
  }

  glm::vec4 pixel(int x, int y) {
    glm::vec4 sum(0);
    for (const glm::vec2& offset : kRayOffsets)
      sum += ray(x + 0.5 + static_cast<double>(offset.x), y + 0.5 + static_cast<double>(offset.y));
    return sum * (1.0f / static_cast<float>(kRayOffsets.size()));
  }

 private:
  glm::vec4 ray(double x, double y) {
    const glm::dvec3 middle =
        frame_.right * (x * pixel_ - kViewHalfExtent) + frame_.up * (y * pixel_ - kViewHalfExtent);
    const glm::dvec3 far = middle - kReach * frame_.toward, near = middle + kReach * frame_.toward;
    const glm::vec3 local(far);
    look_.eye = glm::vec4(glm::vec3(near), 0.0f);
    const glm::vec2 inBox = look_.slab(local, local - glm::vec3(near), look_.boxMin, look_.boxMax);
    if (inBox.x >= inBox.y) return glm::vec4(0);
    glm::vec3 points[VIEWS];
    for (size_t i = 0; i < VIEWS; ++i) {
      points[i] = texturePoint(views_[i], far);
      look_.viewEye[i] = glm::vec4(texturePoint(views_[i], near), views_[i].eye.w);
    }
    return look_.seenOf(look_.find(local, points), points);
  }
  static glm::vec3 texturePoint(const shared::ImpostorView& view, glm::dvec3 local) {
    const auto along = [&](const glm::vec4& plane) {
      return static_cast<float>(glm::dot(glm::dvec3(plane), local) + static_cast<double>(plane.w));
    };
    return {along(view.textureX), along(view.textureY), along(view.textureZ)};
  }

  const ViewFrame frame_;
  const double pixel_;
  const int edge_;
  shared::Look<VIEWS> look_;
  std::array<shared::ImpostorView, VIEWS> views_{};
};

template <int VIEWS>
Picture painted(Painter<VIEWS> painter, int edge, int stride) {
  Picture picture(edge);
  for (int y = 0; y < edge; y += stride)
    for (int x = 0; x < edge; x += stride)
      picture.rgba[static_cast<size_t>(y) * static_cast<size_t>(edge) + static_cast<size_t>(x)] = painter.pixel(x, y);
  return picture;
}

}  // namespace

ViewTexels::ViewTexels(const ViewImage& image, glm::dvec3 from, int size)
    : imageSize(size), view(residentView(image, 0)), direction(from) {
  if (view.layer < 0) return;
  colours = buildColourMips(image, size);
  if (!image.normal.empty()) normals = buildNormalMips(image, size);
  depths = buildDepthImage(image, size);
}

Picture impostorPicture(const LocalBox& content, std::span<const WeightedView> views, glm::dvec3 toward,
                        glm::vec3 light, int edge, int stride) {
  FARCELL_CHECK(views.size() == 2 || views.size() == 3);
  if (views.size() == 2) return painted(Painter<2>(content, views, toward, light, edge), edge, stride);
  return painted(Painter<3>(content, views, toward, light, edge), edge, stride);
}

}  // namespace farcell
