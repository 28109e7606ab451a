#include <numbers>

#include "tests/bench/wscg2010/measure/errors.h"

namespace farcell::wscg {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180;
constexpr int kPaperDepth = 4;
// Side by side, the images of 16 cells hold about as many texels along an edge as one of this size.
constexpr int kLargeImage = 1024;

Variant changed(Variant variant, const std::string& name) {
  variant.name += ", " + name;
  return variant;
}

Variant withFov(const Variant& base, int fovDeg) {
  Variant variant = changed(base, fmt::format("perspective {}", fovDeg));
  variant.impostors.image.fovRad = fovDeg * kRadPerDeg;
  return variant;
}

Variant withContent(const Variant& base, const std::string& name, Content content) {
  Variant variant = changed(base, name);
  variant.impostors.content = content;
  return variant;
}

Variant withViews(const Variant& base, int views) {
  Variant variant = changed(base, fmt::format("{} images", views));
  variant.impostors.views = views;
  return variant;
}

// Ways of drawing the images of `base`, then better images.
void addDrawings(std::vector<Variant>& variants, const Variant& base) {
  Variant nearest = changed(base, "nearest texel");
  nearest.draw.filter = Filter::nearest;
  Variant blended = changed(base, "blended rim");
  blended.draw.rim = Rim::blended;
  Variant prefiltered = changed(base, "16 samples a texel");
  prefiltered.impostors.image.samples = 16;
  Variant both = changed(prefiltered, "blended rim");
  both.draw.rim = Rim::blended;
  variants.insert(variants.end(), {nearest, blended, prefiltered, both});
}

}  // namespace

Variant paperVariant(int depth) {
  Variant variant;
  variant.name = depth == 0 ? "single cell" : fmt::format("depth {}", depth);
  variant.depth = depth;
  return variant;
}

std::vector<Variant> allVariants() {
  Variant single = changed(paperVariant(0), fmt::format("{}^2", kLargeImage));
  single.impostors.image.size = kLargeImage;
  std::vector<Variant> variants = {paperVariant(0), single};
  for (const int fovDeg : {40, 60, 90}) variants.push_back(withFov(single, fovDeg));
  for (const int depth : {2, 3, kPaperDepth}) {
    const Variant base = paperVariant(depth);
    variants.push_back(base);
    if (depth == kPaperDepth) addDrawings(variants, base);
    for (const int fovDeg : {40, 60, 90}) variants.push_back(withFov(base, fovDeg));
    variants.push_back(withContent(base, "cut to the cube", Content::cube));
    variants.push_back(withContent(base, "grown 1.04", Content::grown));
    for (const int views : {80, 1280}) variants.push_back(withViews(base, views));
  }
  return variants;
}

}  // namespace farcell::wscg
