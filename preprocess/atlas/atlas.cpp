#include "preprocess/atlas/atlas.h"

#include <algorithm>
#include <cmath>

#include "preprocess/atlas/charts.h"
#include "preprocess/atlas/packing.h"

namespace farcell {
namespace {

constexpr uint32_t kLeastLevels = 4;
// More levels need wider gutters: as many as make the atlas no larger than this, against the least.
constexpr double kGutterShare = 1.25;
constexpr double kLeastEdge = 2;  // of a chart that gives way

// How charts lie in the atlas.
struct Plan {
  uint32_t levels = 0;
  uint32_t unit = 0;               // edge of a coarsest texel
  std::vector<glm::uvec2> texels;  // of each chart, without gutter
  std::vector<glm::uvec2> padded;  // with it, in units
  std::vector<glm::uvec2> places;  // in units
  glm::uvec2 size{0};              // of the atlas, in units
  uint32_t gutter() const { return unit / 2; }
};

std::vector<glm::uvec2> texelsOf(std::span<const Chart> charts, double maxEdge) {
  std::vector<glm::uvec2> texels;
  for (const Chart& chart : charts) {
    const double scale = std::min(1.0, maxEdge / std::max(chart.texels.x, chart.texels.y));
    const auto edge = [&](double source) { return static_cast<uint32_t>(std::max(1.0, std::ceil(source * scale))); };
    texels.emplace_back(edge(chart.texels.x), edge(chart.texels.y));
  }
  return texels;
}

void pad(Plan& plan, uint32_t levels) {
  plan.levels = levels;
  plan.unit = 1u << (levels - 1);
  plan.padded.clear();
  const auto units = [&](uint32_t texels) { return (texels + 2 * plan.gutter() + plan.unit - 1) / plan.unit; };
  for (const glm::uvec2& texels : plan.texels) plan.padded.emplace_back(units(texels.x), units(texels.y));
}

double paddedTexels(const Plan& plan) {
  double sum = 0;
  for (const glm::uvec2& size : plan.padded) sum += static_cast<double>(size.x) * size.y * plan.unit * plan.unit;
  return sum;
}

void padAsMayBe(Plan& plan) {
  pad(plan, kLeastLevels);
  const double least = paddedTexels(plan);
  for (uint32_t levels = kMaxAtlasLevels; levels > kLeastLevels; --levels) {
    pad(plan, levels);
    if (paddedTexels(plan) <= kGutterShare * least) return;
  }
  pad(plan, kLeastLevels);
}

std::optional<Plan> planOf(std::span<const Chart> charts) {
  for (double edge = kMaxTextureEdge; edge >= kLeastEdge; edge *= 0.84089641525) {  // 2^(-1/4)
    Plan plan;
    plan.texels = texelsOf(charts, edge);
    padAsMayBe(plan);
    std::optional<Packing> packing = packed(plan.padded, kMaxTextureEdge / plan.unit);
    if (!packing) continue;
    plan.places = std::move(packing->places);
    plan.size = packing->size;
    return plan;
  }
  return std::nullopt;
}

uint8_t texelValue(float value) { return static_cast<uint8_t>(std::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f); }

// The chart and its gutter.
void fillChart(const Chart& chart, glm::uvec2 texels, glm::uvec2 place, glm::uvec2 padded, const Plan& plan,
               TextureSampler& sampler, TexturePage& image) {
  const glm::dvec2 step = chart.size / glm::dvec2(texels);
  TextureLookup lookup{chart.texture, {}, {static_cast<float>(step.x), 0}, {0, static_cast<float>(step.y)}};
  const double gutter = plan.gutter();
  for (uint32_t y = 0; y < padded.y * plan.unit; ++y) {
    uint8_t* to = image.levels[0].data() +
                  image.channels * ((size_t{place.y} * plan.unit + y) * image.width + size_t{place.x} * plan.unit);
    for (uint32_t x = 0; x < padded.x * plan.unit; ++x, to += image.channels) {
      const glm::dvec2 at = chart.min + glm::dvec2(x + 0.5 - gutter, y + 0.5 - gutter) * step;
      lookup.at = glm::vec2(at);
      const glm::vec4 colour = sampler.sample(lookup);
      // Premultiplied: what is no surface has no colour to be averaged.
      const glm::vec4 stored = image.channels == 4 ? glm::vec4(glm::vec3(colour) * colour.w, colour.w) : colour;
      for (uint32_t channel = 0; channel < image.channels; ++channel)
        to[channel] = texelValue(stored[static_cast<int>(channel)]);
    }
  }
}

std::vector<uint8_t> halvedLevel(const std::vector<uint8_t>& level, uint32_t width, uint32_t height,
                                 uint32_t channels) {
  std::vector<uint8_t> half(level.size() / 4);
  const size_t row = size_t{width} * channels;
  uint8_t* to = half.data();
  for (uint32_t y = 0; y < height; y += 2)
    for (uint32_t x = 0; x < width; x += 2)
      for (uint32_t channel = 0; channel < channels; ++channel) {
        const uint8_t* from = level.data() + y * row + x * channels + channel;
        *to++ = static_cast<uint8_t>((from[0] + from[channels] + from[row] + from[row + channels] + 2) / 4);
      }
  return half;
}

TexturePage imageOf(std::span<const Chart> charts, const Plan& plan, TextureSampler& sampler) {
  const bool opaque = std::none_of(charts.begin(), charts.end(), [&](const Chart& chart) {
    return chart.texture != kNoTexture && sampler.surface(chart.texture).alpha != AlphaMode::opaque;
  });
  TexturePage image{plan.size.x * plan.unit, plan.size.y * plan.unit, opaque ? 3u : 4u, plan.levels, 0, {}};
  // White where nothing lies, and where there is no texture.
  image.levels.emplace_back(size_t{image.channels} * image.width * image.height, uint8_t{255});
  for (size_t i = 0; i < charts.size(); ++i)
    if (charts[i].texture != kNoTexture)
      fillChart(charts[i], plan.texels[i], plan.places[i], plan.padded[i], plan, sampler, image);
  for (uint32_t level = 1; level < plan.levels; ++level)
    image.levels.push_back(
        halvedLevel(image.levels.back(), image.width >> (level - 1), image.height >> (level - 1), image.channels));
  return image;
}

uint32_t packedCoordinates(glm::dvec2 unit) {
  const auto word = [](double value) { return static_cast<uint32_t>(std::clamp(value, 0.0, 1.0) * 65535.0 + 0.5); };
  return word(unit.x) | word(unit.y) << 16;
}

}  // namespace

std::optional<Atlas> atlasOf(std::span<const TriangleTexture> textures, TextureSampler& sampler) {
  const Charts charts = chartsOf(textures, sampler);
  const auto textured = [](const Chart& chart) { return chart.texture != kNoTexture; };
  if (std::none_of(charts.charts.begin(), charts.charts.end(), textured)) return std::nullopt;
  const std::optional<Plan> plan = planOf(charts.charts);
  if (!plan) return std::nullopt;
  Atlas atlas;
  atlas.image = imageOf(charts.charts, *plan, sampler);
  const glm::dvec2 size(atlas.image.width, atlas.image.height);
  for (const ChartedTriangle& triangle : charts.triangles) {
    const Chart& chart = charts.charts[triangle.chart];
    const glm::dvec2 corner = glm::dvec2(plan->places[triangle.chart] * plan->unit) + double(plan->gutter());
    auto& words = atlas.coordinates.emplace_back();
    for (size_t k = 0; k < 3; ++k) {
      const glm::dvec2 inside = (triangle.coordinates[k] - chart.min) / chart.size;
      words[k] = packedCoordinates((corner + inside * glm::dvec2(plan->texels[triangle.chart])) / size);
    }
  }
  return atlas;
}

}  // namespace farcell
