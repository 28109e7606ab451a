#include "tools/evaluate/evaluate.h"

#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "cache/base/interrupt.h"
#include "cache/base/progress.h"
#include "runtime/calibration/calibration.h"
#include "tools/evaluate/measure_renderer.h"
#include "tools/evaluate/plan/auto_cameras.h"
#include "tools/evaluate/plan/sweep.h"
#include "tools/evaluate/reference/reference.h"
#include "tools/evaluate/report/names.h"
#include "tools/evaluate/report/page.h"
#include "tools/evaluate/report/pictures.h"
#include "tools/evaluate/report/report.h"
#include "tools/evaluate/report/summary.h"

namespace farcell {
namespace {

// Everything a camera's measurement needs, and what has been measured.
struct Run {
  const EvaluateOptions& options;
  const PackFile& pack;
  GlContext& context;
  std::optional<MeshReference> mesh;
  std::vector<RendererPlan> plans;
  std::vector<Camera> cameras;
  std::vector<std::string> stems;  // of file names, one a camera
  ReportFacts facts;
  std::vector<Entry> entries;  // of finished cameras
};

Result<std::vector<Camera>> loadCameras(const EvaluateOptions& options, const Model& model) {
  std::vector<Camera> cameras;
  if (options.cameras.empty()) {
    FARCELL_ASSIGN(const Viewpoints viewpoints, Viewpoints::create(model.settings.views));
    cameras = autoCameras(model, viewpoints, options.autoCameras);
  } else {
    FARCELL_ASSIGN(cameras, readCameras(options.cameras));
  }
  if (cameras.empty()) return fail(ErrorKind::invalidArgument, "{}: no cameras", options.cameras.string());
  return cameras;
}

Result<std::optional<MeshReference>> loadMesh(const EvaluateOptions& options, const Directory& directory,
                                              Progress& progress) {
  if (options.meshes.empty()) return std::nullopt;
  progress.begin("read mesh", directory.report.inputTriangles, "triangles");
  FARCELL_ASSIGN(MeshReference mesh,
                 MeshReference::load(options.meshes, directory, [&](uint64_t count) { progress.advance(count); }));
  return mesh;
}

Result<ReferenceImage> traceCamera(Run& run, const Camera& camera) {
  const auto start = std::chrono::steady_clock::now();
  ReferenceSettings settings;
  settings.width = run.options.width;
  settings.height = run.options.height;
  settings.samples = run.options.referenceSamples;
  FARCELL_ASSIGN(ReferenceImage image,
                 run.mesh ? run.mesh->trace(camera, settings) : traceReference(run.pack, camera, settings));
  run.facts.referenceSeconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return image;
}

Result<> measureCamera(Run& run, size_t index, Progress& progress) {
  const Camera& camera = run.cameras[index];
  const EvaluateOptions& options = run.options;
  FARCELL_ASSIGN(const ReferenceImage reference, traceCamera(run, camera));
  FARCELL_TRY(writeReferencePicture(options.output, run.stems[index], reference, options.background));
  progress.advance();
  std::vector<Entry> entries;
  for (const RendererPlan& plan : run.plans) {
    FARCELL_TRY(checkInterrupt());
    const MeasureSettings settings{options.timedFrames, options.residentBytes, options.background};
    FARCELL_ASSIGN(Measurement measurement, measureRenderer(run.context, run.pack, camera, plan, reference, settings));
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
  progress.begin("evaluate", run.cameras.size() * (1 + run.plans.size()), "pictures");
  for (size_t i = 0; i < run.cameras.size(); ++i) FARCELL_TRY(measureCamera(run, i, progress));
  progress.end();
  return {};
}

Result<> writeReport(const Run& run) {
  const nlohmann::ordered_json json = reportJson(run.facts, run.entries);
  // Names from outside may hold bytes that are not UTF-8: those are replaced.
  const std::string text = json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  FARCELL_TRY(writeTextFile(run.options.output / "report.json", text));
  FARCELL_TRY(writeTextFile(run.options.output / "report.csv", reportCsv(run.entries)));
  FARCELL_TRY(writeTextFile(run.options.output / "summary.csv", summaryCsv(run.entries)));
  FARCELL_TRY(writeTextFile(run.options.output / "index.html", reportPage(json)));
  std::fputs(run.options.json ? text.c_str() : reportTable(run.entries).c_str(), stdout);
  return {};
}

ReportFacts reportFacts(const EvaluateOptions& options, const PackFile& pack, const GlContext& context) {
  ReportFacts facts;
  facts.packName = options.pack.filename().string();
  facts.packBytes = pack.sizeBytes();
  facts.directory = &pack.directory();
  facts.width = options.width;
  facts.height = options.height;
  facts.timedFrames = options.timedFrames;
  facts.background = options.background;
  facts.glRenderer = context.renderer();
  facts.referenceKind = options.meshes.empty() ? "pack" : "mesh";
  facts.referenceSamples = options.referenceSamples;
  return facts;
}

// Where a time budget is given, what drawing costs on this machine.
Result<> applySettings(const EvaluateOptions& options, GlContext& context, std::vector<RendererPlan>& plans) {
  CostModel costs = kDefaultCosts;
  if (options.selection.timeBudgetMs > 0 || options.recalibrate) {
    FARCELL_ASSIGN(costs, machineCosts(context, options.recalibrate));
  }
  for (RendererPlan& plan : plans) {
    plan.settings.costs = costs;
    plan.settings.occlusion = options.occlusion;
  }
  return {};
}

Result<> makeDirectory(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) return fail(ErrorKind::io, "{}: cannot make the directory: {}", path.string(), error.message());
  return {};
}

std::vector<std::string> cameraStems(const std::vector<Camera>& cameras) {
  std::vector<std::string> names;
  for (const Camera& camera : cameras) names.push_back(camera.name);
  return fileStems(names);
}

}  // namespace

Result<> evaluate(const EvaluateOptions& options) {
  FARCELL_TRY(checkReferenceSamples(options.referenceSamples));
  FARCELL_ASSIGN(std::vector<RendererPlan> plans,
                 planRenderers(options.renderers, options.width, options.height, options.selection, options.lodPixels));
  FARCELL_ASSIGN(plans, sweepRenderers(std::move(plans), options.sweeps));
  FARCELL_ASSIGN(const PackFile pack, PackFile::open(options.pack));
  FARCELL_ASSIGN(std::vector<Camera> cameras, loadCameras(options, pack.directory().model));
  FARCELL_TRY(makeDirectory(options.output));
  FARCELL_TRY(writeTextFile(options.output / "cameras.json", cameraFileText(cameras)));
  FARCELL_ASSIGN(GlContext context, GlContext::createHeadless());
  FARCELL_TRY(applySettings(options, context, plans));
  Progress progress(options.progress);
  FARCELL_ASSIGN(std::optional<MeshReference> mesh, loadMesh(options, pack.directory(), progress));

  std::vector<std::string> stems = cameraStems(cameras);
  Run run{options,
          pack,
          context,
          std::move(mesh),
          std::move(plans),
          std::move(cameras),
          std::move(stems),
          reportFacts(options, pack, context),
          {}};
  const Result<> measured = measureCameras(run, progress);
  run.facts.complete = measured.has_value();
  setRatios(run.entries);
  if (measured || !run.entries.empty()) FARCELL_TRY(writeReport(run));
  return measured;
}

}  // namespace farcell
