#include "posefusion/skeleton/stamp_rate_limit.h"

#include <gtest/gtest.h>

namespace posefusion {
namespace {

constexpr StampNs kSecond = 1'000'000'000;

/// Images accepted of `seconds` of a 30 Hz stream.
int CountAccepted(StampRateLimit limit, int seconds) {
  int accepted = 0;
  for (int i = 0; i < 30 * seconds; ++i) {
    if (limit.Accept(kSecond + i * (kSecond / 30))) ++accepted;
  }
  return accepted;
}

TEST(StampRateLimit, KeepsTheMeanRateThatDoesNotDivideTheCamera) {
  for (const int rate_hz : {1, 4, 7, 10, 20}) {
    EXPECT_NEAR(CountAccepted(StampRateLimit(rate_hz), 10), 10 * rate_hz, 1) << rate_hz << " Hz";
  }
}

TEST(StampRateLimit, NoneOrAFasterOneThanTheCameraTakesEveryImage) {
  EXPECT_EQ(CountAccepted(StampRateLimit(0), 10), 300);
  EXPECT_EQ(CountAccepted(StampRateLimit(100), 10), 300);
}

TEST(StampRateLimit, DoesNotCatchUpAfterAGap) {
  StampRateLimit limit(1);
  EXPECT_TRUE(limit.Accept(1 * kSecond));
  EXPECT_TRUE(limit.Accept(60 * kSecond));
  EXPECT_FALSE(limit.Accept(60 * kSecond + kSecond / 2));
  EXPECT_TRUE(limit.Accept(61 * kSecond));
  EXPECT_FALSE(limit.Accept(61 * kSecond + kSecond / 2));
}

TEST(StampRateLimit, StartsAnewWhenStampsGoBack) {
  StampRateLimit limit(1);
  EXPECT_TRUE(limit.Accept(100 * kSecond));
  EXPECT_TRUE(limit.Accept(5 * kSecond));
  EXPECT_FALSE(limit.Accept(5 * kSecond + kSecond / 2));
}

}  // namespace
}  // namespace posefusion
