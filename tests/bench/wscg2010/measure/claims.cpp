#include "tests/bench/wscg2010/measure/claims.h"

#include <algorithm>
#include <cmath>

namespace farcell::wscg {
namespace {

constexpr double kPaperDeflate = 0.18, kPaperSlowOverDeflate = 0.5, kPaperDiskSlowdown = 20;
// A figure this much off the paper's is still the paper's figure.
constexpr double kLeeway = 1.25;
constexpr double kClosed = 0.2;  // of the holes may remain
constexpr double kManyMoreTriangles = 2;
constexpr double kHundredthMs = 10;  // a frame, at 100 a second

struct Judge {
  const ExperimentResults& results;
  const ExperimentSettings& settings;

  std::string paperName() const { return paperVariant(settings.depth).name; }
  std::string named(const std::string& change) const { return paperName() + ", " + change; }
  double error(const std::string& scene, const std::string& variant, double distance) const {
    return meanOver(results.errors, scene, variant, distance, toSingle);
  }
  double over(const std::string& scene, const std::string& variant, double (*figure)(const ErrorRow&)) const {
    return meanOver(results.errors, scene, variant, -1, figure);
  }
  const SizeResult* sizes(const std::string& scene, const std::string& variant) const {
    for (const SizeResult& size : results.sizes)
      if (size.scene == scene && size.variant == variant) return &size;
    return nullptr;
  }
  bool atEveryDistance(const auto& holds) const {
    return std::all_of(settings.errors.distances.begin(), settings.errors.distances.end(), holds);
  }
};

// A claim about each scene, joined.
class Verdicts {
 public:
  void add(const std::string& scene, bool holds, const std::string& figures) { add(scene, holds, holds, figures); }
  // Between the two: it holds in part.
  void add(const std::string& scene, bool holds, bool holdsInPart, const std::string& figures) {
    good_ += holds || holdsInPart;
    bad_ += !holds;
    sentence_ += (sentence_.empty() ? "" : "; ") + scene + ": " + figures;
  }
  Claim claim(std::string text, const std::string& closing = "") const {
    const char* verdict = good_ + bad_ == 0 ? "not measured"
                          : bad_ == 0       ? "holds"
                          : good_ == 0      ? "does not hold"
                                            : "depends";
    return {std::move(text), verdict, sentence_ + (closing.empty() ? "" : ". " + closing)};
  }

