#include "tools/progress.h"

#include <gtest/gtest.h>

namespace posefusion {
namespace {

TEST(Progress, TellsShareRateAndTimeLeft) {
  EXPECT_EQ(ProgressText("run", 120, 300, "frames", 6),
            "run: 120 / 300 frames (40 %), 20.0/s, 9 s left");
  EXPECT_EQ(ProgressText("run", 300, 300, "frames", 15), "run: 300 / 300 frames (100 %), 20.0/s");
}

TEST(Progress, DoesWithoutTotalAndWithoutRate) {
  EXPECT_EQ(ProgressText("run", 120, {}, "frames", 6), "run: 120 frames, 20.0/s");
  EXPECT_EQ(ProgressText("run", 0, 300, "frames", 6), "run: 0 / 300 frames (0 %)");
  EXPECT_EQ(ProgressText("run", 1, 300, "frames", 0.01), "run: 1 / 300 frames (0 %)");
}

TEST(Progress, WritesDurationsForPeople) {
  EXPECT_EQ(DurationText(9.2), "9 s");
  EXPECT_EQ(DurationText(59.6), "1:00 min");
  EXPECT_EQ(DurationText(185), "3:05 min");
  EXPECT_EQ(DurationText(3729), "1:02:09 h");
}

}  // namespace
}  // namespace posefusion
