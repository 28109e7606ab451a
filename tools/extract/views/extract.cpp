#include "tools/extract/views/extract.h"

#include <algorithm>
#include <cmath>
#include <system_error>

#include "cache/base/file.h"
#include "cache/base/interrupt.h"
#include "cache/schema/viewpoints.h"
#include "tools/extract/image/image_file.h"

namespace farcell {
namespace {

using Json = nlohmann::ordered_json;

const char* nameOf(ViewChannel channel) {
  switch (channel) {
    case ViewChannel::colour:
      return "colour";
    case ViewChannel::coverage:
      return "coverage";
    case ViewChannel::depth:
      return "depth";
    case ViewChannel::normal:
      return "normal";
  }
  return "";
}

class Extractor {
 public:
  Extractor(const PackFile& pack, const ExtractSettings& settings)
      : pack_(pack), directory_(pack.directory()), settings_(settings) {}

  Result<Json> run() {
    FARCELL_TRY(checkLimits());
    std::error_code code;
    std::filesystem::create_directories(settings_.directory, code);
    if (code) return fail(ErrorKind::io, "{}: {}", settings_.directory.string(), code.message());
    Json files = Json::array();
    for (const uint32_t cell : settings_.cells) {
      FARCELL_ASSIGN(const std::vector<ViewImage> views, wantedViews(cell));
      empty_ += viewsOf(cell).size() - views.size();
      FARCELL_TRY(settings_.atlas ? writeAtlas(cell, views, files) : writeViews(cell, views, files));
    }
    return Json{{"written", files}, {"empty", empty_}};
  }

 private:
  const ViewForm& formOf(uint32_t cell) const { return directory_.cells[cell].form; }
  // Of those that are asked for, the ones of the cell's set.
  std::span<const uint32_t> viewsOf(uint32_t cell) const {
    const auto end = std::lower_bound(settings_.views.begin(), settings_.views.end(), formOf(cell).views,
                                      [](uint32_t view, int count) { return static_cast<int>(view) < count; });
    return {settings_.views.begin(), end};
  }
  int columns(uint32_t cell) const {
    return static_cast<int>(std::ceil(std::sqrt(static_cast<double>(viewsOf(cell).size()))));
  }
  int rows(uint32_t cell) const { return (static_cast<int>(viewsOf(cell).size()) + columns(cell) - 1) / columns(cell); }

  Result<> checkLimits() const {
    if (settings_.channel == ViewChannel::normal && directory_.model.settings.lighting == Lighting::baked)
      return fail(ErrorKind::unsupported, "{}: the views of a pack of baked light have no normals", pack_.path());
    uint64_t files = 0;
    for (const uint32_t cell : settings_.cells) files += settings_.atlas ? 1 : viewsOf(cell).size();
    if (files > kMaxExtractedFiles)
      return fail(ErrorKind::exhausted, "{} pictures: at most {} are written at once; choose cells or views", files,
                  kMaxExtractedFiles);
    for (const uint32_t cell : settings_.cells) {
      const int imageSize = formOf(cell).imageSize;
      if (settings_.atlas && columns(cell) * imageSize > kMaxAtlasEdge)
        return fail(ErrorKind::exhausted,
                    "an atlas of {} views of {} texels: its edge would be {}, at most {} is allowed",
                    viewsOf(cell).size(), imageSize, columns(cell) * imageSize, kMaxAtlasEdge);
    }
    return {};
  }

  // Those that hold anything, by rising view.
  Result<std::vector<ViewImage>> wantedViews(uint32_t cell) const {
    const CellRecord& record = directory_.cells[cell];
    std::vector<ViewImage> result;
    if (record.firstViewPage == kNone) return result;
    for (uint32_t page = record.firstViewPage; page < record.firstViewPage + record.viewPageCount; ++page) {
      FARCELL_TRY(checkInterrupt());
      const uint32_t group = directory_.pages[page].group;
      const bool wanted = std::any_of(settings_.views.begin(), settings_.views.end(), [&](uint32_t view) {
        return static_cast<uint32_t>(Viewpoints::of(record.form.views).group(static_cast<int>(view))) == group;
      });
      if (!wanted) continue;
      FARCELL_ASSIGN(ViewPage content, pack_.readViews(page));
      for (ViewImage& view : content.views)
        if (view.width > 0 && std::binary_search(settings_.views.begin(), settings_.views.end(), view.view))
          result.push_back(std::move(view));
    }
    std::sort(result.begin(), result.end(), [](const auto& l, const auto& r) { return l.view < r.view; });
    return result;
  }

