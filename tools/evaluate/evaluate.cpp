#include "tools/evaluate/evaluate.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>

#include "cache/base/interrupt.h"
#include "cache/base/progress.h"
#include "runtime/calibration/calibration.h"
#include "tools/evaluate/baselines/octahedral.h"
#include "tools/evaluate/measure_path.h"
#include "tools/evaluate/measure_renderer.h"
#include "tools/evaluate/packs.h"
#include "tools/evaluate/path/camera_path.h"
#include "tools/evaluate/path/generated_path.h"
#include "tools/evaluate/plan/auto_cameras.h"
#include "tools/evaluate/plan/suns.h"
#include "tools/evaluate/plan/sweep.h"
#include "tools/evaluate/reference/reference.h"
#include "tools/evaluate/report/equal_report.h"
#include "tools/evaluate/report/names.h"
#include "tools/evaluate/report/page.h"
#include "tools/evaluate/report/path_report.h"
#include "tools/evaluate/report/pictures.h"
#include "tools/evaluate/report/report.h"
#include "tools/evaluate/report/summary.h"
#include "tools/evaluate/report/sun_report.h"

namespace farcell {
namespace {

// A camera that moves.
struct Path {
  std::string name;
  std::vector<Camera> frames;
};

// Everything a camera's measurement needs, and what has been measured.
struct Run {
  const EvaluateOptions& options;
  const Packs& packs;
  GlContext& context;
  std::optional<MeshReference> mesh;
  std::vector<RendererPlan> plans;
  std::optional<OctahedralImpostor> octahedral;  // of the plan kOctahedral
  std::vector<Camera> cameras;
  std::vector<Path> paths;
  std::vector<std::string> stems;  // of file names, one a camera, then one a path
  ReportFacts facts;
  std::vector<Entry> entries;          // of finished cameras
  std::vector<SunEntries> sunEntries;  // of finished cameras
  std::vector<PathEntry> pathEntries;  // of finished frames
};

Result<std::vector<RendererPlan>> makePlans(const EvaluateOptions& options, const std::vector<OtherPack>& others) {
  std::vector<std::string> names;
  for (const OtherPack& other : others) names.push_back(other.name);
  FARCELL_ASSIGN(std::vector<RendererPlan> plans, planRenderers(options.renderers, options.width, options.height,
                                                                options.selection, options.lodPixels, names));
  return sweepRenderers(std::move(plans), options.sweeps);
}

Result<std::vector<Camera>> loadCameras(const EvaluateOptions& options, const Model& model) {
  std::vector<Camera> cameras;
  if (options.cameras.empty() && options.autoCameras == 0) return cameras;
  if (options.cameras.empty()) {
    cameras = autoCameras(model, Viewpoints::of(model.settings.form.views), options.autoCameras);
  } else {
    FARCELL_ASSIGN(cameras, readCameras(options.cameras));
  }
  if (cameras.empty()) return fail(ErrorKind::invalidArgument, "{}: no cameras", options.cameras.string());
  return cameras;
}

Result<Path> loadPath(const EvaluateOptions& options, const PackFile& pack, const std::string& word) {
  if (isGeneratedPath(word)) {
    FARCELL_ASSIGN(std::vector<Camera> frames, generatedPath(word, pack, options.pathFrames, options.pathSeed));
    return Path{word, std::move(frames)};
  }
  const std::filesystem::path file(word);
  FARCELL_ASSIGN(const std::vector<Keyframe> keyframes, readKeyframes(file));
  Result<std::vector<Camera>> frames = pathFrames(keyframes, options.pathFrames);
  if (!frames) return fail(frames.error().kind, "{}: {}", word, frames.error().message);
  return Path{file.stem().string(), *std::move(frames)};
}

Result<std::vector<Path>> loadPaths(const EvaluateOptions& options, const PackFile& pack) {
  std::vector<Path> paths;
  for (const std::string& word : options.paths) {
    FARCELL_ASSIGN(Path path, loadPath(options, pack, word));
    paths.push_back(std::move(path));
  }
  return paths;
}

Result<std::optional<MeshReference>> loadMesh(const EvaluateOptions& options, const Directory& directory,
                                              Progress& progress) {
  if (options.meshes.empty()) return std::nullopt;
  progress.begin("read mesh", directory.report.inputTriangles, "triangles");
  FARCELL_ASSIGN(MeshReference mesh,
                 MeshReference::load(options.meshes, directory, [&](uint64_t count) { progress.advance(count); }));
  return mesh;
}

Result<ReferenceImage> traceCamera(Run& run, const Camera& camera, const Light& light) {
  const auto start = std::chrono::steady_clock::now();
  ReferenceSettings settings;
  settings.width = run.options.width;
  settings.height = run.options.height;
  settings.samples = run.options.referenceSamples;
  settings.light = light;
  FARCELL_ASSIGN(ReferenceImage image,
                 run.mesh ? run.mesh->trace(camera, settings) : traceReference(run.packs.own(), camera, settings));
  run.facts.referenceSeconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return image;
}

// The most that auto needs in memory from one of the cameras.
Result<uint64_t> memoryOfAuto(const Run& run) {
  const Directory& directory = run.packs.own().directory();
  uint64_t bytes = 0;
  for (const Camera& camera : run.cameras) {
    const Cut cut = selectCut(directory, camera, run.options.width, run.options.height, run.options.selection);
    bytes = std::max(bytes, residentBytes(directory, cut, ImpostorKind::depthCorrected));
  }
  return bytes;
}

Result<> bakeBaseline(Run& run, Progress& progress) {
  const auto plan = std::find_if(run.plans.begin(), run.plans.end(),
                                 [](const RendererPlan& candidate) { return candidate.name == kOctahedral; });
  if (plan == run.plans.end() || run.cameras.empty()) return {};
  FARCELL_ASSIGN(const uint64_t bytes, memoryOfAuto(run));
  plan->frameEdge = octahedralEdgeOf(bytes);
  progress.begin("bake octahedral impostor", kOctahedralFrames, "views");
  const glm::vec3 sun = lightDirection(run.options.light, run.packs.own().directory().model.settings, {});
  FARCELL_ASSIGN(const OctahedralViews views, bakeOctahedral(run.packs.own(), plan->frameEdge, sun));
  progress.end();
  FARCELL_ASSIGN(run.octahedral, OctahedralImpostor::create(run.context, views));
  return {};
}

Result<Measurement> measurePlan(const Run& run, const Camera& camera, const RendererPlan& plan,
                                const ReferenceImage& reference, const MeasureSettings& settings) {
  if (plan.name != kOctahedral)
    return measureRenderer(run.context, run.packs.of(plan), camera, plan, reference, settings);
  const DrawFrame draw = [&](FrameImage* image) -> Result<FrameStats> {
    return run.octahedral->draw(camera, run.options.width, run.options.height, image);
  };
  return measureFrames(run.packs.own().directory().model, camera, plan, reference, settings, draw);
}

// Of a renderer that has to take as long as another one, with the setting that does.
Result<RendererPlan> settledPlan(const Run& run, const Camera& camera, RendererPlan plan,
                                 const std::vector<Entry>& entries, const MeasureSettings& settings) {
  const auto other = std::find_if(entries.begin(), entries.end(), [&](const Entry& entry) {
    return !plan.timeOf.empty() && entry.renderer.kind == plan.timeOf;
  });
  if (other == entries.end()) return plan;
  FARCELL_ASSIGN(plan.settings.selection.meshPixels,
                 meshPixelsOfTime(run.context, run.packs.of(plan), camera, plan, other->frame.medianMs, settings));
  return plan;
}

Result<> measureCamera(Run& run, size_t index, Progress& progress) {
  const Camera& camera = run.cameras[index];
  const EvaluateOptions& options = run.options;
  FARCELL_ASSIGN(const ReferenceImage reference, traceCamera(run, camera, run.options.light));
  FARCELL_TRY(writeReferencePicture(options.output, run.stems[index], reference, options.background));
  progress.advance();
  std::vector<Entry> entries;
  const MeasureSettings settings{options.timedFrames, options.residentBytes, options.background};
  for (const RendererPlan& planned : run.plans) {
    FARCELL_TRY(checkInterrupt());
    FARCELL_ASSIGN(const RendererPlan plan, settledPlan(run, camera, planned, entries, settings));
    FARCELL_ASSIGN(Measurement measurement, measurePlan(run, camera, plan, reference, settings));
    measurement.entry.stem = run.stems[index];
    const FrameImage& image = measurement.image;
    const TestImage test{image.width, image.height, image.rgba, image.impostorCoverage};
    FARCELL_TRY(writeRendererPictures(options.output, {run.stems[index], plan.name, test, measurement.flip}, reference,
                                      options.background));
    entries.push_back(std::move(measurement.entry));
    progress.advance();
  }
  if (entries.front().metrics.foregroundPixels == 0)
    fmt::print(stderr, "camera '{}' sees nothing of the model: it does not count in ratios\n", camera.name);
  run.entries.insert(run.entries.end(), entries.begin(), entries.end());
  return {};
}

Result<> measureCameras(Run& run, Progress& progress) {
  if (run.cameras.empty()) return {};
  progress.begin("evaluate", run.cameras.size() * (1 + run.plans.size()), "pictures");
  for (size_t i = 0; i < run.cameras.size(); ++i) FARCELL_TRY(measureCamera(run, i, progress));
  progress.end();
  return {};
}

// Without those that need the cameras' other measurements, or a bake of their own.
std::vector<RendererPlan> plansAlone(const std::vector<RendererPlan>& plans) {
  std::vector<RendererPlan> alone;
  std::copy_if(plans.begin(), plans.end(), std::back_inserter(alone),
               [](const RendererPlan& plan) { return plan.timeOf.empty() && plan.name != kOctahedral; });
  return alone;
}

// Figures only, of frames that are not timed.
Result<> measureUnder(Run& run, const Sun& sun, Progress& progress) {
  const MeasureSettings settings{1, run.options.residentBytes, run.options.background};
  const Light light{LightKind::sun, sun};
  SunEntries& under = run.sunEntries.emplace_back(SunEntries{sun, {}});
  for (const Camera& camera : run.cameras) {
    FARCELL_ASSIGN(const ReferenceImage reference, traceCamera(run, camera, light));
    for (RendererPlan plan : plansAlone(run.plans)) {
      FARCELL_TRY(checkInterrupt());
      plan.settings.light = light;
      FARCELL_ASSIGN(Measurement measurement,
                     measureRenderer(run.context, run.packs.of(plan), camera, plan, reference, settings));
      under.entries.push_back(std::move(measurement.entry));
      progress.advance();
    }
  }
  return {};
}

Result<> measureSuns(Run& run, Progress& progress) {
  if (run.options.suns == 0) return {};
  const std::vector<Sun> suns = skySuns(run.options.suns);
  progress.begin("other suns", suns.size() * run.cameras.size() * plansAlone(run.plans).size(), "pictures");
  for (const Sun& sun : suns) FARCELL_TRY(measureUnder(run, sun, progress));
  progress.end();
  return {};
}

Result<> measurePaths(Run& run, Progress& progress) {
  PathSettings settings;
  settings.output = run.options.output;
  settings.residentBytes = run.options.residentBytes;
  settings.background = run.options.background;
  settings.plans = plansAlone(run.plans);
  settings.trace = [&](const Camera& camera) { return traceCamera(run, camera, run.options.light); };
  settings.pictureDone = [&] { progress.advance(); };
  for (size_t i = 0; i < run.paths.size(); ++i) {
    const Path& path = run.paths[i];
    progress.begin("path " + path.name, path.frames.size() * (1 + settings.plans.size()), "pictures");
    PathEntry& entry = run.pathEntries.emplace_back();
    entry.name = path.name;
    entry.stem = run.stems[run.cameras.size() + i];
    FARCELL_TRY(writeTextFile(run.options.output / (entry.stem + ".cameras.json"), cameraFileText(path.frames)));
    FARCELL_TRY(measurePath(run.context, run.packs, path.frames, settings, entry));
    progress.end();
  }
  return {};
}

Result<> measureAll(Run& run, Progress& progress) {
  FARCELL_TRY(bakeBaseline(run, progress));
  FARCELL_TRY(measureCameras(run, progress));
  FARCELL_TRY(measureSuns(run, progress));
  return measurePaths(run, progress);
}

std::string tables(const Run& run, const EqualTable& equal) {
  std::string text;
  for (const std::string& table :
       {run.entries.empty() ? "" : reportTable(run.entries), equalText(equal), sunsText(run.sunEntries),
        run.pathEntries.empty() ? "" : pathsTable(run.pathEntries)})
    text += (text.empty() || table.empty() ? "" : "\n") + table;
  return text;
}

Result<> writeReport(const Run& run) {
  nlohmann::ordered_json json = reportJson(run.facts, run.entries);
  const EqualTable equal = equalTable(run.entries);
  json["equal"] = equalJson(equal);
  json["suns"] = sunsJson(run.sunEntries);
  json["paths"] = pathsJson(run.pathEntries);
  // Names from outside may hold bytes that are not UTF-8: those are replaced.
  const std::string text = json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  FARCELL_TRY(writeTextFile(run.options.output / "report.json", text));
  FARCELL_TRY(writeTextFile(run.options.output / "report.csv", reportCsv(run.entries)));
  FARCELL_TRY(writeTextFile(run.options.output / "summary.csv", summaryCsv(run.entries)));
  FARCELL_TRY(writeTextFile(run.options.output / "equal.csv", equalCsv(equal)));
  FARCELL_TRY(writeTextFile(run.options.output / "suns.csv", sunsCsv(run.sunEntries)));
  FARCELL_TRY(writeTextFile(run.options.output / "paths.csv", pathsCsv(run.pathEntries)));
  FARCELL_TRY(writeTextFile(run.options.output / "index.html", reportPage(json)));
  std::fputs(run.options.json ? text.c_str() : tables(run, equal).c_str(), stdout);
  return {};
}

std::string fileNameOf(const PackFile& pack) { return std::filesystem::path(pack.path()).filename().string(); }

ReportFacts reportFacts(const EvaluateOptions& options, const Packs& packs, const GlContext& context) {
  ReportFacts facts;
  facts.packName = fileNameOf(packs.own());
  facts.packBytes = packs.own().sizeBytes();
  facts.directory = &packs.own().directory();
  for (const auto& [name, pack] : packs.others())
    facts.against.push_back({name, fileNameOf(pack), pack.sizeBytes(), &pack.directory()});
  facts.width = options.width;
  facts.height = options.height;
  facts.timedFrames = options.timedFrames;
  facts.light = options.light;
  facts.background = options.background;
  facts.glRenderer = context.renderer();
  facts.referenceKind = options.meshes.empty() ? "pack" : "mesh";
  facts.referenceSamples = options.referenceSamples;
  return facts;
}

// A time budget is kept by what drawing costs on this machine; what has none draws the same picture on all.
Result<> applySettings(const EvaluateOptions& options, GlContext& context, std::vector<RendererPlan>& plans) {
  const auto isTimed = [](const RendererPlan& plan) { return plan.settings.selection.timeBudgetMs > 0; };
  CostModel costs = kDefaultCosts;
  if (options.recalibrate || std::any_of(plans.begin(), plans.end(), isTimed)) {
    FARCELL_ASSIGN(costs, machineCosts(context, options.recalibrate));
  }
  for (RendererPlan& plan : plans) {
    plan.settings.costs = isTimed(plan) ? costs : kDefaultCosts;
    plan.settings.occlusion = options.occlusion;
    if (plan.settings.selection.mode != RenderMode::full) plan.settings.samplesPerPixel = options.samples;
    plan.settings.light = options.light;
  }
  return {};
}

// Before anything is traced.
Result<> checkLights(const EvaluateOptions& options, const Packs& packs, const std::vector<RendererPlan>& plans) {
  std::vector<Light> lights = {options.light};
  for (const Sun& sun : skySuns(options.suns)) lights.push_back({LightKind::sun, sun});
  for (const RendererPlan& plan : plans) {
    if (plan.name == kOctahedral && options.light.kind == LightKind::headlight)
      return fail(ErrorKind::invalidArgument, "--light headlight: frames of an octahedral impostor hold a sun's light");
    const PackFile& pack = packs.of(plan);
    for (const Light& light : lights) FARCELL_TRY(checkLight(light, pack.directory().model.settings, pack.path()));
  }
  return {};
}

// The sun is the same for all packs: that of the one evaluated, if no other is asked for.
Light resolvedLight(const EvaluateOptions& options, const PackFile& pack) {
  Light light = options.light;
  if (light.kind == LightKind::sun && !light.sun) light.sun = pack.directory().model.settings.sun;
  return light;
}

Result<> makeDirectory(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) return fail(ErrorKind::io, "{}: cannot make the directory: {}", path.string(), error.message());
  return {};
}

std::vector<std::string> stemsOf(const std::vector<Camera>& cameras, const std::vector<Path>& paths) {
  std::vector<std::string> names;
  for (const Camera& camera : cameras) names.push_back(camera.name);
  for (const Path& path : paths) names.push_back("path-" + path.name);
  return fileStems(names);
}

bool hasFrames(const std::vector<PathEntry>& paths) {
  return !paths.empty() && !paths.front().runs.empty() && !paths.front().runs.front().frames.empty();
}

}  // namespace

