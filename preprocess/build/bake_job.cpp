#include "preprocess/build/bake_job.h"

#include <algorithm>

#include "cache/base/interrupt.h"
#include "preprocess/build/soup.h"
#include "preprocess/encode/view_image.h"

namespace farcell {
namespace {

constexpr uint64_t kBatchWork = 2'000'000'000;  // triangles x pairs; about four seconds
constexpr size_t kStreamedSoup = 65'536;        // triangles that pass all views at once

// The views that are baked together with their antipodes.
std::vector<int> pairLeaders(const Viewpoints& viewpoints) {
  std::vector<int> leaders;
  for (int view = 0; view < viewpoints.count(); ++view)
    if (view < viewpoints.antipode(view)) leaders.push_back(view);
  return leaders;
}

uint64_t bytesOfTriangle(const BuildContext& context) {
  return 4 * (12 + (context.model.hasNormals ? 3 : 0) + (context.hasTextures ? 7 : 0));
}

uint64_t bytesOfPair(const BuildSettings& settings, const ViewForm& form) {
  const auto texels = static_cast<uint64_t>(form.imageSize) * static_cast<uint64_t>(form.imageSize);
  const uint64_t sample = settings.lighting == Lighting::relightable ? 24 : 16;
  // The samples; a view and its antipode as floats, as bytes, and while they are coded.
  return texels * (static_cast<uint64_t>(settings.samples) * sample + 2 * 64);
}

class Batch {
 public:
  Batch(const BuildContext& context, const ViewBatch& batch, TextureSampler* textures)
      : context_(context),
        batch_(batch),
        textures_(textures),
        viewpoints_(context.viewpoints(batch.cell)),
        source_(context.model, context.tree, context.partition),
        leaves_(source_.leavesInside(batch.cell)) {
    const std::vector<int> leaders = pairLeaders(viewpoints_);
    for (uint32_t pair = batch.firstPair; pair < batch.firstPair + batch.pairCount; ++pair) {
      const int view = leaders[pair], antipode = viewpoints_.antipode(view);
      if (context.wanted(batch.cell, view) || context.wanted(batch.cell, antipode)) pairs_.push_back(view);
    }
    const BuildSettings& settings = context.model.settings;
    settings_ = {context.form(batch.cell).imageSize, settings.samples, sunDirection(settings.up, settings.sun),
                 settings.lighting == Lighting::relightable};
  }

  Result<> gathered() {
    const uint64_t triangles = context_.tree.cells[batch_.cell].triangles;
    const uint64_t bytes =
        2 * triangles * bytesOfTriangle(context_) + bytesOfPair(context_.model.settings, context_.form(batch_.cell));
    FARCELL_ASSIGN(const MemoryGate::Share share, context_.gate.take(bytes, "baking a view"));
    CellSoup soup;
    {
      const Lap lap(context_.clock.bakeNs);
      for (const uint32_t leaf : leaves_)
        FARCELL_TRY(source_.append(batch_.cell, leaf, soup, [] { return Result<>(); }));
    }
    ViewBaker baker(settings_, textures_);
    for (const int view : pairs_) {
      FARCELL_TRY(checkInterrupt());
      {
        const Lap lap(context_.clock.bakeNs);
        baker.begin(frameOf(view));
        baker.add(soup);
      }
      finish(baker, view);
    }
    return store();
  }

  // As many views at once as there is memory for; the leaves pass again for the next ones.
  Result<> streamed() {
    const uint64_t fixed = 4 * kStreamedSoup * bytesOfTriangle(context_);
    const uint64_t pair = bytesOfPair(context_.model.settings, context_.form(batch_.cell));
    const uint64_t room = context_.memoryOfThread > fixed ? context_.memoryOfThread - fixed : 0;
    const size_t atOnce = std::clamp<uint64_t>(room / pair, 1, std::max<size_t>(1, pairs_.size()));
    FARCELL_ASSIGN(const MemoryGate::Share share, context_.gate.take(fixed + atOnce * pair, "baking a view"));
    for (size_t first = 0; first < pairs_.size(); first += atOnce)
      FARCELL_TRY(stream(std::span(pairs_).subspan(first, std::min(atOnce, pairs_.size() - first))));
    return store();
  }

 private:
  ViewFrame frameOf(int view) const { return viewFrame(viewpoints_.directions()[view]); }

