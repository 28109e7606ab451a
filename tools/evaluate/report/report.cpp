#include "tools/evaluate/report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "shaders/shared/shading.h"
#include "tools/evaluate/report/fields.h"
#include "tools/evaluate/report/pictures.h"
#include "tools/evaluate/report/summary.h"

namespace farcell {
namespace {

using Json = nlohmann::ordered_json;

Json entryJson(const Entry& entry) {
  const Metrics& m = entry.metrics;
  return {{"camera", entry.camera},
          {"stem", entry.stem},
          {"renderer", entry.renderer.name},
          {"class", entry.renderer.rendererClass},
          {"kind", entry.renderer.kind},
          {"settings", settingsJson(entry.renderer)},
          {"paperErrorSum", m.paperErrorSum},
          {"paperError", m.paperError},
          {"ratioToFull1spp", optionalJson(entry.ratioToFull1spp)},
          {"mae", m.mae},
          {"psnr", m.psnr},
          {"ssim", m.ssim},
          {"flip", m.flip},
          {"p95", m.p95},
          {"p99", m.p99},
          {"holeRate", m.holeRate},
          {"leakRate", m.leakRate},
          {"coverageBias", m.coverageBias},
          {"silhouetteShare", m.silhouetteShare},
          {"interiorShare", m.interiorShare},
          {"impostorShare", m.impostorShare},
          {"frameMs", {{"median", entry.frame.medianMs}, {"p95", entry.frame.p95Ms}, {"max", entry.frame.maxMs}}},
          {"cpuMs", entry.cpuMs},
          {"triangles", entry.triangles},
          {"meshes", entry.meshes},
          {"impostors", entry.impostors},
          {"texels", entry.texels},
          {"bytesRead", entry.bytesRead},
          {"foregroundPixels", m.foregroundPixels},
          {"rectanglePixels", m.rectanglePixels},
          {"diameters", entry.diameters}};
}

Json ratiosJson(const RatioSummary& ratios) {
  return {{"cameras", ratios.cameras},
          {"ratioToFull1spp", optionalJson(ratios.ratioToFull1spp)},
          {"worstRatio", optionalJson(ratios.worstRatio)}};
}

Json summaryJson(const RendererSummary& summary) {
  return {{"class", summary.rendererClass},
          {"kind", summary.kind},
          {"ratioToFull1spp", optionalJson(summary.all.ratioToFull1spp)},
          {"worstRatio", optionalJson(summary.all.worstRatio)},
          {"cameras", summary.all.cameras},
          {"mostlyImpostors", ratiosJson(summary.mostlyImpostors)},
          {"elsewhere", ratiosJson(summary.elsewhere)},
          {"medianFrameMs", summary.medianFrameMs},
          {"medianTriangles", summary.medianTriangles},
          {"medianBytesRead", summary.medianBytesRead},
          {"worstHoleRate", summary.worstHoleRate},
          {"meanFlip", summary.meanFlip},
          {"onParetoFront", summary.onParetoFront},
          {"onKindFront", summary.onKindFront},
          {"onBytesFront", summary.onBytesFront},
          {"onKindBytesFront", summary.onKindBytesFront}};
}

std::string processorName() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(std::min(line.size(), line.find(':') + 2));
  return "unknown";
}

Json packJson(const std::string& fileName, uint64_t bytes, const Directory& directory) {
  const BuildSettings& settings = directory.model.settings;
  return {{"name", fileName},
          {"bytes", bytes},
          {"source", directory.sourceName},
          {"sourceHash", fmt::format("{:016x}", directory.sourceHash)},
          {"triangles", directory.report.inputTriangles},
          {"views", settings.form.views},
          {"imageSize", settings.form.imageSize},
          {"forms", formsName(settings.forms)},
          {"samples", settings.samples},
          {"leafTriangles", settings.leafTriangles},
          {"lighting", settings.lighting == Lighting::relightable ? "relightable" : "baked"}};
}

// By name; with their bytes over those of the pack that is evaluated.
Json againstJson(const ReportFacts& facts) {
  Json json = Json::object();
  for (const OtherPackFacts& other : facts.against) {
    json[other.name] = packJson(other.fileName, other.bytes, *other.directory);
    json[other.name]["bytesToPack"] = static_cast<double>(other.bytes) / static_cast<double>(facts.packBytes);
  }
  return json;
}

// Of a headlight no sun.
Json lightJson(const ReportFacts& facts) {
  const BuildSettings& settings = facts.directory->model.settings;
  const bool isSun = facts.light.kind == LightKind::sun;
  Json json = {{"text", lightText(facts.light, settings)}, {"sun", nullptr}};
  if (isSun) {
    const glm::vec3 sun = lightDirection(facts.light, settings, {});
    json["sun"] = {sun.x, sun.y, sun.z};
  }
  json.update({{"ambient", shared::kAmbient}, {"diffuse", shared::kDiffuse}});
  return json;
}

Json factsJson(const ReportFacts& facts) {
  return {{"version", FARCELL_VERSION},
          {"complete", facts.complete},
          {"pack", packJson(facts.packName, facts.packBytes, *facts.directory)},
          {"against", againstJson(facts)},
          {"size", {facts.width, facts.height}},
          {"background", facts.background},
          {"light", lightJson(facts)},
          {"reference",
           {{"kind", facts.referenceKind}, {"samples", facts.referenceSamples}, {"seconds", facts.referenceSeconds}}},
          {"timedFrames", facts.timedFrames},
          {"psnrCap", kMaxPsnrDb},
          {"flipPixelsPerDegree", kFlipPixelsPerDegree},
          {"differenceGain", kDifferenceGain},
          {"machine", {{"processor", processorName()}, {"threads", std::thread::hardware_concurrency()}}},
          {"gl", facts.glRenderer}};
}

Json summaryLineJson(const RendererSummary& summary) {
  Json json = {{"renderer", summary.renderer}};
  json.update(summaryJson(summary));
  return json;
}

// Of the column of renderers.
size_t nameWidth(const std::vector<Entry>& entries) {
  size_t width = 10;
  for (const Entry& entry : entries) width = std::max(width, entry.renderer.name.size());
  return width;
}

std::string entryLine(const Entry& entry, size_t width) {
  const Metrics& m = entry.metrics;
  return fmt::format(
      "{:<20} {:<{}} {:>8.3f} {:>6} {:>6.2f} {:>6.4f} {:>6.4f} {:>7.3f} {:>7.3f} {:>8.3f} {:>5.2f} {:>9.2f} {:>9} "
      "{:>6}\n",
      printable(entry.camera), entry.renderer.name, width, m.paperError, optionalText(entry.ratioToFull1spp), m.psnr,
      m.ssim, m.flip, 100 * m.holeRate, 100 * m.leakRate, 100 * m.coverageBias, m.impostorShare, entry.frame.medianMs,
      entry.triangles, entry.impostors);
}

std::string summaryLine(const RendererSummary& summary, size_t width) {
  return fmt::format(
      "{:<{}} {:<9} {:>8} {:>8} {:>20} {:>20} {:>9.2f} {:>9.3f} {:>9.0f} {:>5}\n", summary.renderer, width,
      summary.rendererClass, optionalText(summary.all.ratioToFull1spp), optionalText(summary.all.worstRatio),
      fmt::format("{} ({})", optionalText(summary.mostlyImpostors.ratioToFull1spp), summary.mostlyImpostors.cameras),
      fmt::format("{} ({})", optionalText(summary.elsewhere.ratioToFull1spp), summary.elsewhere.cameras),
      summary.medianFrameMs, 100 * summary.worstHoleRate, summary.medianTriangles, summary.onParetoFront ? "*" : "");
}

}  // namespace

