#include "tools/evaluate/reference/tracer.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "cache/base/check.h"
#include "cache/base/parallel.h"

namespace farcell {
namespace {

constexpr int kLanes = 16;
constexpr int kBandRows = 8;  // a job: small enough to balance, large enough to fill packets

// Embree's coordinates are good to about 1e10 and NaN rays stop the process: what is farther cannot be hit.
bool traceable(glm::dvec3 p) { return std::abs(p.x) < 1e9 && std::abs(p.y) < 1e9 && std::abs(p.z) < 1e9; }

}  // namespace

// Up to 16 rays on their way through one geometry.
class SampleImage::Packet final : HitFilter {
 public:
  Packet(const TracedGeometry& geometry, const ReferenceView& view, double startDepth, int perAxis, glm::vec3 light)
      : geometry_(geometry),
        view_(view),
        start_(startDepth / geometry.triangles.unit),
        eye_((view.eye - geometry.triangles.origin) / geometry.triangles.unit),
        perAxis_(perAxis),
        light_(light) {
    rtcInitIntersectContext(&context_.embree);
    context_.filter = this;
    context_.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  }

  void add(Pixel& pixel, int x, int y, int sample) {
    const glm::dvec2 position = glm::dvec2(x, y) + samplePosition(x, y, sample, perAxis_);
    const glm::dvec3 direction = rayDirection(view_, position);
    // Starting next to the geometry keeps float origins precise however far the eye is.
    const glm::dvec3 origin = eye_ + start_ * direction;
    if (!traceable(origin)) return;
    const auto lane = static_cast<size_t>(count_++);
    RTCRay16& ray = rays_.ray;
    ray.org_x[lane] = static_cast<float>(origin.x);
    ray.org_y[lane] = static_cast<float>(origin.y);
    ray.org_z[lane] = static_cast<float>(origin.z);
    ray.dir_x[lane] = static_cast<float>(direction.x);
    ray.dir_y[lane] = static_cast<float>(direction.y);
    ray.dir_z[lane] = static_cast<float>(direction.z);
    ray.tnear[lane] = 0;
    ray.tfar[lane] = INFINITY;
    ray.time[lane] = 0;
    ray.mask[lane] = 0xffffffffu;
    ray.flags[lane] = 0;
    ray.id[lane] = static_cast<uint32_t>(lane);
    rays_.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
    rays_.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
    pixels_[lane] = &pixel;
    samples_[lane] = sample;
    if (count_ == kLanes) flush();
  }

  void flush() {
    if (count_ == 0) return;
    for (int lane = 0; lane < kLanes; ++lane) valid_[lane] = lane < count_ ? -1 : 0;
    rtcIntersect16(valid_, geometry_.scene.get(), &context_.embree, &rays_);
    for (int lane = 0; lane < count_; ++lane) {
      if (rays_.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID)
        layers_[lane].push_back(
            {rays_.ray.tfar[lane], rays_.hit.primID[lane], rays_.hit.u[lane], rays_.hit.v[lane], 1});
      if (!layers_[lane].empty()) close(lane);
      layers_[lane].clear();
    }
    count_ = 0;
  }

 private:
  struct Layer {
    float distance;
    uint32_t triangle;
    float u, v, opacity;
    bool operator<(const Layer& other) const {
      return distance != other.distance ? distance < other.distance : triangle < other.triangle;
    }
  };

  // Transparent surfaces are noted and passed.
  bool accepts(uint32_t lane, uint32_t triangle, float u, float v, float distance) override {
    const RTCRay16& ray = rays_.ray;
    const float opacity =
        opacityAt(geometry_.triangles, triangle, u, v,
                  glm::dvec3(double{ray.dir_x[lane]}, double{ray.dir_y[lane]}, double{ray.dir_z[lane]}));
    if (opacity >= 1) return true;
    if (opacity > 0) layers_[lane].push_back({distance, triangle, u, v, opacity});
    return false;
  }

