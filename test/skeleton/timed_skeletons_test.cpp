#include "posefusion/skeleton/timed_skeletons.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "posefusion/skeleton/arrival_queue.h"
#include "test/skeleton/sample_skeletons.h"

namespace posefusion {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr StampNs kMs = 1'000'000;
constexpr StampNs kStart = 1'305'031'102'175'304'000;

/// Nobody in every frame, on time.
class EveryFrame : public SkeletonSource {
 public:
  void Offer(const RgbdFrame& frame) override {
    ++num_offered_;
    waiting_.Add({frame.stamp_ns, SkeletonLayout::kCoco18, {}, frame.stamp_ns});
  }
  std::vector<Skeletons> Take(StampNs now_ns) override { return waiting_.Take(now_ns); }
  SkeletonCounts counts() const override { return {num_offered_, 0}; }

 private:
  ArrivalQueue waiting_;
  int num_offered_ = 0;
};

/// Milliseconds since the start of the frames whose keypoints come, of `count` frames at 30 Hz.
std::vector<int> KeypointsOf(int count, const KeypointDelivery& delivery) {
  TimedSkeletons source(std::make_unique<EveryFrame>(), delivery);
  std::vector<int> times_ms;
  for (int i = 0; i < count; ++i) {
    const StampNs stamp_ns = kStart + i * 100 * kMs / 3 / 1000 * 1000;
    source.Offer(testing::FrameAt(stamp_ns));
    for (const Skeletons& skeletons : source.Take(stamp_ns)) {
      times_ms.push_back(static_cast<int>((skeletons.stamp_ns - kStart) / kMs));
    }
  }
  return times_ms;
}

TEST(TimedSkeletons, PassesEverythingByDefault) { EXPECT_EQ(KeypointsOf(30, {}).size(), 30U); }

TEST(TimedSkeletons, RateChoosesTheFirstImageOfEachPeriod) {
  EXPECT_THAT(KeypointsOf(30, {5, 0}), ElementsAre(0, 200, 400, 600, 800));
  EXPECT_EQ(KeypointsOf(300, {7, 0}).size(), 70U);
  EXPECT_EQ(KeypointsOf(30, {100, 0}).size(), 30U);
}

TEST(TimedSkeletons, DelayIsAddedToTheArrival) {
  TimedSkeletons source(std::make_unique<EveryFrame>(), {0, 0.3});
  source.Offer(testing::FrameAt(kStart));
  EXPECT_THAT(source.Take(kStart), IsEmpty());
  EXPECT_THAT(source.Take(kStart + 299 * kMs), IsEmpty());
  const auto arrived = source.Take(kStart + 300 * kMs);
  ASSERT_EQ(arrived.size(), 1U);
  EXPECT_EQ(arrived[0].stamp_ns, kStart);
  EXPECT_EQ(arrived[0].arrival_ns, kStart + 300 * kMs);
}

TEST(TimedSkeletons, FramesBeyondTheRateAreNotLookedAt) {
  auto every_frame = std::make_unique<EveryFrame>();
  const EveryFrame& looked_at = *every_frame;
  TimedSkeletons source(std::move(every_frame), {5, 0.3});
  for (int i = 0; i < 30; ++i) source.Offer(testing::FrameAt(kStart + i * 100 * kMs / 3));
  EXPECT_EQ(looked_at.counts().frames_with_keypoints, 5);
}

}  // namespace
}  // namespace posefusion