  Json cellJson(uint32_t cell, const std::string& file) const {
    const CellKey& key = directory_.cells[cell].key;
    return {{"file", file},
            {"channel", nameOf(settings_.channel)},
            {"cell", cell},
            {"key", fmt::format("{}/{}/{}/{}", key.level, key.x, key.y, key.z)}};
  }
  // (x, y): where the upper left corner of its rectangle lies in the picture.
  Json viewJson(uint32_t cell, const ViewImage& view, int x, int y) const {
    const glm::dvec3 d = Viewpoints::of(formOf(cell).views).directions()[view.view];
    return {{"view", view.view},
            {"direction", {d.x, d.y, d.z}},
            {"rectangle", {x, y, view.width, view.height}},
            {"image", {view.x0, view.y0, view.width, view.height}},
            {"depth", {view.depthMin, view.depthMax}}};
  }
  // Where a view's rectangle lies in its square, from the top.
  int topOf(uint32_t cell, const ViewImage& view) const {
    return formOf(cell).imageSize - static_cast<int>(view.y0 + view.height);
  }

  Result<> writeViews(uint32_t cell, const std::vector<ViewImage>& views, Json& files) const {
    for (const ViewImage& view : views) {
      const auto path = settings_.directory / fmt::format("cell-{}-view-{}-{}.{}", cell, view.view,
                                                          nameOf(settings_.channel), settings_.format);
      Picture picture = viewPicture(view, settings_.channel);
      int x = 0, y = 0;
      if (settings_.full) {
        x = static_cast<int>(view.x0);
        y = topOf(cell, view);
        Picture square = blankPicture(formOf(cell).imageSize, formOf(cell).imageSize, picture.channels);
        place(picture, x, y, square);
        picture = std::move(square);
      }
      FARCELL_TRY(writeImageFile(path, picture));
      Json file = cellJson(cell, path.string());
      file.update(viewJson(cell, view, x, y));
      files.push_back(std::move(file));
    }
    return {};
  }

  // A view's tile is its place among the wanted ones, whichever of them are empty.
  Result<> writeAtlas(uint32_t cell, const std::vector<ViewImage>& views, Json& files) const {
    if (views.empty()) return {};
    const int imageSize = formOf(cell).imageSize, across = columns(cell);
    Picture atlas = blankPicture(across * imageSize, rows(cell) * imageSize, channelCount(settings_.channel));
    const std::string name = fmt::format("cell-{}-{}", cell, nameOf(settings_.channel));
    const std::filesystem::path path = settings_.directory / (name + "." + settings_.format);
    Json file = cellJson(cell, path.string());
    Json tiles = Json::array();
    for (const ViewImage& view : views) {
      const auto at = std::lower_bound(settings_.views.begin(), settings_.views.end(), view.view);
      const int tile = static_cast<int>(at - settings_.views.begin());
      const int x = tile % across * imageSize + static_cast<int>(view.x0);
      const int y = tile / across * imageSize + topOf(cell, view);
      place(viewPicture(view, settings_.channel), x, y, atlas);
      tiles.push_back(viewJson(cell, view, x, y));
    }
    file["views"] = std::move(tiles);
    FARCELL_TRY(writeImageFile(path, atlas));
    FARCELL_TRY(writeTextFile(settings_.directory / (name + ".json"), file.dump(2) + "\n"));
    files.push_back(std::move(file));
    return {};
  }

  const PackFile& pack_;
  const Directory& directory_;
  const ExtractSettings& settings_;
  uint64_t empty_ = 0;
};

}  // namespace

Result<Json> extractViews(const PackFile& pack, const ExtractSettings& settings) {
  return Extractor(pack, settings).run();
}

}  // namespace farcell
