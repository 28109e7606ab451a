#include "tests/bench/wscg2010/measure/errors.h"

#include <memory>
#include <optional>

#include "cache/base/interrupt.h"
#include "cache/base/parallel.h"

namespace farcell::wscg {
namespace {

struct Truth {
  ReferenceImage single, traced;
};

std::vector<glm::dvec3> eyesOf(const std::vector<ErrorCamera>& cameras) {
  std::vector<glm::dvec3> eyes;
  for (const ErrorCamera& camera : cameras) eyes.push_back(camera.camera.position);
  return eyes;
}

// Everything that is the same for all variants of a scene.
struct Stage {
  const Scene& scene;
  const FullGeometry& full;
  std::vector<ErrorCamera> cameras;
  Painter painter;
  std::vector<Truth> truths;
};

ErrorRow rowOf(const Stage& stage, size_t camera, const std::string& variant, size_t billboards) {
  const ErrorCamera& at = stage.cameras[camera];
  return {stage.scene.name, variant, at.camera.name, at.distance, at.steep, billboards, {}, {}};
}

// Pictures are drawn one after the other, then measured on all threads.
void measureAll(const Stage& stage, const std::vector<FrameImage>& frames, std::vector<ErrorRow>& rows) {
  const size_t first = rows.size() - frames.size();
  parallelFor(frames.size(), threadCount(0), [&](size_t i, int) {
    rows[first + i].toSingle = measureFrame(stage.truths[i].single, frames[i]);
    rows[first + i].toTruth = measureFrame(stage.truths[i].traced, frames[i]);
  });
}

void measureTriangles(Stage& stage, const ErrorSettings& settings, ErrorResults& results) {
  std::vector<FrameImage> frames;
  for (size_t i = 0; i < stage.cameras.size(); ++i) {
    const Camera& camera = stage.cameras[i].camera;
    frames.push_back(stage.full.draw(stage.painter, camera));
    stage.truths.push_back(
        {referenceOf(frames.back()), stage.full.trace(camera, settings.width, settings.height, settings.truthSamples)});
    results.rows.push_back(rowOf(stage, i, kTrianglesVariant, 0));
  }
  measureAll(stage, frames, results.rows);
}

void measureVariant(Stage& stage, const ImpostorSet& impostors, const Variant& variant, ErrorResults& results) {
  std::vector<FrameImage> frames;
  for (size_t i = 0; i < stage.cameras.size(); ++i) {
    const std::vector<Billboard> billboards = impostors.seenFrom(stage.cameras[i].camera.position);
    stage.painter.begin(stage.cameras[i].camera);
    stage.painter.drawBillboards(billboards, variant.draw);
    frames.push_back(stage.painter.read());
    results.rows.push_back(rowOf(stage, i, variant.name, billboards.size()));
  }
  measureAll(stage, frames, results.rows);
}

double meanOf(const ErrorResults& results, const std::string& scene, const std::string& variant, double distance,
              bool steep, double (*figure)(const ErrorRow&)) {
  std::vector<double> values;
  for (const ErrorRow& row : results.rows) {
    const bool here = distance < 0 || row.distance == distance;
    if (row.scene == scene && row.variant == variant && row.steep == steep && here) values.push_back(figure(row));
  }
  return mean(values);
}

}  // namespace

Result<ErrorResults> measureErrors(const Scene& scene, const FullGeometry& full, const ErrorSettings& settings) {
  FARCELL_ASSIGN(Painter painter, Painter::create(settings.width, settings.height));
  Stage stage{scene, full, errorCameras(scene, settings.distances, settings.levelDirections), std::move(painter), {}};
  ErrorResults results;
  measureTriangles(stage, settings, results);
  const std::vector<glm::dvec3> eyes = eyesOf(stage.cameras);
  std::unique_ptr<CellIndex> index;
  std::optional<ImpostorSet> impostors;
  for (const Variant& variant : settings.variants) {
    FARCELL_TRY(checkInterrupt());
    if (!index || index->depth() != variant.depth) {
      impostors.reset();
      index = std::make_unique<CellIndex>(scene, variant.depth);
      results.cells.push_back({scene.name, variant.depth, index->occupied().size()});
    }
    if (!impostors || !(impostors->settings() == variant.impostors)) {
      impostors.reset();
      FARCELL_ASSIGN(impostors, ImpostorSet::bake(*index, variant.impostors, eyes));
    }
    measureVariant(stage, *impostors, variant, results);
  }
  return results;
}

double meanOver(const ErrorResults& results, const std::string& scene, const std::string& variant, double distance,
                double (*figure)(const ErrorRow&)) {
  return meanOf(results, scene, variant, distance, false, figure);
}

double steepOver(const ErrorResults& results, const std::string& scene, const std::string& variant, double distance,
                 double (*figure)(const ErrorRow&)) {
  return meanOf(results, scene, variant, distance, true, figure);
}

double toSingle(const ErrorRow& row) { return row.toSingle.paperError; }
double toTruth(const ErrorRow& row) { return row.toTruth.paperError; }
double holes(const ErrorRow& row) { return row.toSingle.holeRate; }
double leaks(const ErrorRow& row) { return row.toSingle.leakRate; }

Table errorCsv(const ErrorResults& results) {
  Table table{{"scene", "variant", "camera", "distanceDiameters", "billboards", "paperErrorTo1Sample",
               "paperErrorSumTo1Sample", "paperErrorToTruth", "psnrToTruth", "holeRate", "leakRate", "rectanglePixels"},
              {}};
  for (const ErrorRow& row : results.rows) {
    std::string variant = row.variant;
    for (char& c : variant) c = c == ',' ? ';' : c;
    table.rows.push_back({row.scene, variant, row.camera, number(row.distance, 1), fmt::format("{}", row.billboards),
                          number(row.toSingle.paperError, 3), number(row.toSingle.paperErrorSum, 0),
                          number(row.toTruth.paperError, 3), number(row.toTruth.psnr, 2),
                          number(row.toSingle.holeRate, 6), number(row.toSingle.leakRate, 6),
                          fmt::format("{}", row.toSingle.rectanglePixels)});
  }
  return table;
}

}  // namespace farcell::wscg