  Result<> stream(std::span<const int> pairs) {
    std::vector<ViewBaker> bakers;
    for (const int view : pairs) bakers.emplace_back(settings_, textures_).begin(frameOf(view));
    {
      const Lap lap(context_.clock.bakeNs);
      CellSoup soup;
      const auto pass = [&] {
        for (ViewBaker& baker : bakers) baker.add(soup);
        soup.clear();
      };
      const auto appended = [&]() -> Result<> {
        if (soup.size() >= kStreamedSoup) pass();
        return checkInterrupt();
      };
      for (const uint32_t leaf : leaves_) FARCELL_TRY(source_.append(batch_.cell, leaf, soup, appended));
      pass();
    }
    for (size_t pair = 0; pair < pairs.size(); ++pair) finish(bakers[pair], pairs[pair]);
    return {};
  }

  void finish(ViewBaker& baker, int view) {
    BakedView front, back;
    {
      const Lap lap(context_.clock.bakeNs);
      baker.finish(front, back);
    }
    const Lap lap(context_.clock.encodeNs);
    encode(front, view);
    encode(back, viewpoints_.antipode(view));
  }

  void encode(const BakedView& baked, int view) {
    if (!context_.wanted(batch_.cell, view)) return;
    const ViewImage image = quantisedView(baked, static_cast<uint32_t>(view), settings_.imageSize);
    ViewCost& cost = baked_.emplace_back(ViewCost{batch_.cell, static_cast<uint32_t>(view)});
    if (image.width == 0) return;
    views_.push_back(encodeView(image, context_.model.settings.viewError));
    cost.bytes = static_cast<uint32_t>(views_.back().stream.size());
    cost.texels = image.width * image.height;
    for (size_t alpha = 3; alpha < image.rgba.size(); alpha += 4) {
      cost.covered += image.rgba[alpha] > 0;
      cost.edges += image.rgba[alpha] > 0 && image.rgba[alpha] < 255;
    }
  }

  Result<> store() {
    if (textures_ != nullptr && textures_->failure()) return tl::unexpected<Error>(*textures_->failure());
    std::sort(views_.begin(), views_.end(), [](const auto& a, const auto& b) { return a.view < b.view; });
    return context_.store.add(batch_, baked_, views_);
  }

  const BuildContext& context_;
  const ViewBatch batch_;
  TextureSampler* const textures_;
  const Viewpoints& viewpoints_;
  const SoupSource source_;
  const std::vector<uint32_t> leaves_;
  BakeSettings settings_;
  std::vector<int> pairs_;
  std::vector<EncodedView> views_;
  std::vector<ViewCost> baked_;
};

}  // namespace

bool cheaperAsTriangles(const CellRecord& cell) {
  return cell.childCount == 0 && cell.triangles < kTrianglesCheaperThanView;
}

bool isBaked(const CellRecord& cell) { return cell.triangles > 0 && !cheaperAsTriangles(cell); }

std::vector<ViewBatch> viewBatches(const BuildContext& context) {
  const auto& cells = context.tree.cells;
  std::vector<ViewBatch> batches;
  for (uint32_t cell = 0; cell < cells.size(); ++cell) {
    if (!isBaked(cells[cell])) continue;
    const auto pairs = static_cast<uint32_t>(context.form(cell).views / 2);
    const uint64_t fit = std::max<uint64_t>(1, kBatchWork / cells[cell].triangles);
    for (uint32_t first = 0; first < pairs; first += static_cast<uint32_t>(std::min<uint64_t>(fit, pairs)))
      batches.push_back({cell, first, static_cast<uint32_t>(std::min<uint64_t>(fit, pairs - first))});
  }
  const auto work = [&](const ViewBatch& batch) { return cells[batch.cell].triangles * batch.pairCount; };
  std::stable_sort(batches.begin(), batches.end(),
                   [&](const ViewBatch& a, const ViewBatch& b) { return work(a) > work(b); });
  return batches;
}

Result<> bakeBatch(const BuildContext& context, const ViewBatch& batch, TextureSampler* textures,
                   uint64_t gatherTriangles) {
  Batch work(context, batch, textures);
  return context.tree.cells[batch.cell].triangles <= gatherTriangles ? work.gathered() : work.streamed();
}

}  // namespace farcell