 private:
  int good_ = 0, bad_ = 0;
  std::string sentence_;
};

Claim moreCells(const Judge& judge) {
  Verdicts verdicts;
  for (const SceneFacts& scene : judge.results.scenes) {
    std::vector<std::string> names = {paperVariant(0).name};
    for (int depth = 2; depth <= judge.settings.depth; ++depth) names.push_back(paperVariant(depth).name);
    const bool falls = judge.atEveryDistance([&](double distance) {
      for (size_t i = 1; i < names.size(); ++i)
        if (judge.error(scene.name, names[i], distance) >= judge.error(scene.name, names[i - 1], distance))
          return false;
      return true;
    });
    std::string figures;
    for (const std::string& name : names)
      figures += (figures.empty() ? "" : ", ") + number(judge.over(scene.name, name, toSingle), 1);
    verdicts.add(scene.name, falls, figures);
  }
  return verdicts.claim("With more cells the error is less",
                        "(Mean error over all distances: single cell, depth 2 and so on; judged at each distance)");
}

Claim orthographic(const Judge& judge, const std::string& base, const std::string& text) {
  Verdicts verdicts;
  for (const SceneFacts& scene : judge.results.scenes) {
    std::string figures;
    bool less = true;
    for (const double distance : judge.settings.errors.distances) {
      const double own = judge.error(scene.name, base, distance);
      double best = INFINITY;
      for (const int fovDeg : {40, 60, 90})
        best = std::min(best, judge.error(scene.name, fmt::format("{}, perspective {}", base, fovDeg), distance));
      less = less && own < best;
      figures +=
          fmt::format("{}{} against {} at {}", figures.empty() ? "" : ", ", number(own, 1), number(best, 1), distance);
    }
    verdicts.add(scene.name, less, figures);
  }
  return verdicts.claim(text,
                        "(Orthographic against the best of 40, 60 and 90 degrees, at each distance in diameters)");
}

Claim growing(const Judge& judge) {
  Verdicts verdicts;
  const std::string cut = judge.named("cut to the cube"), paper = judge.paperName();
  for (const SceneFacts& scene : judge.results.scenes) {
    const double before = judge.over(scene.name, cut, holes), after = judge.over(scene.name, paper, holes);
    const double farcell = judge.over(scene.name, judge.named("grown 1.04"), holes);
    verdicts.add(
        scene.name, after <= kClosed * before,
        fmt::format("{} % of the covered pixels are holes, {} % once grown to the sphere, {} % at farcell's 1.04",
                    number(100 * before, 3), number(100 * after, 3), number(100 * farcell, 3)));
  }
  return verdicts.claim("Taking the triangles that meet the cell's sphere closes the black lines");
}

Claim growingCosts(const Judge& judge) {
  Verdicts verdicts;
  const std::string cut = judge.named("cut to the cube"), grown = judge.named("grown 1.04"), paper = judge.paperName();
  for (const SceneFacts& scene : judge.results.scenes) {
    const double sphere = judge.over(scene.name, paper, toSingle), cube = judge.over(scene.name, cut, toSingle);
    const double farcell = judge.over(scene.name, grown, toSingle);
    const SizeResult* before = judge.sizes(scene.name, cut);
    const SizeResult* after = judge.sizes(scene.name, paper);
    const double bytes =
        before != nullptr && after != nullptr ? after->bytes(Coding::zlibCell) / before->bytes(Coding::zlibCell) : 0;
    verdicts.add(
        scene.name, sphere <= cube,
        fmt::format("error {} cut, {} grown to the sphere, {} at 1.04; {} times the deflated bytes of cut cells",
                    number(cube, 1), number(sphere, 1), number(farcell, 1), number(bytes, 2)));
  }
  return verdicts.claim("... without harm (\"although visually incorrect, ... an effective solution\")");
}

Claim distance(const Judge& judge) {
  Verdicts verdicts;
  for (const SceneFacts& scene : judge.results.scenes) {
    std::string figures;
    double lastError = INFINITY, lastRatio = INFINITY;
    bool errorFalls = true, ratioFalls = true;
    for (const double at : judge.settings.errors.distances) {
      const double own = meanOver(judge.results.errors, scene.name, judge.paperName(), at, toTruth);
      const double triangles = meanOver(judge.results.errors, scene.name, kTrianglesVariant, at, toTruth);
      const double ratio = own / triangles;
      errorFalls = errorFalls && own < lastError;
      ratioFalls = ratioFalls && ratio < lastRatio;
      lastError = own;
      lastRatio = ratio;
      figures += fmt::format("{}{} / {} = {} at {}", figures.empty() ? "" : ", ", number(own, 1), number(triangles, 1),
                             number(ratio, 2), at);
    }
    verdicts.add(scene.name, errorFalls, ratioFalls, figures);
  }
  return verdicts.claim(
      "Artifacts get smaller with distance, until they cannot be noticed",
      "(Error to the truth of impostors, over that of the triangles at 1 sample. In part: not by itself "
      "but against what triangles lose)");
}

Claim deflate(const Judge& judge) {
  Verdicts verdicts;
  for (const SceneFacts& scene : judge.results.scenes) {
    const SizeResult* size = judge.sizes(scene.name, judge.paperName());
    if (size == nullptr) continue;
    const double share = size->share(Coding::zlibCell);
    verdicts.add(scene.name, share <= kLeeway * kPaperDeflate,
                 fmt::format("{} of the cropped bytes (image by image {}, farcell's planes {})", percent(share),
                             percent(size->share(Coding::zlibImages)), percent(size->share(Coding::planes))));
  }
  return verdicts.claim("Deflate leaves about 18 %");
}

Claim slowCoder(const Judge& judge) {
  Verdicts verdicts;
  for (const SceneFacts& scene : judge.results.scenes) {
    const SizeResult* size = judge.sizes(scene.name, judge.paperName());
    if (size == nullptr) continue;
    const double ratio = size->bytes(Coding::xzCell) / size->bytes(Coding::zlibCell);
    verdicts.add(scene.name, ratio <= kLeeway * kPaperSlowOverDeflate,
                 fmt::format("xz over deflate {}, WebP lossless over deflate {}", number(ratio, 2),
                             number(size->bytes(Coding::webp) / size->bytes(Coding::zlibCell), 2)));
  }
  return verdicts.claim("A slower coder halves that again");
}

// Two scenes of very different size at the same depth.
Claim primitives(const Judge& judge) {
  Verdicts verdicts;
  const auto& scenes = judge.results.scenes;
  for (size_t i = 1; i < scenes.size(); ++i) {
    const auto less = [](const SceneFacts& a, const SceneFacts& b) { return a.triangles < b.triangles; };
    const SceneFacts small = std::min(scenes[0], scenes[i], less), large = std::max(scenes[0], scenes[i], less);
    const TimeRow* few = findTime(judge.results.times, small.name, Source::resident);
    const TimeRow* many = findTime(judge.results.times, large.name, Source::resident);
    const TimeRow* fewFull = findTime(judge.results.times, small.name, Source::triangles);
    const TimeRow* manyFull = findTime(judge.results.times, large.name, Source::triangles);
    const double triangles = static_cast<double>(large.triangles) / static_cast<double>(small.triangles);
    if (few == nullptr || many == nullptr || triangles < kManyMoreTriangles) continue;
    const double ratio = (many->frameMs / many->items) / (few->frameMs / few->items);
    verdicts.add(fmt::format("{} against {}", large.name, small.name), ratio <= kLeeway,
                 fmt::format("{} times the triangles; a cell takes {} times as long, the triangles themselves {} times",
                             number(triangles, 1), number(ratio, 2), number(manyFull->frameMs / fewFull->frameMs, 1)));
  }
  return verdicts.claim("The performance of a cell does not depend on how many primitives it holds");
}

Claim upload(const Judge& judge) {
  Verdicts verdicts;
  for (const SceneFacts& scene : judge.results.scenes) {
    const TimeRow* row = findTime(judge.results.times, scene.name, Source::memory);
    const TimeRow* resident = findTime(judge.results.times, scene.name, Source::resident);
    if (row == nullptr || resident == nullptr) continue;
    verdicts.add(scene.name, row->frameMs <= kHundredthMs, row->uploadMs <= kHundredthMs,
                 fmt::format("{} frames a second with {} images, {} MB, uploaded anew, {} with none: {} ms of upload",
                             number(1000 / row->frameMs, 0), number(row->items, 0), number(row->textureBytes / 1e6, 1),
                             number(1000 / resident->frameMs, 0), number(row->uploadMs, 1)));
  }
  return verdicts.claim(
      "Uploading every texture in every frame still gives 100 frames a second and more",
      "(The paper: 218 cells on a GeForce 8800GT. In part: uploads alone would allow it, drawing does "
      "not. A software renderer's upload is a copy in memory)");
}

Claim disk(const Judge& judge) {
  Verdicts verdicts;
  for (const SceneFacts& scene : judge.results.scenes) {
    const TimeRow* memory = findTime(judge.results.times, scene.name, Source::memory);
    const TimeRow* cold = findTime(judge.results.times, scene.name, Source::diskCold);
    const TimeRow* warm = findTime(judge.results.times, scene.name, Source::diskWarm);
    const TimeRow* deflated = findTime(judge.results.times, scene.name, Source::deflatedCold);
    if (memory == nullptr) continue;
    const double slowdown = cold->frameMs / memory->frameMs;
    verdicts.add(
        scene.name, slowdown >= kPaperDiskSlowdown / kLeeway, boundOf(*cold) == "read",
        fmt::format("cold reads make a frame {} times as long as uploads from memory (warm {}, deflated and cold "
                    "{}); {} MB a frame at {} MB/s, most of it {}",
                    number(slowdown, 1), number(warm->frameMs / memory->frameMs, 1),
                    number(deflated->frameMs / memory->frameMs, 1), number(cold->readBytes / 1e6, 1),
                    number(cold->readBytes / 1e3 / cold->readMs, 0), boundOf(*cold)));
  }
  return verdicts.claim(
      "The disk is the bottleneck: 100+ frames a second become 5",
      "(In part: cold frames wait for the disk, but not 20 times as long. The paper's figures, 218 images of 34 KB "
      "at 5 frames a second, are 38 MB/s: a disk of its time)");
}

Claim nearTriangles(const Judge& judge) {
  Verdicts verdicts;
  for (const NearTriangles& near : judge.results.near)
    verdicts.add(
        near.scene, near.errorWith < near.errorWithout,
        fmt::format("error {} becomes {} with the nearest {} of {} cells as triangles", number(near.errorWithout, 1),
                    number(near.errorWith, 1), near.cellsAsTriangles, near.cells));
  return verdicts.claim("Near cells drawn as triangles repair what is left");
}

}  // namespace

std::vector<Claim> judgeClaims(const ExperimentResults& results, const ExperimentSettings& settings) {
  const Judge judge{results, settings};
  const std::string singleLarge = paperVariant(0).name + ", 1024^2";
  return {
      moreCells(judge),
      orthographic(judge, singleLarge, "Single cell: orthographic images give less error than perspective ones"),
      orthographic(judge, judge.paperName(), "Many cells: orthographic images give less error than perspective ones"),
      growing(judge),
      growingCosts(judge),
      distance(judge),
      nearTriangles(judge),
      deflate(judge),
      slowCoder(judge),
      upload(judge),
      disk(judge),
      primitives(judge)};
}

}  // namespace farcell::wscg
