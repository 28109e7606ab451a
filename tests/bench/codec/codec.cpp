// What the page codecs cost and buy on the pages of a real pack, all in memory, one thread, CPU time: every page is
// encoded and decoded again; triangles also go the way of a build, from a list to bytes; and of every so-many-th view
// the bytes are coded by other coders.
// usage: bench_codec <pack> [<views between two for other coders, 0: none>]    CSV on stdout; MB/s are raw; units are
// texels or triangles.
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <string>

#include "cache/pack/encoded_view.h"
#include "cache/pack/pack_file.h"
#include "preprocess/encode/geometry_page.h"
#include "tests/bench/codec/coders.h"
#include "tests/bench/codec/near.h"
#include "tests/bench/codec/reproject.h"
#include "tests/bench/thread_seconds.h"

namespace farcell {
namespace {

struct Totals {
  uint64_t pages = 0;
  uint64_t units = 0;
  uint64_t rawBytes = 0;
  uint64_t storedBytes = 0;
  double encodeSeconds = 0;
  double decodeSeconds = 0;
};

uint64_t unitsOf(const GeometryPage& page) { return page.indices.size() / 3; }
uint64_t unitsOf(const ViewPage& page) {
  uint64_t texels = 0;
  for (const ViewImage& view : page.views) texels += uint64_t{view.width} * view.height;
  return texels;
}

// `encode` and `decode` are the codecs of the page's kind; false when the page does not survive them.
template <class Page, class Encode, class Decode>
bool measure(const Page& page, const Encode& encode, const Decode& decode, Totals& totals) {
  const double start = threadSeconds();
  const std::vector<std::byte> bytes = encode(page);
  const double encoded = threadSeconds();
  const Result<Page> decoded = decode(bytes);
  totals.decodeSeconds += threadSeconds() - encoded;
  totals.encodeSeconds += encoded - start;
  ++totals.pages;
  totals.units += unitsOf(page);
  totals.rawBytes += decodedSizeBytes(page);
  totals.storedBytes += bytes.size();
  return decoded == page;
}

// The steps from a list of triangles to a page's bytes.
struct MeshTotals {
  uint64_t triangles = 0;
  uint64_t bytes = 0;
  double weldSeconds = 0;
  double orderSeconds = 0;
  double encodeSeconds = 0;
};

std::vector<GridTriangle> trianglesOf(const GeometryPage& page) {
  std::vector<GridTriangle> triangles(page.indices.size() / 3);
  for (size_t i = 0; i < page.indices.size(); ++i) {
    GridTriangle& triangle = triangles[i / 3];
    const uint32_t vertex = page.indices[i];
    triangle.corners[i % 3] = GridPoint(page.positions[vertex]);
    triangle.colours[i % 3] = page.colours.empty() ? 0 : page.colours[vertex];
    triangle.normals[i % 3] = page.normals.empty() ? 0 : page.normals[vertex];
  }
  return triangles;
}

void measureMesh(const GeometryPage& page, MeshTotals& totals) {
  const std::vector<GridTriangle> triangles = trianglesOf(page);
  Model model;
  model.hasColours = !page.colours.empty();
  model.hasNormals = !page.normals.empty();
  const double start = threadSeconds();
  const GeometryPage welded = geometryPage(triangles, GridPoint(0), model);
  const double weldedAt = threadSeconds();
  const GeometryPage ordered = optimisedOrder(welded);
  const double orderedAt = threadSeconds();
  const std::vector<std::byte> bytes = encodeGeometryPage(ordered);
  totals.encodeSeconds += threadSeconds() - orderedAt;
  totals.orderSeconds += orderedAt - weldedAt;
  totals.weldSeconds += weldedAt - start;
  totals.triangles += triangles.size();
  totals.bytes += bytes.size();
}

Result<bool> measureGeometry(const PackFile& pack, uint32_t index, Totals& totals, MeshTotals& mesh) {
  FARCELL_ASSIGN(const GeometryPage page, pack.readGeometry(index));
  measureMesh(page, mesh);
  const GeometryLimits limits{1u << kMaxGridBits, decodedSizeBytes(page)};
  return measure(
      page, encodeGeometryPage, [&](const auto& bytes) { return decodeGeometryPage(bytes, limits); }, totals);
}

// Views in order, of which every so-many-th goes to the other coders and is coded with errors.
struct Sampled {
  uint64_t every = 0;
  uint64_t met = 0;
  std::vector<CoderTotals> totals = otherCoders();
  std::vector<NearTotals> near = nearWays();
  ReprojectTotals reprojected = {};
};

// Predicts the view from the one of its page that looks most alike.
void addReprojected(const ViewImage& view, const ViewPage& page, const BuildSettings& settings,
                    ReprojectTotals& totals) {
  const Viewpoints viewpoints = Viewpoints::create(settings.form.views).value();
  const auto cosine = [&](const ViewImage& other) {
    return glm::dot(viewpoints.directions()[view.view], viewpoints.directions()[other.view]);
  };
  const ViewImage* nearest = nullptr;
  for (const ViewImage& other : page.views)
    if (other.width > 0 && other.view != view.view && (nearest == nullptr || cosine(other) > cosine(*nearest)))
      nearest = &other;
  if (nearest != nullptr) addReprojected(view, *nearest, viewpoints, settings.form.imageSize, totals);
}

Result<bool> measureViews(const PackFile& pack, uint32_t index, Totals& totals, Sampled& sampled) {
  FARCELL_ASSIGN(const ViewPage page, pack.readViews(index));
  const BuildSettings& settings = pack.directory().model.settings;
  const ViewLimits limits{static_cast<uint32_t>(settings.form.views), static_cast<uint32_t>(settings.form.imageSize),
                          decodedSizeBytes(page)};
  for (const ViewImage& view : page.views)
    if (view.width > 0 && sampled.every > 0 && sampled.met++ % sampled.every == 0) {
      addNear(view, sampled.near);
      addReprojected(view, page, pack.directory().model.settings, sampled.reprojected);
      addView(view, sampled.totals);
    }
  return measure(
      page, encodeViewPage, [&](const auto& bytes) { return decodeViewPage(bytes, limits); }, totals);
}

void print(const char* kind, const Totals& totals) {
  const auto raw = static_cast<double>(totals.rawBytes), stored = static_cast<double>(totals.storedBytes);
  std::printf("%s,%llu,%llu,%llu,%llu,%.4f,%.4f,%.0f,%.0f\n", kind, static_cast<unsigned long long>(totals.pages),
              static_cast<unsigned long long>(totals.units), static_cast<unsigned long long>(totals.rawBytes),
              static_cast<unsigned long long>(totals.storedBytes), stored / raw,
              stored / static_cast<double>(totals.units), raw / 1e6 / totals.encodeSeconds,
              raw / 1e6 / totals.decodeSeconds);
}

void print(const MeshTotals& totals) {
  const double millions = static_cast<double>(totals.triangles) / 1e6;
  std::printf("\nfrom a list of triangles: %.4f bytes a triangle\nstep,millionTrianglesPerSecond\n",
              static_cast<double>(totals.bytes) / static_cast<double>(totals.triangles));
  std::printf("weld,%.2f\norder,%.2f\nencode,%.2f\nall,%.2f\n", millions / totals.weldSeconds,
              millions / totals.orderSeconds, millions / totals.encodeSeconds,
              millions / (totals.weldSeconds + totals.orderSeconds + totals.encodeSeconds));
}

void print(const std::vector<CoderTotals>& coders) {
  std::puts("\ncoder,level,input,ratio,ofOurs,encodeMBps,decodeMBps");
  for (const CoderTotals& coder : coders) {
    const auto raw = static_cast<double>(coder.rawBytes), stored = static_cast<double>(coder.storedBytes);
    std::printf("%s,%d,%s,%.4f,%.4f,%.0f,%.0f\n", coder.name, coder.level, coder.input, stored / raw,
                stored / static_cast<double>(coders.front().storedBytes), raw / 1e6 / coder.encodeSeconds,
                raw / 1e6 / coder.decodeSeconds);
  }
}

void print(const std::vector<NearTotals>& ways) {
  std::puts(
      "\nmaxError,way,bytes,ofLossless,worstR,worstG,worstB,worstA,worstDepth,rmsR,rmsG,rmsB,rmsA,rmsDepth,"
      "encodeSeconds,decodeSeconds");
  for (const NearTotals& way : ways) {
    std::printf("%d,%s,%llu,%.4f", way.maxError, way.way == NearWay::insidePrediction ? "inside" : "before",
                static_cast<unsigned long long>(way.bytes),
                static_cast<double>(way.bytes) / static_cast<double>(ways.front().bytes));
    for (const int worst : way.worst) std::printf(",%d", worst);
    for (size_t channel = 0; channel < way.squares.size(); ++channel)
      std::printf(",%.3f",
                  std::sqrt(static_cast<double>(way.squares[channel]) / static_cast<double>(way.texels[channel])));
    std::printf(",%.2f,%.2f\n", way.encodeSeconds, way.decodeSeconds);
  }
}

void print(const ReprojectTotals& totals) {
  std::printf("\nreprojected: %llu views, %llu covered texels, %llu of them carried\nstream,ofBuilt\n",
              static_cast<unsigned long long>(totals.views), static_cast<unsigned long long>(totals.texels),
              static_cast<unsigned long long>(totals.carriedTexels));
  const auto share = [&](const char* name, uint64_t bytes) {
    std::printf("%s,%.4f\n", name, static_cast<double>(bytes) / static_cast<double>(totals.builtBytes));
  };
  share("built", totals.builtBytes);
  share("alpha alone", totals.alphaBytes);
  constexpr std::array<const char*, kCarriedWays> kNames = {"none", "alone", "corrected", "judged", "averaged"};
  for (size_t way = 0; way < kCarriedWays; ++way) {
    std::printf("%s: ", kNames[way]);
    share("green", totals.greenBytes[way]);
    std::printf("%s: ", kNames[way]);
    share("depth", totals.depthBytes[way]);
  }
  share("best filters", totals.bestWithoutBytes);
  share("best ways", totals.bestBytes);
}

Result<> run(const char* path, uint64_t every) {
  FARCELL_ASSIGN(const PackFile pack, PackFile::open(path));
  Totals geometry, views;
  MeshTotals mesh;
  Sampled sampled{.every = every};
  for (uint32_t i = 0; i < pack.directory().pages.size(); ++i) {
    const bool isGeometry = pack.directory().pages[i].kind == PageKind::geometry;
    FARCELL_ASSIGN(const bool same,
                   isGeometry ? measureGeometry(pack, i, geometry, mesh) : measureViews(pack, i, views, sampled));
    if (!same) return fail(ErrorKind::corrupt, "{}: page {} does not survive its codec", path, i);
  }
  std::puts("kind,pages,units,rawBytes,storedBytes,ratio,bytesPerUnit,encodeMBps,decodeMBps");
  if (geometry.pages > 0) print("geometry", geometry);
  if (views.pages > 0) print("views", views);
  if (geometry.pages > 0) print(mesh);
  if (sampled.met > 0) {
    print(sampled.near);
    print(sampled.reprojected);
    print(sampled.totals);
  }
  return {};
}

}  // namespace
}  // namespace farcell

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    std::fprintf(stderr, "usage: bench_codec <pack> [<views between two for other coders>]\n");
    return 2;
  }
  const auto result = farcell::run(argv[1], argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 0);
  if (!result) std::fprintf(stderr, "bench_codec: %s\n", result.error().message.c_str());
  return result ? 0 : 1;
}
