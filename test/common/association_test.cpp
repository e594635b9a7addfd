#include "posefusion/common/association.h"

#include <gtest/gtest.h>

namespace posefusion {
namespace {

constexpr StampNs kMillisecond = 1'000'000;

std::vector<StampMatch> Associate(const std::vector<StampNs>& first_ms,
                                  const std::vector<StampNs>& second_ms) {
  std::vector<StampNs> first_ns;
  std::vector<StampNs> second_ns;
  for (const StampNs stamp : first_ms) first_ns.push_back(stamp * kMillisecond);
  for (const StampNs stamp : second_ms) second_ns.push_back(stamp * kMillisecond);
  return AssociateStamps(first_ns, second_ns, 0.020);
}

TEST(Association, TakesTheClosestPairFirst) {
  // 100 is nearer to 95 than 85 is: 85 has to do with 66, its only other neighbour.
  const auto matches = Associate({85, 100}, {66, 95});
  ASSERT_EQ(matches.size(), 2U);
  EXPECT_EQ(matches[0].second, 0U);
  EXPECT_EQ(matches[1].second, 1U);
}

TEST(Association, UsesEachEntryOnce) {
  EXPECT_EQ(Associate({100, 101, 102}, {101}).size(), 1U);
  EXPECT_EQ(Associate({101}, {100, 101, 102}).front().second, 1U);
}

TEST(Association, LeavesOutWhatIsTooFarApart) {
  EXPECT_TRUE(Associate({100}, {121}).empty());
  EXPECT_EQ(Associate({100}, {119}).size(), 1U);
  EXPECT_TRUE(Associate({}, {119}).empty());
}

TEST(Association, SortsByTheStampsOfTheFirstList) {
  const auto matches = Associate({300, 100, 200}, {101, 201, 301});
  ASSERT_EQ(matches.size(), 3U);
  EXPECT_EQ(matches[0].first, 1U);
  EXPECT_EQ(matches[1].first, 2U);
  EXPECT_EQ(matches[2].first, 0U);
}

}  // namespace
}  // namespace posefusion
