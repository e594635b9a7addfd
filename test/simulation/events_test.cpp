#include "posefusion/simulation/events.h"

#include <gtest/gtest.h>

#include <fstream>

#include "posefusion/evaluation/intervals.h"
#include "posefusion/simulation/simulator.h"
#include "test/support/temporary_folder.h"

namespace posefusion {
namespace {

TEST(StaticShare, CountsPixelsWithoutPeople) {
  cv::Mat labels(480, 640, CV_8UC1, cv::Scalar(1));
  EXPECT_EQ(StaticShare(labels), 1);
  labels.colRange(0, 320).setTo(11);
  labels.colRange(320, 400).setTo(2);  // a thing that is moved is no person
  EXPECT_NEAR(StaticShare(labels), 0.5, 1e-9);
}

TEST(OcclusionRecorder, JoinsFramesWithoutAView) {
  OcclusionRecorder recorder;
  const auto stamp = [](int i) { return SimulationStamp(i / 30.0); };
  for (int i = 0; i < 90; ++i) {
    const bool hidden = (i >= 10 && i < 20) || (i >= 22 && i < 25) || i == 60;
    recorder.Add(stamp(i), hidden ? 0.05 : 0.6);
  }
  ASSERT_EQ(recorder.events().size(), 2u);
  EXPECT_EQ(recorder.events()[0].begin_ns, stamp(10));
  EXPECT_EQ(recorder.events()[0].end_ns, stamp(24));
  EXPECT_EQ(recorder.events()[1].begin_ns, recorder.events()[1].end_ns);
}

TEST(FormatEvents, IsReadBackInOrderOfTime) {
  const TemporaryFolder folder;
  Fall fall;
  fall.start_s = 5;
  std::vector<SimulationEvent> events = FallEvents({fall});
  events.push_back({SimulationStamp(1), SimulationStamp(2), "occlusion"});
  std::ofstream(folder / "events.txt") << FormatEvents(events);
  const auto intervals = ReadIntervals(folder / "events.txt");
  ASSERT_EQ(intervals.size(), 2u);
  EXPECT_EQ(intervals[0].name, "occlusion");
  EXPECT_EQ(intervals[1].name, "fall");
  EXPECT_EQ(intervals[1].begin_ns, SimulationStamp(5));
  EXPECT_EQ(intervals[1].end_ns, SimulationStamp(fall.standing_s()));
}

}  // namespace
}  // namespace posefusion
