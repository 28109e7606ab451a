#include "tests/bench/codec/reproject.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <span>
#include <vector>

#include "cache/base/check.h"
#include "cache/pack/encoded_view.h"
#include "cache/pack/zlib_stream.h"
#include "cache/schema/view_frame.h"

namespace farcell {
namespace {

using Bytes = std::vector<std::byte>;
using Values = std::vector<int>;  // -1: none

constexpr int kLevel = 5;
constexpr int kFilters = 5;

int filtered(int filter, int left, int up, int upLeft) {
  const std::array<int, kFilters> predictions = {0, up, left, (left + up) / 2, left + up - upLeft};
  return predictions[static_cast<size_t>(filter)];
}

// A plane to be predicted: which texels are stored, and through which coverage they are seen.
struct Plane {
  int width, height;
  Values values;
  Values alpha;
  std::vector<bool> stored;
  Values carried;
};

// Residuals by FORMAT.md, with predictions of the given way.
Bytes residualsOf(const Plane& plane, int filter, Carried way) {
  Values counts(plane.values.size()), filterErrors(plane.values.size()), carriedErrors(plane.values.size());
  Bytes residuals;
  for (int i = 0; i < plane.width * plane.height; ++i) {
    const int x = i % plane.width, y = i / plane.width;
    const auto at = [&](const Values& values, int dx, int dy) {
      const bool inside = x + dx >= 0 && x + dx < plane.width && y + dy >= 0;
      return inside ? values[static_cast<size_t>(i + dy * plane.width + dx)] : 0;
    };
    const auto texel = static_cast<size_t>(i);
    const int own = filtered(filter, at(counts, -1, 0), at(counts, 0, -1), at(counts, -1, -1)) & 255;
    const int other = plane.carried[texel];
    const std::array<int, 3> others = {at(plane.carried, -1, 0), at(plane.carried, 0, -1), at(plane.carried, -1, -1)};
    int corrected = other;
    if (other >= 0 && *std::min_element(others.begin(), others.end()) >= 0)
      corrected = std::clamp(other + filtered(filter, at(counts, -1, 0), at(counts, 0, -1), at(counts, -1, -1)) -
                                 filtered(filter, others[0], others[1], others[2]),
                             0, 255);
    int prediction = own;
    if (way != Carried::none && other >= 0) {
      if (way == Carried::alone) prediction = other;
      if (way == Carried::corrected) prediction = corrected;
      if (way == Carried::averaged) prediction = (own + corrected) / 2;
      const auto around = [&](const Values& errors) {
        return at(errors, -1, 0) + at(errors, 0, -1) + at(errors, -1, -1) + at(errors, 1, -1);
      };
      if (way == Carried::judged && around(carriedErrors) < around(filterErrors)) prediction = corrected;
    }
    const int alpha = plane.alpha[texel], value = plane.values[texel];
    if (!plane.stored[texel]) {
      counts[texel] = prediction;
      continue;
    }
    residuals.push_back(static_cast<std::byte>(value - (prediction * alpha + 127) / 255));
    counts[texel] = std::min(255, (value * 255 + alpha / 2) / alpha);
    filterErrors[texel] = std::abs(counts[texel] - own);
    carriedErrors[texel] = other >= 0 ? std::abs(counts[texel] - corrected) : filterErrors[texel];
  }
  return residuals;
}

// The shortest of all filters once deflated.
Bytes bestResiduals(const Plane& plane, Carried way) {
  Bytes best;
  size_t bestSize = SIZE_MAX;
  for (int filter = 0; filter < kFilters; ++filter) {
    Bytes residuals = residualsOf(plane, filter, way);
    const size_t size = zlibCompress(residuals, kLevel).size();
    if (size < bestSize) best = std::move(residuals), bestSize = size;
  }
  return best;
}

// Positions in half sides of the cell of the texels of a view, and back.
class Projection {
 public:
  Projection(const ViewImage& view, const Viewpoints& viewpoints, int imageSize)
      : view_(view), frame_(viewFrame(viewpoints.directions()[view.view])), texel_(texelSize(imageSize)) {}

