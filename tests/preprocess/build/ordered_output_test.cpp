#include "preprocess/build/ordered_output.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "cache/base/parallel.h"

namespace farcell {
namespace {

TEST(OrderedOutput, WritesInOrderWhoeverFinishesFirst) {
  std::vector<size_t> written;
  OrderedOutput<size_t> output(4, [&](size_t index, size_t&& value) -> Result<> {
    EXPECT_EQ(index, value);
    written.push_back(index);
    return {};
  });
  parallelFor(500, 8, [&](size_t index, int) {
    if (index % 7 == 0) std::this_thread::sleep_for(std::chrono::microseconds(200));
    output.put(index, size_t{index});
  });
  ASSERT_TRUE(output.result());
  ASSERT_EQ(written.size(), 500u);
  for (size_t i = 0; i < written.size(); ++i) EXPECT_EQ(written[i], i);
}

TEST(OrderedOutput, AnErrorStopsTheWritingAndWakesThoseWhoWait) {
  size_t written = 0;
  OrderedOutput<int> output(2, [&](size_t, int&&) -> Result<> {
    ++written;
    return {};
  });
  parallelFor(100, 4, [&](size_t index, int) {
    if (index == 10)
      output.put(index, fail(ErrorKind::io, "disk full"));
    else
      output.put(index, 1);
  });
  EXPECT_TRUE(output.failed());
  EXPECT_EQ(output.result().error().message, "disk full");
  EXPECT_LE(written, 10u);
}

}  // namespace
}  // namespace farcell
