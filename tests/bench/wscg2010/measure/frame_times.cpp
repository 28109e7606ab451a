#include "tests/bench/wscg2010/measure/frame_times.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>

#include "cache/base/interrupt.h"
#include "tests/bench/wscg2010/measure/image_store.h"

namespace farcell::wscg {
namespace {

class Stopwatch {
 public:
  double lapMs() {
    const auto now = std::chrono::steady_clock::now();
    const double ms = std::chrono::duration<double, std::milli>(now - last_).count();
    last_ = now;
    return ms;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

std::vector<Camera> turn(const Scene& scene, const TimeSettings& settings) {
  const glm::dvec3 east(scene.up.y, scene.up.z, scene.up.x), north = glm::cross(scene.up, east);
  const double elevation = settings.elevationDeg * std::numbers::pi / 180;
  std::vector<Camera> cameras;
  for (int frame = 0; frame < settings.frames; ++frame) {
    const double azimuth = 2 * std::numbers::pi * frame / settings.frames;
    const glm::dvec3 along = east * std::cos(azimuth) + north * std::sin(azimuth);
    cameras.push_back(
        orbitCamera(scene, scene.up * std::sin(elevation) + along * std::cos(elevation), settings.distance));
  }
  return cameras;
}

struct Frame {
  Camera camera;
  std::vector<Billboard> billboards;
};

// Times of one frame.
struct Lap {
  double readMs = 0, inflateMs = 0, uploadMs = 0, drawMs = 0;
  double totalMs() const { return readMs + inflateMs + uploadMs + drawMs; }
};

// A frame's textures, made from what a source gives.
class Textures {
 public:
  void fromMemory(const Frame& frame, Lap& lap) {
    Stopwatch watch;
    for (const Billboard& billboard : frame.billboards)
      textures_.push_back(
          uploadImage(billboard.image->width, billboard.image->height, billboard.image->rgba, Filter::linear));
    lap.uploadMs += watch.lapMs();
  }
  Result<> fromStore(const Frame& frame, const ImageStore& store, Lap& lap) {
    Stopwatch watch;
    for (const Billboard& billboard : frame.billboards) {
      FARCELL_TRY(store.read(billboard, bytes_));
      lap.readMs += watch.lapMs();
      if (store.deflated()) FARCELL_TRY(store.decode(billboard, bytes_, texels_));
      lap.inflateMs += watch.lapMs();
      const auto raw = std::span(reinterpret_cast<const uint8_t*>(bytes_.data()), bytes_.size());
      const auto pixels = store.deflated() ? std::span<const uint8_t>(texels_) : raw;
      textures_.push_back(uploadImage(billboard.image->width, billboard.image->height, pixels, Filter::linear));
      lap.uploadMs += watch.lapMs();
    }
    return {};
  }
  void draw(const Frame& frame, Painter& painter, const DrawSettings& settings, Lap& lap) const {
    Stopwatch watch;
    painter.begin(frame.camera);
    painter.beginBillboards(settings);
    for (size_t i = 0; i < textures_.size(); ++i) painter.drawBillboard(frame.billboards[i], textures_[i]);
    painter.finish();
    lap.drawMs += watch.lapMs();
  }
  void drop() { textures_.clear(); }

 private:
  std::vector<GlTexture> textures_;
  std::vector<std::byte> bytes_;
  std::vector<uint8_t> texels_;
};

struct Bench {
  const FullGeometry& full;
  const Variant& variant;
  std::vector<Frame> frames;
  Painter painter;
  const ImageStore& raw;
  const ImageStore& deflated;

  const ImageStore* storeOf(Source source) const {
    if (source == Source::diskWarm || source == Source::diskCold) return &raw;
    if (source == Source::deflatedWarm || source == Source::deflatedCold) return &deflated;
    return nullptr;
  }
};

bool isCold(Source source) { return source == Source::diskCold || source == Source::deflatedCold; }

Lap drawFull(Bench& bench, const Frame& frame) {
  Lap lap;
  Stopwatch watch;
  bench.painter.begin(frame.camera);
  bench.painter.drawTriangles(bench.full.triangles());
  bench.painter.finish();
  lap.drawMs = watch.lapMs();
  return lap;
}

Result<Lap> drawFrame(Bench& bench, const Frame& frame, Source source, TimeRow& row) {
  if (source == Source::triangles) return drawFull(bench, frame);
  const ImageStore* store = bench.storeOf(source);
  if (isCold(source)) {
    FARCELL_ASSIGN(const double share, store->dropFromMemory());
    row.inMemory = std::max(row.inMemory, share);
  }
  Lap lap;
  Textures textures;
  if (store != nullptr) {
    FARCELL_TRY(textures.fromStore(frame, *store, lap));
  } else {
    textures.fromMemory(frame, lap);
  }
  if (source == Source::resident) {
    textures.draw(frame, bench.painter, bench.variant.draw, lap);  // has them moved to where they are drawn from
    lap = {};
  }
  textures.draw(frame, bench.painter, bench.variant.draw, lap);
  Stopwatch watch;
  textures.drop();
  if (source != Source::resident) lap.uploadMs += watch.lapMs();
  return lap;
}

Result<> countBytes(const Bench& bench, TimeRow& row) {
  std::vector<double> items, textureBytes, readBytes, changed;
  std::set<std::pair<uint32_t, int>> before;
  std::vector<std::byte> bytes;
  for (const Frame& frame : bench.frames) {
    double texture = 0, read = 0, fresh = 0;
    std::set<std::pair<uint32_t, int>> now;
    for (const Billboard& billboard : frame.billboards) {
      texture += static_cast<double>(billboard.image->rgba.size());
      now.emplace(billboard.cell, billboard.view);
      fresh += before.contains({billboard.cell, billboard.view}) ? 0 : 1;
      if (const ImageStore* store = bench.storeOf(row.source)) {
        FARCELL_ASSIGN(const size_t size, store->read(billboard, bytes));
        read += static_cast<double>(size);
      }
    }
    if (!before.empty() && !now.empty()) changed.push_back(fresh / static_cast<double>(now.size()));
    before = std::move(now);
    items.push_back(static_cast<double>(frame.billboards.size()));
    textureBytes.push_back(texture);
    readBytes.push_back(read);
  }
  row.items = mean(items);
  row.textureBytes = mean(textureBytes);
  row.readBytes = mean(readBytes);
  row.newImages = mean(changed);
  return {};
}

Result<TimeRow> timeSource(Bench& bench, const std::string& scene, Source source) {
  TimeRow row;
  row.scene = scene;
  row.variant = bench.variant.name;
  row.source = source;
  if (source == Source::triangles) {
    row.items = bench.full.triangles().count / 3.0;
  } else {
    FARCELL_TRY(countBytes(bench, row));  // reads every file once: warm
  }
  FARCELL_TRY(drawFrame(bench, bench.frames.front(), source, row));  // compiles
  std::vector<double> total, read, inflate, upload, draw;
  for (const Frame& frame : bench.frames) {
    FARCELL_TRY(checkInterrupt());
    FARCELL_ASSIGN(const Lap lap, drawFrame(bench, frame, source, row));
    total.push_back(lap.totalMs());
    read.push_back(lap.readMs);
    inflate.push_back(lap.inflateMs);
    upload.push_back(lap.uploadMs);
    draw.push_back(lap.drawMs);
  }
  row.frameMs = median(total);
  row.readMs = median(read);
  row.inflateMs = median(inflate);
  row.uploadMs = median(upload);
  row.drawMs = median(draw);
  return row;
}

}  // namespace

const char* sourceName(Source source) {
  constexpr std::array<const char*, kSourceCount> kNames = {
      "triangles",      "images resident", "images uploaded anew", "read from disk, warm", "read from disk, cold",
      "deflated, warm", "deflated, cold"};
  return kNames[static_cast<size_t>(source)];
}

Result<std::vector<TimeRow>> measureTimes(const CellIndex& index, const FullGeometry& full, const Variant& variant,
                                          const TimeSettings& settings) {
  FARCELL_ASSIGN(Painter painter, Painter::create(settings.width, settings.height));
  const std::vector<Camera> cameras = turn(index.scene(), settings);
  std::vector<glm::dvec3> eyes;
  for (const Camera& camera : cameras) eyes.push_back(camera.position);
  FARCELL_ASSIGN(const ImpostorSet impostors, ImpostorSet::bake(index, variant.impostors, eyes));
  std::vector<Frame> frames;
  std::vector<Billboard> all;
  for (const Camera& camera : cameras) {
    frames.push_back({camera, impostors.seenFrom(camera.position)});
    all.insert(all.end(), frames.back().billboards.begin(), frames.back().billboards.end());
  }
  const auto path = [&](const char* kind) {
    return settings.scratchDirectory / fmt::format("{}.{}.images", index.scene().name, kind);
  };
  FARCELL_ASSIGN(const ImageStore raw, ImageStore::write(path("raw"), all, false));
  FARCELL_ASSIGN(const ImageStore deflated, ImageStore::write(path("deflated"), all, true));
  Bench bench{full, variant, std::move(frames), std::move(painter), raw, deflated};
  std::vector<TimeRow> rows;
  for (size_t source = 0; source < kSourceCount; ++source) {
    FARCELL_ASSIGN(TimeRow row, timeSource(bench, index.scene().name, static_cast<Source>(source)));
    rows.push_back(std::move(row));
  }
  for (const char* kind : {"raw", "deflated"}) std::filesystem::remove(path(kind));
  return rows;
}

const TimeRow* findTime(const std::vector<TimeRow>& rows, const std::string& scene, Source source) {
  for (const TimeRow& row : rows)
    if (row.scene == scene && row.source == source) return &row;
  return nullptr;
}

std::string boundOf(const TimeRow& row) {
  const std::array<std::pair<double, const char*>, 4> parts = {
      {{row.drawMs, "draw"}, {row.uploadMs, "upload"}, {row.readMs, "read"}, {row.inflateMs, "inflate"}}};
  return std::max_element(parts.begin(), parts.end())->second;
}

}  // namespace farcell::wscg