Result<> evaluate(EvaluateOptions options) {
  FARCELL_TRY(checkReferenceSamples(options.referenceSamples));
  FARCELL_ASSIGN(const std::vector<OtherPack> others, parseOtherPacks(options.against));
  FARCELL_ASSIGN(std::vector<RendererPlan> plans, makePlans(options, others));
  FARCELL_ASSIGN(const Packs packs, Packs::open(options.pack, others));
  const PackFile& pack = packs.own();
  options.light = resolvedLight(options, pack);
  FARCELL_TRY(checkLights(options, packs, plans));
  FARCELL_ASSIGN(std::vector<Camera> cameras, loadCameras(options, pack.directory().model));
  FARCELL_ASSIGN(std::vector<Path> paths, loadPaths(options, pack));
  FARCELL_TRY(makeDirectory(options.output));
  FARCELL_TRY(writeTextFile(options.output / "cameras.json", cameraFileText(cameras)));
  FARCELL_ASSIGN(GlContext context, GlContext::createHeadless());
  FARCELL_TRY(applySettings(options, context, plans));
  Progress progress(options.progress);
  FARCELL_ASSIGN(std::optional<MeshReference> mesh, loadMesh(options, pack.directory(), progress));

  std::vector<std::string> stems = stemsOf(cameras, paths);
  Run run{options,
          packs,
          context,
          std::move(mesh),
          std::move(plans),
          std::nullopt,
          std::move(cameras),
          std::move(paths),
          std::move(stems),
          reportFacts(options, packs, context),
          {},
          {},
          {}};
  const Result<> measured = measureAll(run, progress);
  run.facts.complete = measured.has_value();
  setRatios(run.entries);
  for (SunEntries& under : run.sunEntries) setRatios(under.entries);
  if (measured || !run.entries.empty() || hasFrames(run.pathEntries)) FARCELL_TRY(writeReport(run));
  return measured;
}

}  // namespace farcell
