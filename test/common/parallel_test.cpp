#include "posefusion/common/parallel.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace posefusion {
namespace {

TEST(ParallelRunner, VisitsEveryItemOnceForAnyNumberOfThreads) {
  for (const int num_threads : {1, 2, 3}) {
    const ParallelRunner runner(num_threads);
    std::vector<int> visits(1001, 0);
    runner.ForEachRange(1001, 64, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) ++visits[static_cast<std::size_t>(i)];
    });
    EXPECT_EQ(visits, std::vector<int>(1001, 1)) << num_threads;
  }
}

TEST(ParallelRunner, BlockSumsInOrderAreTheSameBitsForAnyNumberOfThreads) {
  const auto sum = [](int num_threads) {
    const ParallelRunner runner(num_threads);
    std::vector<float> blocks(16, 0);
    runner.ForEachBlock(16, [&](int block) {
      for (int i = 0; i < 1000; ++i) {
        blocks[static_cast<std::size_t>(block)] += 1.0F / static_cast<float>(1 + i * block);
      }
    });
    float total = 0;
    for (const float value : blocks) total += value;
    return total;
  };
  EXPECT_EQ(sum(1), sum(2));
  EXPECT_EQ(sum(1), sum(4));
}

TEST(ParallelRunner, RefusesNoThreads) { EXPECT_THROW(ParallelRunner(0), std::invalid_argument); }

TEST(ParallelRunner, EmptyLoopDoesNothing) {
  ParallelRunner(2).ForEachRange(0, 8, [](int, int) { FAIL(); });
}

}  // namespace
}  // namespace posefusion
