#include "posefusion/evaluation/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace posefusion {
namespace {

TEST(Statistics, AgreesWithValuesComputedByHand) {
  const ErrorStatistics s = Summarize({4, 1, 3, 2});
  EXPECT_EQ(s.count, 4);
  EXPECT_DOUBLE_EQ(s.rmse, std::sqrt(30.0 / 4));
  EXPECT_DOUBLE_EQ(s.mean, 2.5);
  EXPECT_DOUBLE_EQ(s.median, 2.5);
  EXPECT_DOUBLE_EQ(s.p95, 4);
  EXPECT_DOUBLE_EQ(s.std_dev, std::sqrt(1.25));
  EXPECT_DOUBLE_EQ(s.min, 1);
  EXPECT_DOUBLE_EQ(s.max, 4);
}

TEST(Statistics, TakesTheNearestRank) {
  std::vector<double> errors;
  for (int i = 1; i <= 100; ++i) errors.push_back(i);
  EXPECT_EQ(Summarize(errors).p95, 95);
  EXPECT_EQ(Summarize({7}).p95, 7);
  EXPECT_EQ(Summarize({1, 2, 9}).median, 2);
}

TEST(Statistics, NothingGivesZeros) {
  EXPECT_EQ(Summarize({}).count, 0);
  EXPECT_EQ(Summarize({}).rmse, 0);
}

}  // namespace
}  // namespace posefusion
