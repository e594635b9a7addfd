#include "posefusion_ros/pace_meter.h"

#include <gtest/gtest.h>

namespace posefusion {
namespace {

TEST(PaceMeter, TellsRateAndDelaysOfTheWindow) {
  PaceMeter meter(2.0);
  EXPECT_EQ(meter.RateHz(0), 0);
  EXPECT_EQ(meter.DelayQuantileS(0.5), 0);
  for (int i = 0; i < 100; ++i) meter.Note(0.1 * i, i < 50 ? 9.0 : 0.01 * (i % 10));
  EXPECT_NEAR(meter.RateHz(9.9), 10, 1);
  EXPECT_NEAR(meter.DelayQuantileS(0.5), 0.045, 0.01);
  EXPECT_NEAR(meter.DelayQuantileS(0.95), 0.09, 0.011) << "what is older than the window is gone";
  EXPECT_EQ(meter.RateHz(20), 0);
}

TEST(PaceMeter, YoungOnesCountFromTheirFirstEvent) {
  PaceMeter meter(10.0);
  for (int i = 0; i <= 10; ++i) meter.Note(100 + 0.1 * i);
  EXPECT_NEAR(meter.RateHz(101), 10, 1.1);
}

TEST(PaceMeter, RareEventsCountOverTheWholeWindow) {
  PaceMeter meter(2.0);
  EXPECT_EQ(meter.newest_delay_s(), -1);
  meter.Note(100, 0.3);
  EXPECT_EQ(meter.RateHz(100), 0.5) << "one event has no pace yet";
  meter.Note(105, 0.4);
  EXPECT_EQ(meter.RateHz(106), 0.5);
  EXPECT_EQ(meter.RateHz(108), 0);
  EXPECT_EQ(meter.newest_delay_s(), 0.4) << "also when nothing is in the window";
}

}  // namespace
}  // namespace posefusion
