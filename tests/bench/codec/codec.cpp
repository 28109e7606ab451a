// What the page codecs cost and buy on the pages of a real pack: every page is decoded and encoded again, one thread.
// usage: bench_codec <pack>    CSV on stdout; raw MB/s of CPU time; units are texels or triangles.
#include <time.h>

#include <cstdio>
#include <string>

#include "cache/pack/pack_file.h"

namespace farcell {
namespace {

double threadSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

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

Result<bool> measureGeometry(const PackFile& pack, uint32_t index, Totals& totals) {
  FARCELL_ASSIGN(const GeometryPage page, pack.readGeometry(index));
  const GeometryLimits limits{1u << kMaxGridBits, decodedSizeBytes(page)};
  return measure(
      page, encodeGeometryPage, [&](const auto& bytes) { return decodeGeometryPage(bytes, limits); }, totals);
}

Result<bool> measureViews(const PackFile& pack, uint32_t index, Totals& totals) {
  FARCELL_ASSIGN(const ViewPage page, pack.readViews(index));
  const BuildSettings& settings = pack.directory().model.settings;
  const ViewLimits limits{static_cast<uint32_t>(settings.views), static_cast<uint32_t>(settings.imageSize),
                          decodedSizeBytes(page)};
  return measure(
      page, encodeViewPage, [&](const auto& bytes) { return decodeViewPage(bytes, limits); }, totals);
}

void print(const char* kind, const Totals& totals) {
  const auto raw = static_cast<double>(totals.rawBytes), stored = static_cast<double>(totals.storedBytes);
  std::printf("%s,%llu,%llu,%llu,%llu,%.3f,%.4f,%.0f,%.0f\n", kind, static_cast<unsigned long long>(totals.pages),
              static_cast<unsigned long long>(totals.units), static_cast<unsigned long long>(totals.rawBytes),
              static_cast<unsigned long long>(totals.storedBytes), stored / raw,
              stored / static_cast<double>(totals.units), raw / 1e6 / totals.encodeSeconds,
              raw / 1e6 / totals.decodeSeconds);
}

Result<> run(const char* path) {
  FARCELL_ASSIGN(const PackFile pack, PackFile::open(path));
  Totals geometry, views;
  for (uint32_t i = 0; i < pack.directory().pages.size(); ++i) {
    const bool isGeometry = pack.directory().pages[i].kind == PageKind::geometry;
    FARCELL_ASSIGN(const bool same, isGeometry ? measureGeometry(pack, i, geometry) : measureViews(pack, i, views));
    if (!same) return fail(ErrorKind::corrupt, "{}: page {} does not survive its codec", path, i);
  }
  std::puts("kind,pages,units,rawBytes,storedBytes,ratio,bytesPerUnit,encodeMBps,decodeMBps");
  if (geometry.pages > 0) print("geometry", geometry);
  if (views.pages > 0) print("views", views);
  return {};
}

}  // namespace
}  // namespace farcell

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: bench_codec <pack>\n");
    return 2;
  }
  const auto result = farcell::run(argv[1]);
  if (!result) std::fprintf(stderr, "bench_codec: %s\n", result.error().message.c_str());
  return result ? 0 : 1;
}