Json reportJson(const ReportFacts& facts, const std::vector<Entry>& entries) {
  Json json = factsJson(facts);
  json["entries"] = Json::array();
  for (const Entry& entry : entries) json["entries"].push_back(entryJson(entry));
  json["summary"] = Json::object();
  for (const RendererSummary& summary : summarise(entries)) json["summary"][summary.renderer] = summaryJson(summary);
  return json;
}

std::string reportCsv(const std::vector<Entry>& entries) {
  std::string text = csvLine(entryJson({}), true);
  for (const Entry& entry : entries) text += csvLine(entryJson(entry), false);
  return text;
}

std::string summaryCsv(const std::vector<Entry>& entries) {
  std::string text = csvLine(summaryLineJson({}), true);
  for (const RendererSummary& summary : summarise(entries)) text += csvLine(summaryLineJson(summary), false);
  return text;
}

std::string reportTable(const std::vector<Entry>& entries) {
  const size_t width = nameWidth(entries);
  std::string text =
      fmt::format("{:<20} {:<{}} {:>8} {:>6} {:>6} {:>6} {:>6} {:>7} {:>7} {:>8} {:>5} {:>9} {:>9} {:>6}\n", "camera",
                  "renderer", width, "error", "ratio", "psnr", "ssim", "flip", "hole %", "leak %", "cover %", "imp.",
                  "frame ms", "triangles", "cells");
  for (const Entry& entry : entries) text += entryLine(entry, width);
  text +=
      fmt::format("\n{:<{}} {:<9} {:>8} {:>8} {:>20} {:>20} {:>9} {:>9} {:>9} {:>5}\n", "renderer", width, "class",
                  "ratio", "worst", "impostors >= .8 (n)", "elsewhere (n)", "frame ms", "hole %", "triangles", "front");
  for (const RendererSummary& summary : summarise(entries)) text += summaryLine(summary, width);
  return text;
}

}  // namespace farcell