  size_t indexOf(int x, int y) const { return static_cast<size_t>(y) * view_.width + static_cast<size_t>(x); }
  bool contains(int x, int y) const {
    return x >= 0 && y >= 0 && x < static_cast<int>(view_.width) && y < static_cast<int>(view_.height);
  }
  double step() const { return (view_.depthMax - view_.depthMin) / 254; }
  glm::dvec3 position(int x, int y) const {
    const double u = (view_.x0 + x + 0.5) * texel_ - kViewHalfExtent,
                 v = (view_.y0 + y + 0.5) * texel_ - kViewHalfExtent;
    const double w = view_.depthMin + (view_.depth[indexOf(x, y)] - 1) * step();
    return u * frame_.right + v * frame_.up + w * frame_.toward;
  }
  // Texel of the rectangle and w; the texel may lie outside.
  glm::dvec3 texelOf(glm::dvec3 p) const {
    return {(glm::dot(p, frame_.right) + kViewHalfExtent) / texel_ - view_.x0,
            (glm::dot(p, frame_.up) + kViewHalfExtent) / texel_ - view_.y0, glm::dot(p, frame_.toward)};
  }
  double texelEdge() const { return texel_; }

 private:
  const ViewImage& view_;
  const ViewFrame frame_;
  const double texel_;
};

// Green of the neighbour where the view's own depth, which is read first, says that it shows the same point.
Values carriedGreen(const ViewImage& view, const ViewImage& neighbour, const Projection& here,
                    const Projection& there) {
  Values carried(view.depth.size(), -1);
  for (int i = 0; i < static_cast<int>(carried.size()); ++i) {
    const int x = i % static_cast<int>(view.width), y = i / static_cast<int>(view.width);
    const auto texel = static_cast<size_t>(i);
    if (view.depth[texel] == 0 || view.rgba[4 * texel + 3] < 255) continue;
    const glm::dvec3 p = there.texelOf(here.position(x, y));
    double sum = 0, weights = 0;
    for (int corner = 0; corner < 4; ++corner) {
      const int cx = static_cast<int>(std::floor(p.x - 0.5)) + corner % 2;
      const int cy = static_cast<int>(std::floor(p.y - 0.5)) + corner / 2;
      if (!there.contains(cx, cy)) continue;
      const size_t index = there.indexOf(cx, cy);
      if (neighbour.rgba[4 * index + 3] < 255 || neighbour.depth[index] == 0) continue;
      const double w = neighbour.depthMin + (neighbour.depth[index] - 1) * there.step();
      if (std::abs(w - p.z) > 2 * there.texelEdge()) continue;
      const double weight = (1 - std::abs(p.x - 0.5 - cx)) * (1 - std::abs(p.y - 0.5 - cy));
      sum += weight * neighbour.rgba[4 * index + 1];
      weights += weight;
    }
    if (weights > 0.25) carried[texel] = static_cast<int>(std::lround(sum / weights));
  }
  return carried;
}

// Depth of the neighbour's texels, the nearest to the viewer of those that fall on one.
Values carriedDepth(const ViewImage& view, const ViewImage& neighbour, const Projection& here,
                    const Projection& there) {
  Values carried(view.depth.size(), -1);
  for (int i = 0; i < static_cast<int>(neighbour.depth.size()); ++i) {
    if (neighbour.depth[static_cast<size_t>(i)] == 0 || neighbour.rgba[4 * static_cast<size_t>(i) + 3] == 0) continue;
    const glm::dvec3 p =
        here.texelOf(there.position(i % static_cast<int>(neighbour.width), i / static_cast<int>(neighbour.width)));
    const int x = static_cast<int>(std::floor(p.x)), y = static_cast<int>(std::floor(p.y));
    if (!here.contains(x, y) || here.step() == 0) continue;
    const int value = static_cast<int>(std::clamp(std::lround(1 + (p.z - view.depthMin) / here.step()), 1l, 255l));
    int& kept = carried[here.indexOf(x, y)];
    kept = std::max(kept, value);
  }
  return carried;
}

Plane greenOf(const ViewImage& view) {
  Plane plane{static_cast<int>(view.width), static_cast<int>(view.height), {}, {}, {}, {}};
  for (size_t i = 0; i < view.depth.size(); ++i) {
    plane.values.push_back(view.rgba[4 * i + 1]);
    plane.alpha.push_back(view.rgba[4 * i + 3]);
    plane.stored.push_back(plane.alpha.back() > 0);
  }
  return plane;
}

Plane depthOf(const ViewImage& view) {
  Plane plane{static_cast<int>(view.width), static_cast<int>(view.height), {}, {}, {}, {}};
  for (int y = 0; y < plane.height; ++y) {
    for (int x = 0; x < plane.width; ++x) {
      bool near = false;
      for (int k = 0; k < 9; ++k) {
        const int nx = x + k % 3 - 1, ny = y + k / 3 - 1;
        if (nx < 0 || ny < 0 || nx >= plane.width || ny >= plane.height) continue;
        near = near || view.rgba[4 * static_cast<size_t>(ny * plane.width + nx) + 3] > 0;
      }
      plane.values.push_back(view.depth[static_cast<size_t>(y * plane.width + x)]);
      plane.alpha.push_back(255);
      plane.stored.push_back(near);
    }
  }
  return plane;
}

size_t storedOf(const Plane& plane) {
  return static_cast<size_t>(std::count(plane.stored.begin(), plane.stored.end(), true));
}

void append(Bytes& to, std::span<const std::byte> bytes) { to.insert(to.end(), bytes.begin(), bytes.end()); }

}  // namespace

void addReprojected(const ViewImage& view, const ViewImage& neighbour, const Viewpoints& viewpoints, int imageSize,
                    ReprojectTotals& totals) {
  const EncodedView built = encodeView(view);
  const auto filterOf = [&](int plane) { return static_cast<int>(built.coding >> (4 * plane) & 15); };
  for (int plane = 0; plane < 5; ++plane)
    if (built.coding >> 28 != 1 || filterOf(plane) == 5 || !view.normal.empty()) return;
  const size_t texels = view.depth.size();
  Bytes planes(2 + 5 * texels);
  const Result<size_t> used = zlibDecompressUpTo(built.stream, planes);
  FARCELL_CHECK(used.has_value());
  Plane green = greenOf(view), depth = depthOf(view);
  const std::span<const std::byte> all = std::span(planes).first(*used);
  const auto alphaPart = all.first(2 + texels), greenPart = all.subspan(2 + texels, storedOf(green));
  const auto depthPart = all.last(storedOf(depth));
  const auto chromaPart =
      all.subspan(2 + texels + storedOf(green), all.size() - 2 - texels - storedOf(green) - storedOf(depth));
  const Projection here(view, viewpoints, imageSize), there(neighbour, viewpoints, imageSize);
  green.carried = carriedGreen(view, neighbour, here, there);
  depth.carried = carriedDepth(view, neighbour, here, there);
  // This program's predictions without a neighbour are those of the product.
  FARCELL_CHECK(std::ranges::equal(residualsOf(green, filterOf(1), Carried::none), greenPart));
  FARCELL_CHECK(std::ranges::equal(residualsOf(depth, filterOf(4), Carried::none), depthPart));

  ++totals.views;
  totals.texels += greenPart.size();
  totals.carriedTexels += static_cast<uint64_t>(
      std::count_if(green.carried.begin(), green.carried.end(), [](int value) { return value >= 0; }));
  totals.builtBytes += built.stream.size();
  totals.alphaBytes += zlibCompress(alphaPart, kLevel).size();
  const auto best = [&](const Plane& plane, std::array<uint64_t, kCarriedWays>& bytes, Bytes& without) {
    Bytes shortest;
    size_t shortestSize = SIZE_MAX;
    for (size_t way = 0; way < kCarriedWays; ++way) {
      Bytes residuals = bestResiduals(plane, static_cast<Carried>(way));
      const size_t size = zlibCompress(residuals, kLevel).size();
      bytes[way] += size;
      if (way == 0) without = residuals;
      if (size < shortestSize) shortest = std::move(residuals), shortestSize = size;
    }
    return shortest;
  };
  Bytes greenWithout, depthWithout;
  const Bytes greenBest = best(green, totals.greenBytes, greenWithout);
  const Bytes depthBest = best(depth, totals.depthBytes, depthWithout);
  const auto stream = [&](const Bytes& greens, const Bytes& depths) {
    Bytes whole;
    for (const std::span<const std::byte> part :
         {alphaPart, std::span<const std::byte>(greens), chromaPart, std::span<const std::byte>(depths)})
      append(whole, part);
    return zlibCompress(whole, kLevel).size();
  };
  totals.bestBytes += stream(greenBest, depthBest);
  totals.bestWithoutBytes += stream(greenWithout, depthWithout);
}

}  // namespace farcell
