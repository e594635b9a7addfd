#include "posefusion_ros/keypoint_inbox.h"

#include <gtest/gtest.h>

#include <thread>

namespace posefusion {
namespace {

using Clock = KeypointInbox::Clock;
using std::chrono::milliseconds;

constexpr StampNs kFrame = 33'000'000;
const Clock::time_point kStart{};

Skeletons Of(StampNs stamp_ns) {
  Skeletons skeletons;
  skeletons.stamp_ns = stamp_ns;
  return skeletons;
}

std::vector<StampNs> Stamps(const std::vector<Skeletons>& taken) {
  std::vector<StampNs> stamps;
  for (const Skeletons& skeletons : taken) stamps.push_back(skeletons.stamp_ns);
  return stamps;
}

using StampList = std::vector<StampNs>;

TEST(KeypointInbox, KeypointsWaitForTheirFrame) {
  KeypointInbox inbox;
  for (const StampNs stamp : {1 * kFrame, 3 * kFrame, 2 * kFrame}) {
    inbox.AddKeypoints(Of(stamp), kStart);
  }
  EXPECT_EQ(Stamps(inbox.Take(2 * kFrame, kStart)), (StampList{1 * kFrame, 2 * kFrame}));
  EXPECT_EQ(Stamps(inbox.Take(2 * kFrame, kStart)), StampList());
  EXPECT_EQ(Stamps(inbox.Take(3 * kFrame, kStart)), (StampList{3 * kFrame}));
}

TEST(KeypointInbox, RoundedStampsBecomeThoseOfTheFrame) {
  KeypointInbox inbox;
  inbox.NoteFrame(kFrame, kStart);
  inbox.AddKeypoints(Of(kFrame + 900'000), kStart);
  EXPECT_EQ(Stamps(inbox.Take(kFrame, kStart)), StampList{kFrame});
}

TEST(KeypointInbox, TakeWaitsForTheKeypointsOfItsFrameUntilTheDeadline) {
  KeypointInbox inbox;
  const auto begin = Clock::now();
  EXPECT_TRUE(inbox.Take(kFrame, begin + milliseconds(30)).empty());
  EXPECT_GE(Clock::now() - begin, milliseconds(30));
  std::thread sender([&] {
    std::this_thread::sleep_for(milliseconds(20));
    inbox.AddKeypoints(Of(kFrame), Clock::now());
  });
  EXPECT_EQ(inbox.Take(kFrame, Clock::now() + std::chrono::seconds(20)).size(), 1U);
  sender.join();
}

TEST(KeypointInbox, FirstKeypointsAreThoseOfAKnownFrame) {
  KeypointInbox inbox;
  inbox.NoteFrame(5 * kFrame, kStart);
  inbox.AddKeypoints(Of(4 * kFrame), kStart);
  EXPECT_FALSE(inbox.WaitForFirst(30 * kFrame, milliseconds(1))) << "of a frame before the start";
  inbox.AddKeypoints(Of(5 * kFrame), kStart);
  inbox.Take(5 * kFrame, kStart);
  EXPECT_TRUE(inbox.WaitForFirst(30 * kFrame, std::chrono::hours(1))) << "they have come";
  inbox.AddKeypoints(Of(9 * kFrame), kStart);
  inbox.NoteFrame(2 * kFrame, kStart);
  inbox.Restart(2 * kFrame);
  EXPECT_FALSE(inbox.WaitForFirst(30 * kFrame, milliseconds(1))) << "of the time before";
  inbox.AddKeypoints(Of(2 * kFrame), kStart);
  EXPECT_TRUE(inbox.WaitForFirst(30 * kFrame, milliseconds(1)));
}

TEST(KeypointInbox, FirstKeypointsMayComeBeforeTheirFrame) {
  KeypointInbox inbox;
  inbox.AddKeypoints(Of(kFrame), kStart);
  inbox.NoteBlurredFrame(kFrame, kStart);
  EXPECT_TRUE(inbox.WaitForFirst(30 * kFrame, milliseconds(1)));
}

TEST(KeypointInbox, WaitsForTheFirstKeypointsByTheTimeOfImages) {
  KeypointInbox inbox;
  inbox.NoteFrame(kFrame, kStart);
  std::thread sender([&] {
    for (int i = 2; i <= 4; ++i) {
      std::this_thread::sleep_for(milliseconds(10));
      inbox.NoteFrame(i * kFrame, kStart);
    }
  });
  const auto begin = Clock::now();
  EXPECT_FALSE(inbox.WaitForFirst(4 * kFrame, std::chrono::hours(1)));
  EXPECT_GE(Clock::now() - begin, milliseconds(30));
  sender.join();
}

TEST(KeypointInbox, CloseEndsTheWaiting) {
  KeypointInbox inbox;
  inbox.Close();
  EXPECT_FALSE(inbox.WaitForFirst(kFrame, std::chrono::hours(1)));
  EXPECT_TRUE(inbox.Take(kFrame, Clock::now() + std::chrono::hours(1)).empty());
}

TEST(KeypointInbox, KnowsWhetherKeypointsOfNearlyEveryFrameAreTimely) {
  KeypointInbox inbox;
  const auto grace = milliseconds(30);
  EXPECT_TRUE(inbox.AreTimely(grace, kStart)) << "nothing is known";
  Clock::time_point now = kStart;
  const auto play = [&](int frames, int with_keypoints_every, milliseconds lateness) {
    for (int i = 0; i < frames; ++i) {
      now += milliseconds(33);
      const StampNs stamp = std::chrono::nanoseconds(now.time_since_epoch()).count();
      inbox.NoteFrame(stamp, now);
      if (i % with_keypoints_every == 0) inbox.AddKeypoints(Of(stamp), now + lateness);
    }
  };
  play(20, 1, milliseconds(10));
  EXPECT_TRUE(inbox.AreTimely(grace, now));
  play(20, 1, milliseconds(200));
  EXPECT_FALSE(inbox.AreTimely(grace, now)) << "late";
  play(20, 1, milliseconds(10));
  EXPECT_TRUE(inbox.AreTimely(grace, now)) << "in time again";
  play(20, 3, milliseconds(10));
  EXPECT_FALSE(inbox.AreTimely(grace, now)) << "rare";
}

TEST(KeypointInbox, BlurredFramesTakeStampsButAreNotWaitedFor) {
  KeypointInbox inbox;
  const auto grace = milliseconds(30);
  Clock::time_point now = kStart;
  for (int i = 0; i < 20; ++i) {
    now += milliseconds(33);
    const StampNs stamp = std::chrono::nanoseconds(now.time_since_epoch()).count();
    if (i % 2 == 0) {
      inbox.NoteBlurredFrame(stamp, now);
      continue;
    }
    inbox.NoteFrame(stamp, now);
    inbox.AddKeypoints(Of(stamp), now);
  }
  EXPECT_TRUE(inbox.AreTimely(grace, now)) << "of every frame that is waited for";
  inbox.NoteBlurredFrame(500 * kFrame, now);
  inbox.AddKeypoints(Of(500 * kFrame + 900'000), now);
  EXPECT_EQ(Stamps(inbox.Take(501 * kFrame, kStart)).back(), 500 * kFrame);
}

TEST(KeypointInbox, RestartForgetsKeypointsOfTheTimeBefore) {
  KeypointInbox inbox;
  inbox.AddKeypoints(Of(9 * kFrame), kStart);
  inbox.AddKeypoints(Of(1 * kFrame), kStart);
  inbox.Restart(1 * kFrame);
  EXPECT_EQ(Stamps(inbox.Take(20 * kFrame, kStart)), StampList{1 * kFrame});
}

}  // namespace
}  // namespace posefusion