  void close(int lane) {
    std::vector<Layer>& layers = layers_[lane];
    std::sort(layers.begin(), layers.end());
    // Embree may ask about a triangle more than once.
    const auto isSame = [](const Layer& a, const Layer& b) { return a.triangle == b.triangle; };
    layers.erase(std::unique(layers.begin(), layers.end(), isSame), layers.end());
    Pixel& pixel = *pixels_[lane];
    pixel.open &= ~(uint64_t{1} << samples_[lane]);
    float through = 1;
    for (const Layer& layer : layers) {
      pixel.sum += through * layer.opacity * shadeHit(geometry_.triangles, layer.triangle, layer.u, layer.v, light_);
      through *= 1 - layer.opacity;
    }
    pixel.through += through;
  }

  const TracedGeometry& geometry_;
  const ReferenceView& view_;
  const double start_;    // depth at which rays begin, local
  const glm::dvec3 eye_;  // local
  const int perAxis_;
  const glm::vec3 light_;
  TraceContext context_;
  std::vector<Layer> layers_[kLanes];  // met by each ray
  RTCRayHit16 rays_{};
  alignas(64) int valid_[kLanes];
  Pixel* pixels_[kLanes];
  int samples_[kLanes];
  int count_ = 0;
};

SampleImage::SampleImage(const ReferenceView& view, int perAxis, glm::vec3 light)
    : view_(view), perAxis_(perAxis), light_(light) {
  FARCELL_CHECK(perAxis >= 1 && perAxis <= 8);
  const int samples = perAxis * perAxis;
  const uint64_t all = samples == 64 ? ~uint64_t{0} : (uint64_t{1} << samples) - 1;
  pixels_.assign(static_cast<size_t>(view.width) * static_cast<size_t>(view.height), Pixel{all, glm::vec3(0), 0});
}

bool SampleImage::unresolved(const ScreenBounds& bounds) const {
  for (int y = bounds.y0; y < bounds.y1; ++y) {
    const Pixel* row = &pixels_[static_cast<size_t>(y) * view_.width];
    if (std::any_of(row + bounds.x0, row + bounds.x1, [](const Pixel& pixel) { return pixel.open != 0; })) return true;
  }
  return false;
}

void SampleImage::traceRows(const TracedGeometry& geometry, const ScreenBounds& bounds, int rowBegin, int rowEnd) {
  Packet packet(geometry, view_, bounds.nearestDepth * (1 - 1e-6), perAxis_, light_);
  for (int y = std::max(rowBegin, bounds.y0); y < std::min(rowEnd, bounds.y1); ++y) {
    for (int x = bounds.x0; x < bounds.x1; ++x) {
      Pixel& pixel = pixels_[static_cast<size_t>(y) * view_.width + x];
      for (uint64_t open = pixel.open; open != 0; open &= open - 1) packet.add(pixel, x, y, std::countr_zero(open));
    }
  }
  packet.flush();
}

void SampleImage::trace(std::span<const TracedGeometry> geometries, int threads) {
  std::vector<std::optional<ScreenBounds>> bounds;
  for (const TracedGeometry& geometry : geometries)
    bounds.push_back(geometry.scene ? screenBounds(view_, geometry.triangles.min, geometry.triangles.max)
                                    : std::nullopt);
  const auto bands = static_cast<size_t>((view_.height + kBandRows - 1) / kBandRows);
  parallelFor(bands, threads, [&](size_t band, int) {
    const int row = static_cast<int>(band) * kBandRows;
    for (size_t i = 0; i < geometries.size(); ++i)
      if (bounds[i]) traceRows(geometries[i], *bounds[i], row, std::min(row + kBandRows, view_.height));
  });
}

ReferenceImage SampleImage::finish() const {
  ReferenceImage image{view_.width, view_.height, {}, {}};
  image.rgb.reserve(3 * pixels_.size());
  image.coverage.reserve(pixels_.size());
  const int samples = perAxis_ * perAxis_;
  for (const Pixel& pixel : pixels_) {
    const glm::vec3 mean = pixel.sum * (255.0f / static_cast<float>(samples));
    for (const float value : {mean.x, mean.y, mean.z}) image.rgb.push_back(value);
    const auto hits = static_cast<float>(samples - std::popcount(pixel.open));
    image.coverage.push_back((hits - pixel.through) / static_cast<float>(samples));
  }
  return image;
}

}  // namespace farcell
