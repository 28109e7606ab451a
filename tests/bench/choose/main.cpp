// bench_choose: what a build would leave out, tried on a finished pack: which views go, why and what that saves; and
// the pack without them, to be evaluated.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>

#include "cache/pack/pack_file.h"
#include "preprocess/choose/choose.h"
#include "preprocess/choose/visitable.h"

namespace farcell {
namespace {

struct Arguments {
  std::string pack, output, cells, visitable = "everywhere", rule = "worth";
  std::vector<uint64_t> budgets;
  double leastWorth = kLeastWorthPerByte;
};

// Everything of a pack that choosing looks at.
struct Measured {
  std::vector<ViewCost> views;
  std::vector<uint32_t> geometryBytes;
};

Result<Measured> measure(const PackFile& pack) {
  constexpr size_t kPageOfOneBytes = 8 + 32;  // FORMAT.md
  const Directory& directory = pack.directory();
  Measured measured;
  for (uint32_t cell = 0; cell < directory.cells.size(); ++cell) {
    const CellRecord& record = directory.cells[cell];
    measured.geometryBytes.push_back(0);
    for (uint32_t page = record.firstGeometryPage; page < record.firstGeometryPage + record.geometryPageCount; ++page)
      measured.geometryBytes.back() += directory.pages[page].storedBytes;
    const size_t first = measured.views.size();
    for (uint32_t page = record.firstViewPage; page < record.firstViewPage + record.viewPageCount; ++page) {
      FARCELL_ASSIGN(const ViewPage content, pack.readViews(page));
      for (const ViewImage& view : content.views)
        measured.views.push_back({cell, view.view,
                                  static_cast<uint32_t>(encodeViewPage({{view}}).size() - kPageOfOneBytes),
                                  view.width * view.height});
    }
    std::sort(measured.views.begin() + static_cast<std::ptrdiff_t>(first), measured.views.end(),
              [](const ViewCost& l, const ViewCost& r) { return l.view < r.view; });
  }
  return measured;
}

Result<uint64_t> write(const PackFile& pack, const std::vector<std::vector<bool>>& keep, const std::string& path) {
  Directory directory = pack.directory();
  FARCELL_ASSIGN(PackWriter writer, PackWriter::create(path));
  for (uint32_t cell = 0; cell < directory.cells.size(); ++cell) {
    CellRecord& record = directory.cells[cell];
    const CellRecord was = record;
    record.firstViewPage = kNone;
    record.viewPageCount = 0;
    for (uint32_t part = 0; part < was.geometryPageCount; ++part) {
      FARCELL_ASSIGN(const GeometryPage page, pack.readGeometry(was.firstGeometryPage + part));
      FARCELL_ASSIGN(const uint32_t index,
                     writer.add(PageKind::geometry, cell, part, decodedSizeBytes(page), encodeGeometryPage(page)));
      if (part == 0) record.firstGeometryPage = index;
    }
    for (uint32_t page = was.firstViewPage; page < was.firstViewPage + was.viewPageCount; ++page) {
      FARCELL_ASSIGN(ViewPage content, pack.readViews(page));
      std::erase_if(content.views, [&](const ViewImage& view) { return !keep[cell][view.view]; });
      if (content.views.empty()) continue;
      FARCELL_ASSIGN(const uint32_t index, writer.add(PageKind::views, cell, pack.directory().pages[page].group,
                                                      decodedSizeBytes(content), encodeViewPage(content)));
      if (record.viewPageCount++ == 0) record.firstViewPage = index;
    }
  }
  return writer.finish(std::move(directory));
}

void printCells(const std::string& path, const Directory& directory, std::span<const ViewCost> views,
                std::span<const ViewFate> fates) {
  struct Sum {
    uint64_t bytes = 0, texels = 0, views = 0;
    ViewFate fate = ViewFate::empty;
  };
  std::vector<Sum> sums(directory.cells.size());
  for (size_t i = 0; i < views.size(); ++i) {
    Sum& sum = sums[views[i].cell];
    sum.bytes += views[i].bytes;
    sum.texels += views[i].texels;
    ++sum.views;
    sum.fate = fates[i];
  }
  std::FILE* out = std::fopen(path.c_str(), "w");
  if (out == nullptr) return;
  fmt::print(out, "cell,level,children,triangles,views,bytes,texels,fate\n");
  for (size_t cell = 0; cell < sums.size(); ++cell) {
    const CellRecord& record = directory.cells[cell];
    fmt::print(out, "{},{},{},{},{},{},{},{}\n", cell, record.key.level, record.childCount, record.triangles,
               sums[cell].views, sums[cell].bytes, sums[cell].texels, nameOf(sums[cell].fate));
  }
  std::fclose(out);
}

Result<> bench(const Arguments& arguments) {
  FARCELL_ASSIGN(const PackFile pack, PackFile::open(arguments.pack));
  const Directory& directory = pack.directory();
  FARCELL_ASSIGN(const Viewpoints viewpoints, Viewpoints::create(directory.model.settings.form.views));
  FARCELL_ASSIGN(const Region region, readRegion(arguments.visitable, directory.model.settings.metresPerUnit));
  FARCELL_ASSIGN(Measured measured, measure(pack));
  const auto start = std::chrono::steady_clock::now();
  const Visitable visitable(region, directory.model, directory.cells, viewpoints);
  std::vector<std::vector<bool>> seen;
  for (const CellRecord& cell : directory.cells) seen.push_back(visitable.seen(cell));
  const double visitableMs =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  std::erase_if(measured.views, [&](const ViewCost& view) { return !seen[view.cell][view.view]; });

  std::vector<std::optional<uint64_t>> budgets(arguments.budgets.begin(), arguments.budgets.end());
  if (budgets.empty()) budgets.push_back(std::nullopt);
  for (const std::optional<uint64_t>& budget : budgets) {
    const ChooseInput input{directory.cells, measured.geometryBytes, measured.views};
    const BudgetRule rule = arguments.rule == "worth" ? BudgetRule::worth : BudgetRule::triangles;
    const auto chooseStart = std::chrono::steady_clock::now();
    FARCELL_ASSIGN(const Choice choice, chooseViews(input, {arguments.leastWorth, budget, rule}));
    const double chooseMs =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - chooseStart).count();
    fmt::print(
        "{} visitable {} budget {} rule {}: pack {} of {} bytes, modelled {:.0f} us, visitable {:.0f} ms, choose "
        "{:.0f} ms\n",
        arguments.pack, arguments.visitable, budget.value_or(0), arguments.rule, choice.packBytes, pack.sizeBytes(),
        choice.costUs, visitableMs, chooseMs);
    for (const std::string& line : reportLines(choice)) fmt::print("  {}\n", line);
    if (!arguments.cells.empty()) printCells(arguments.cells, directory, measured.views, choice.views);
    if (arguments.output.empty()) continue;
    std::vector<std::vector<bool>> keep(directory.cells.size(),
                                        std::vector<bool>(static_cast<size_t>(viewpoints.count())));
    for (size_t i = 0; i < choice.views.size(); ++i)
      if (choice.views[i] == ViewFate::kept) keep[measured.views[i].cell][measured.views[i].view] = true;
    const std::string path =
        budget ? fmt::format("{}.{}.{}", arguments.output, arguments.rule, *budget) : arguments.output;
    FARCELL_ASSIGN(const uint64_t bytes, write(pack, keep, path));
    fmt::print("  {}: {} bytes\n", path, bytes);
  }
  return {};
}

}  // namespace
}  // namespace farcell

int main(int argc, char** argv) {
  farcell::Arguments arguments;
  CLI::App app("What a build would leave out, tried on a finished pack.", "bench_choose");
  app.add_option("pack", arguments.pack)->required();
  app.add_option("--visitable", arguments.visitable)->capture_default_str();
  app.add_option("--pack-budget", arguments.budgets, "bytes; several: one pack each, named for it");
  app.add_option("--budget-rule", arguments.rule)->check(CLI::IsMember({"worth", "triangles"}));
  app.add_option("--least-worth", arguments.leastWorth, "a byte")->capture_default_str();
  app.add_option("--cells", arguments.cells, "CSV of the cells");
  app.add_option("-o,--output", arguments.output, "the pack without what is left out");
  CLI11_PARSE(app, argc, argv);
  const auto result = farcell::bench(arguments);
  if (!result) fmt::print(stderr, "bench_choose: {}\n", result.error().message);
  return result ? 0 : 1;
}
