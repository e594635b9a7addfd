#include "posefusion/skeleton/clock_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace posefusion {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr StampNs kSecond = 1'000'000'000;

TEST(ClockCheck, SaysOnceWithBothStamps) {
  ClockCheck check("/skeletons_in");
  EXPECT_FALSE(check.Compare(100 * kSecond, 109 * kSecond)) << "late is not another clock";
  const auto line = check.Compare(5 * kSecond, 1'700'000'000 * kSecond);
  ASSERT_TRUE(line);
  EXPECT_THAT(*line, AllOf(HasSubstr("/skeletons_in"), HasSubstr("5.000000"),
                           HasSubstr("1700000000.000000")));
  EXPECT_FALSE(check.Compare(5 * kSecond, 1'700'000'001 * kSecond));
}

}  // namespace
}  // namespace posefusion
