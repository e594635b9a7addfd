#include "posefusion/skeleton/pose_network_source.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace posefusion {
namespace {

constexpr StampNs kSecond = 1'000'000'000;

RgbdFrame FrameAt(StampNs stamp_ns) {
  RgbdFrame frame;
  frame.stamp_ns = stamp_ns;
  frame.rgb = cv::Mat::zeros(4, 4, CV_8UC3);
  return frame;
}

TEST(PoseNetworkSource, PeopleOfAFrameAreThereOnceItsTimeHasCome) {
  PoseNetworkSource source([](const cv::Mat&) { return std::vector<Skeleton>(2); }, 0);
  source.Offer(FrameAt(5 * kSecond));
  EXPECT_TRUE(source.Take(4 * kSecond).empty());
  const auto arrived = source.Take(5 * kSecond);
  ASSERT_EQ(arrived.size(), 1U);
  EXPECT_EQ(arrived[0].stamp_ns, 5 * kSecond);
  EXPECT_EQ(arrived[0].arrival_ns, 5 * kSecond);
  EXPECT_EQ(arrived[0].people.size(), 2U);
  EXPECT_TRUE(source.Take(6 * kSecond).empty());
  EXPECT_EQ(source.counts().frames_with_keypoints, 1);
}

TEST(PoseNetworkSource, LooksAtImagesOfItsRateOnly) {
  int looked_at = 0;
  PoseNetworkSource source(
      [&](const cv::Mat&) {
        ++looked_at;
        return std::vector<Skeleton>();
      },
      5);
  for (int i = 0; i < 60; ++i) source.Offer(FrameAt(kSecond + i * kSecond / 30));
  EXPECT_EQ(looked_at, 10);
  EXPECT_EQ(source.Take(10 * kSecond).size(), 10U) << "nobody seen is an answer too";
}

TEST(PoseNetworkSource, GoesOnAfterAFrameThatTheNetworkFailedAt) {
  PoseNetworkSource source(
      [](const cv::Mat& rgb) -> std::vector<Skeleton> {
        if (rgb.empty()) throw std::runtime_error("empty");
        return {};
      },
      0);
  RgbdFrame bad;
  bad.stamp_ns = kSecond;
  EXPECT_THROW(source.Offer(bad), std::runtime_error);
  source.Offer(FrameAt(2 * kSecond));
  EXPECT_EQ(source.Take(3 * kSecond).size(), 1U);
}

}  // namespace
}  // namespace posefusion
