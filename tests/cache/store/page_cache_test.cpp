#include "cache/store/page_cache.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <latch>
#include <random>
#include <set>
#include <thread>

namespace farcell {
namespace {

// Pages made of their own number. Sizes and failures are given; loads are counted; the first load of a page can be
// held.
class FakeSource : public PageSource {
 public:
  explicit FakeSource(std::vector<uint64_t> sizes) : sizes_(std::move(sizes)), loads_(sizes_.size()) {}

  uint32_t pageCount() const override { return static_cast<uint32_t>(sizes_.size()); }
  uint64_t decodedBytes(uint32_t page) const override { return sizes_[page]; }
  uint64_t storedBytes(uint32_t page) const override { return sizes_[page] / 2; }
  Result<DecodedPage> load(uint32_t page) const override {
    ++loads_[page];
    if (gate != nullptr) gate->wait();
    if (failing.contains(page)) return fail(ErrorKind::corrupt, "page {} is damaged", page);
    if (throwing) throw std::bad_alloc();
    GeometryPage decoded;
    decoded.indices = {page, page + 1, page + 2};
    return decoded;
  }
  int loads(uint32_t page) const { return loads_[page]; }

  std::set<uint32_t> failing;
  bool throwing = false;
  std::latch* gate = nullptr;

 private:
  std::vector<uint64_t> sizes_;
  mutable std::vector<std::atomic<int>> loads_;
};

void expectHolds(const Result<PagePin>& pin, uint32_t page) {
  ASSERT_TRUE(pin.has_value()) << pin.error().message;
  EXPECT_EQ(pin->geometry().indices, (std::vector<uint32_t>{page, page + 1, page + 2}));
}

TEST(PageCache, LoadsAPageOnceAndServesItAgain) {
  const FakeSource source({10, 20});
  PageCache cache(source, 100);
  expectHolds(cache.pin(0), 0);
  expectHolds(cache.pin(0), 0);
  expectHolds(cache.pin(1), 1);
  EXPECT_EQ(source.loads(0), 1);
  const PageCacheStats stats = cache.stats();
  EXPECT_EQ(stats.hits, 1u);
  EXPECT_EQ(stats.misses, 2u);
  EXPECT_EQ(stats.bytesRead, 15u);
  EXPECT_EQ(stats.residentBytes, 30u);
  EXPECT_EQ(stats.pinnedBytes, 0u);
  EXPECT_EQ(stats.maximumBytes, 30u);
  EXPECT_EQ(stats.evictions, 0u);
}

TEST(PageCache, EvictsThePageUnpinnedLongest) {
  const FakeSource source({10, 10, 10, 10});
  PageCache cache(source, 30);
  for (const uint32_t page : {0u, 1u, 2u, 0u, 3u}) expectHolds(cache.pin(page), page);  // 3 takes the place of 1
  EXPECT_EQ(cache.stats().evictions, 1u);
  for (const uint32_t page : {0u, 2u, 3u}) expectHolds(cache.pin(page), page);
  EXPECT_EQ(cache.stats().misses, 4u);
  expectHolds(cache.pin(1), 1);
  EXPECT_EQ(source.loads(1), 2);
}

TEST(PageCache, EvictsAsManyAsALargePageNeeds) {
  const FakeSource source({10, 10, 10, 25});
  PageCache cache(source, 30);
  for (const uint32_t page : {0u, 1u, 2u, 3u}) expectHolds(cache.pin(page), page);
  EXPECT_EQ(cache.stats().evictions, 3u);
  EXPECT_EQ(cache.stats().residentBytes, 25u);
}

TEST(PageCache, KeepsAPinnedPageAlthoughItIsTheOldest) {
  const FakeSource source({10, 10, 10, 10});
  PageCache cache(source, 30);
  const Result<PagePin> pinned = cache.pin(0);
  for (const uint32_t page : {1u, 2u, 3u, 1u}) expectHolds(cache.pin(page), page);
  expectHolds(pinned, 0);
  expectHolds(cache.pin(0), 0);
  EXPECT_EQ(source.loads(0), 1);
}

TEST(PageCache, RefusesAPageThatDoesNotFitBesideThePinnedOnes) {
  const FakeSource source({10, 15, 31});
  PageCache cache(source, 30);
  {
    const Result<PagePin> first = cache.pin(0);
    const Result<PagePin> second = cache.pin(1);
    const Result<PagePin> third = cache.pin(2);
    ASSERT_FALSE(third.has_value());
    EXPECT_EQ(third.error().kind, ErrorKind::exhausted);
    EXPECT_EQ(cache.stats().pinnedBytes, 25u);
  }
  EXPECT_FALSE(cache.pin(2).has_value());  // larger than the whole budget
  EXPECT_EQ(cache.stats().refused, 2u);
  EXPECT_EQ(source.loads(2), 0);
  EXPECT_EQ(cache.stats().residentBytes, 25u);
}

TEST(PageCache, CountsAPagePinnedTwiceOnceAndFreesItWithTheLastPin) {
  const FakeSource source({20, 20});
  PageCache cache(source, 30);
  Result<PagePin> first = cache.pin(0);
  {
    const Result<PagePin> second = cache.pin(0);
    EXPECT_EQ(cache.stats().pinnedBytes, 20u);
  }
  EXPECT_FALSE(cache.pin(1).has_value());
  *first = PagePin();
  EXPECT_EQ(cache.stats().pinnedBytes, 0u);
  expectHolds(cache.pin(1), 1);
}

TEST(PageCache, MovesAPinWithItsPage) {
  const FakeSource source({20, 20});
  PageCache cache(source, 40);
  PagePin a = std::move(cache.pin(0).value());
  PagePin b = std::move(a);
  EXPECT_FALSE(static_cast<bool>(a));
  EXPECT_TRUE(static_cast<bool>(b));
  b = std::move(cache.pin(1).value());
  EXPECT_EQ(cache.stats().pinnedBytes, 20u);
  EXPECT_EQ(b.geometry().indices[0], 1u);
}

TEST(PageCache, ReportsAFailedLoadAndTriesAgainNextTime) {
  FakeSource source({10, 10});
  PageCache cache(source, 30);
  source.failing = {1};
  for (int i = 0; i < 2; ++i) {
    const Result<PagePin> pin = cache.pin(1);
    ASSERT_FALSE(pin.has_value());
    EXPECT_EQ(pin.error().message, "page 1 is damaged");
  }
  EXPECT_EQ(cache.stats().failures, 2u);
  EXPECT_EQ(cache.stats().residentBytes, 0u);
  EXPECT_EQ(cache.stats().bytesRead, 0u);
  source.failing.clear();
  expectHolds(cache.pin(1), 1);
}

TEST(PageCache, TurnsMissingMemoryIntoAnError) {
  FakeSource source({10});
  source.throwing = true;
  PageCache cache(source, 30);
  EXPECT_EQ(cache.pin(0).error().kind, ErrorKind::exhausted);
  EXPECT_EQ(cache.stats().pinnedBytes, 0u);
}

// Threads that ask for the page while it is being loaded all wait for that one load, and share its failure.
TEST(PageCache, LoadsAPageOnceForAllWhoAskAtTheSameTime) {
  for (const bool failing : {false, true}) {
    constexpr int kThreads = 6;
    std::latch gate(1);
    FakeSource source({10});
    source.gate = &gate;
    if (failing) source.failing = {0};
    PageCache cache(source, 30);
    std::atomic<int> served = 0, refused = 0;
    {
      std::vector<std::jthread> threads;
      for (int t = 0; t < kThreads; ++t) threads.emplace_back([&] { ++(cache.pin(0).has_value() ? served : refused); });
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      gate.count_down();
    }
    EXPECT_EQ(served, failing ? 0 : kThreads);
    EXPECT_EQ(refused, failing ? kThreads : 0);
    EXPECT_EQ(static_cast<uint64_t>(source.loads(0)), cache.stats().misses);
    EXPECT_LE(source.loads(0), failing ? kThreads : 1);  // who comes after a failure tries again
    EXPECT_EQ(cache.stats().pinnedBytes, 0u);
  }
}

// Random pins, some of them kept for a while, over pages of random size and a budget that holds only some.
void hammer(PageCache& cache, uint32_t pageCount, uint64_t budgetBytes, uint32_t seed, std::atomic<int>& wrong) {
  std::mt19937 random(seed);
  std::vector<std::pair<uint32_t, PagePin>> kept;
  for (int i = 0; i < 3000; ++i) {
    const uint32_t page = static_cast<uint32_t>(random() % pageCount);
    Result<PagePin> pin = cache.pin(page);
    if (pin) kept.emplace_back(page, std::move(*pin));
    if (!pin && pin.error().kind != ErrorKind::exhausted && page % 13 != 5) ++wrong;
    for (const auto& [index, held] : kept)
      if (held.geometry().indices[0] != index) ++wrong;
    if (cache.stats().residentBytes > budgetBytes) ++wrong;
    if (!kept.empty() && (kept.size() > 3 || random() % 2 == 0)) kept.erase(kept.begin());
  }
}

TEST(PageCache, StaysWithinItsBudgetUnderEightThreads) {
  for (uint32_t seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::vector<uint64_t> sizes(40);
    for (uint64_t& size : sizes) size = 1 + random() % 1000;
    const uint64_t budgetBytes = 2000 + random() % 15000;
    FakeSource source(sizes);
    for (uint32_t page = 5; page < sizes.size(); page += 13) source.failing.insert(page);
    PageCache cache(source, budgetBytes);
    std::atomic<int> wrong = 0;
    {
      std::vector<std::jthread> threads;
      for (uint32_t t = 0; t < 8; ++t)
        threads.emplace_back([&, t] { hammer(cache, source.pageCount(), budgetBytes, seed * 8 + t, wrong); });
    }
    EXPECT_EQ(wrong, 0);
    const PageCacheStats stats = cache.stats();
    EXPECT_LE(stats.maximumBytes, budgetBytes);
    EXPECT_EQ(stats.pinnedBytes, 0u);
    EXPECT_GT(stats.evictions, 0u);
    EXPECT_GT(stats.hits, 0u);
    uint64_t loads = 0;
    for (uint32_t page = 0; page < source.pageCount(); ++page) loads += static_cast<uint64_t>(source.loads(page));
    EXPECT_EQ(loads, stats.misses);
  }
}

TEST(PackPageSource, ServesThePagesOfAPack) {
  const auto path = std::filesystem::temp_directory_path() / fmt::format("{}-store.far", ::getpid());
  Directory directory;
  directory.cells.resize(1);
  directory.cells[0] = {.key = {},
                        .content = {GridPoint(0), GridPoint(4)},
                        .triangles = 1,
                        .meshTriangles = 1,
                        .firstGeometryPage = 0,
                        .geometryPageCount = 1,
                        .firstViewPage = 1,
                        .viewPageCount = 1};
  GeometryPage geometry;
  geometry.positions = {{0, 0, 0}, {4, 0, 0}, {0, 4, 4}};
  geometry.indices = {0, 1, 2};
  ViewPage views;
  views.views.resize(1);
  views.views[0].width = views.views[0].height = 1;
  views.views[0].rgba = {1, 2, 3, 4};
  views.views[0].depth = {5};
  const auto group = static_cast<uint32_t>(Viewpoints::create(directory.model.settings.form.views)->group(0));
  {
    Result<PackWriter> writer = PackWriter::create(path);
    ASSERT_TRUE(writer.has_value());
    ASSERT_TRUE(writer->add(PageKind::geometry, 0, 0, decodedSizeBytes(geometry), encodeGeometryPage(geometry)));
    ASSERT_TRUE(writer->add(PageKind::views, 0, group, decodedSizeBytes(views), encodeViewPage(views)));
    ASSERT_TRUE(writer->finish(directory).has_value());
  }
  {
    const Result<PackFile> pack = PackFile::open(path);
    ASSERT_TRUE(pack.has_value()) << pack.error().message;
    const PackPageSource source(*pack);
    PageCache cache(source, 1000);
    const Result<PagePin> first = cache.pin(0), second = cache.pin(1);
    ASSERT_TRUE(first.has_value() && second.has_value());
    EXPECT_EQ(first->geometry(), geometry);
    EXPECT_EQ(second->views(), views);
    EXPECT_EQ(cache.stats().pinnedBytes, decodedSizeBytes(geometry) + decodedSizeBytes(views));
    EXPECT_EQ(cache.stats().bytesRead, pack->directory().pages[0].storedBytes + pack->directory().pages[1].storedBytes);
  }
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace farcell
