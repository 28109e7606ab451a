#include "runtime/cost/cost_store.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <random>

#include "cache/base/file.h"

namespace farcell {
namespace {

constexpr const char* kRenderer = "a renderer\n(of two lines), 4.5";

CostModel someCosts() {
  CostModel costs;
  double value = 1e-7;
  for (DrawCosts& draw : costs.draws) draw = {value *= 1.7, value *= 1.7, value *= 1.7, value *= 1.7, value *= 1.7};
  return costs;
}

class CostStore : public testing::Test {
 protected:
  CostStore()
      : directory_(std::filesystem::temp_directory_path() /
                   fmt::format("farcell_cost_store_{}", static_cast<int>(getpid()))) {}
  ~CostStore() override { std::filesystem::remove_all(directory_); }
  const std::filesystem::path directory_;
};

TEST_F(CostStore, givesBackWhatItKept) {
  const auto path = directory_ / "deep" / "costs.txt";
  EXPECT_FALSE(loadCosts(path, kRenderer));
  ASSERT_TRUE(saveCosts(path, someCosts(), kRenderer));
  const auto found = loadCosts(path, kRenderer);
  ASSERT_TRUE(found);
  EXPECT_EQ(*found, someCosts());
  EXPECT_FALSE(loadCosts(path, "another renderer"));
}

TEST_F(CostStore, aDirectoryThatCannotBeMadeIsTold) {
  std::filesystem::create_directories(directory_);
  ASSERT_TRUE(writeTextFile(directory_ / "file", "no directory"));
  const auto saved = saveCosts(directory_ / "file" / "farcell" / "costs.txt", someCosts(), kRenderer);
  ASSERT_FALSE(saved);
  EXPECT_EQ(saved.error().kind, ErrorKind::io);
  EXPECT_FALSE(loadCosts(directory_, kRenderer));  // no file
}

TEST(ParseCosts, believesNothing) {
  const std::string good = costsText(someCosts(), kRenderer);
  ASSERT_TRUE(parseCosts(good, kRenderer));
  const std::string head = good.substr(0, good.find('\n', good.find('\n') + 1) + 1);
  std::string lines;
  for (int i = 0; i < 5; ++i) lines += "1 1 1 1 1\n";
  for (const char* last : {"", "1 1 1 1", "1 1 1 1 1 1", "1 1 1 1 -1", "1 1 nan 1 1", "1 inf 1 1 1", "0 0 0 0 0", "a"})
    EXPECT_FALSE(parseCosts(head + lines + last + "\n", kRenderer)) << last;
  EXPECT_TRUE(parseCosts(head + lines + "0 0 0 0 1e-9\n", kRenderer));
  EXPECT_FALSE(parseCosts("farcell-costs 999999\n" + good.substr(good.find('\n') + 1), kRenderer));
  EXPECT_FALSE(parseCosts("", kRenderer));
}

TEST(ParseCosts, survivesRandomDamage) {
  std::mt19937 random(1);
  const std::string good = costsText(someCosts(), kRenderer);
  for (int round = 0; round < 2000; ++round) {
    std::string text = good;
    for (int i = 0; i < 3; ++i) text[random() % text.size()] = static_cast<char>(random());
    text.resize(random() % 4 == 0 ? random() % text.size() : text.size());
    const auto costs = parseCosts(text, kRenderer);
    if (!costs) continue;
    for (const DrawCosts& draw : costs->draws)
      EXPECT_GE(expectedMs(draw, {1, 1, 1, 1, 1}), 0) << "seed 1, round " << round;
  }
}

TEST(CostsPath, liesInTheCacheDirectoryOfTheUser) {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  const char* home = std::getenv("HOME");
  const std::string keptCache = cache == nullptr ? "" : cache, keptHome = home == nullptr ? "" : home;
  setenv("HOME", "/home/somebody", 1);
  setenv("XDG_CACHE_HOME", "/cache", 1);
  const auto a = costsPath("a"), b = costsPath("b");
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->parent_path(), "/cache/farcell");
  EXPECT_NE(*a, *b);
  EXPECT_EQ(*a, *costsPath("a"));
  setenv("XDG_CACHE_HOME", "relative", 1);  // not valid, by the XDG specification
  EXPECT_EQ(costsPath("a")->parent_path(), "/home/somebody/.cache/farcell");
  unsetenv("HOME");
  EXPECT_FALSE(costsPath("a"));
  if (home != nullptr) setenv("HOME", keptHome.c_str(), 1);
  cache != nullptr ? setenv("XDG_CACHE_HOME", keptCache.c_str(), 1) : unsetenv("XDG_CACHE_HOME");
}

}  // namespace
}  // namespace farcell
