#include "posefusion_ros/robot_locator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "test/ros/robot_tf.h"

namespace posefusion {
namespace {

using testing::HasSubstr;

constexpr double kSubtractionTolerance = 1e-6;
constexpr double kStart = 1000;
/// tf is interpolated between 100 Hz samples of the neck, so only samples are exact.
constexpr double kImageS = kStart + 0.5;

const Eigen::Isometry3d T_map_odom_truth =
    Eigen::Translation3d(3, -1, 0.02) * Eigen::AngleAxisd(0.8, Eigen::Vector3d::UnitZ());

/// A robot that told tf all about itself; `odometry_delay_s` ago it stopped.
class RobotLocatorTest : public testing::Test {
 protected:
  using Clock = RobotLocator::Clock;

  RobotLocatorTest() {
    frames_.odom_frame = "odom";
    frames_.base_frame = kRootLink;
    frames_.head_frame = "NECK_P_LINK";
  }

  RobotLocator Locator() { return RobotLocator(frames_, TfConfig(), tree_); }

  static TrackedPose TrackedAt(double time_s) {
    TrackedPose pose;
    pose.stamp_ns = StampFromSeconds(time_s);
    pose.camera_frame = kCameraLink;
    pose.T_map_camera = T_map_odom_truth * OdomToCameraTruth(time_s);
    return pose;
  }

  void Robot(double from_s, double to_s) { AddRobot(tree_, kStart + from_s, kStart + to_s); }

  FramesConfig frames_;
  TfTree tree_{0.5};
  Clock::time_point now_ = Clock::now();
};

TEST_F(RobotLocatorTest, CorrectionTimesOdometryIsTheTrackedPoseAtEachImageStamp) {
  Robot(0, 2);
  RobotLocator locator = Locator();
  for (double time_s = 0; time_s < 2; time_s += 1.0 / 30) {
    const TrackedPose pose = TrackedAt(kStart + time_s);
    locator.Add(pose, now_);
    const auto located = locator.Take(now_);
    ASSERT_EQ(located.size(), 1U);
    ASSERT_TRUE(located[0].child);
    EXPECT_EQ(located[0].child->frame, "odom");
    const auto T_odom_camera = locator.OdomToCamera(pose.stamp_ns, kCameraLink);
    const Eigen::Isometry3d product = located[0].child->T_map_child * *T_odom_camera;
    EXPECT_TRUE(product.isApprox(pose.T_map_camera, kSubtractionTolerance));
    EXPECT_EQ(locator.trouble(), "");
  }
}

TEST_F(RobotLocatorTest, OnlyTheNeckAtTheImageStampGivesTheRightAnswer) {
  Robot(0, 1);
  RobotLocator locator = Locator();
  const auto correction_with = [&](double tf_time_s) {
    TrackedPose pose = TrackedAt(kImageS);
    pose.stamp_ns = StampFromSeconds(tf_time_s);
    locator.Add(pose, now_);
    return locator.Take(now_).at(0).child->T_map_child;
  };
  EXPECT_TRUE(correction_with(kImageS).isApprox(T_map_odom_truth, kSubtractionTolerance));
  // 30 ms, a fast image; 80 ms, a usual one; the head has turned meanwhile.
  for (const double delay_s : {-0.03, 0.03, 0.08}) {
    const Eigen::Isometry3d wrong = correction_with(kImageS + delay_s);
    const double angle = LogSO3(wrong.linear().transpose() * T_map_odom_truth.linear()).norm();
    EXPECT_GT(angle, 0.01) << delay_s;
  }
}

TEST_F(RobotLocatorTest, HeadAndBaseComeWithThePose) {
  Robot(0, 1);
  RobotLocator locator = Locator();
  locator.Add(TrackedAt(kImageS), now_);
  const auto located = locator.Take(now_);
  const Eigen::Isometry3d T_map_base =
      TrackedAt(kImageS).T_map_camera * *located.at(0).T_camera_base;
  EXPECT_TRUE(T_map_base.isApprox(T_map_odom_truth * WalkingBody(kImageS), kSubtractionTolerance));
  EXPECT_TRUE(located[0].T_camera_head);
}

TEST_F(RobotLocatorTest, LateOdometryIsWaitedForInOrder) {
  Robot(0, 0.5);
  RobotLocator locator = Locator();
  locator.Add(TrackedAt(kStart + 0.52), now_);
  locator.Add(TrackedAt(kStart + 0.55), now_);
  EXPECT_TRUE(locator.Take(now_ + std::chrono::milliseconds(100)).empty());
  Robot(0.51, 0.6);
  const auto located = locator.Take(now_ + std::chrono::milliseconds(110));
  ASSERT_EQ(located.size(), 2U);
  EXPECT_LT(located[0].pose.stamp_ns, located[1].pose.stamp_ns);
  EXPECT_TRUE(located[0].child && located[1].child);
}

TEST_F(RobotLocatorTest, MissingOdometryIsToldAndThePoseGoesOutWithoutIt) {
  frames_.head_frame = "";
  frames_.base_frame = "";
  RobotLocator locator = Locator();
  locator.Add(TrackedAt(kImageS), now_);
  EXPECT_TRUE(locator.Take(now_).empty());
  const auto located = locator.Take(now_ + std::chrono::seconds(1));
  ASSERT_EQ(located.size(), 1U);
  EXPECT_FALSE(located[0].child);
  EXPECT_TRUE(located[0].T_camera_head) << "the camera is its own head";
  EXPECT_THAT(locator.trouble(), HasSubstr("no transform from odom"));
}

TEST_F(RobotLocatorTest, AFrameThatSomebodyElseHoldsGetsNoSecondParent) {
  Robot(0, 1);
  tree_.Add(MakeTransform("world", "odom", StampFromSeconds(kStart), T_map_odom_truth), "/rival",
            true);
  RobotLocator locator = Locator();
  locator.Add(TrackedAt(kImageS), now_);
  const auto located = locator.Take(now_);
  ASSERT_EQ(located.size(), 1U) << "nobody waits for it";
  EXPECT_FALSE(located[0].child);
  EXPECT_TRUE(located[0].T_camera_head);
  EXPECT_THAT(locator.trouble(), HasSubstr("odom has the parent world already"));
  EXPECT_THAT(locator.trouble(), HasSubstr("/rival"));
}

TEST_F(RobotLocatorTest, NoLoopIsClosed) {
  Robot(0, 1);
  tree_.Add(MakeTransform("odom", "map", StampFromSeconds(kStart), T_map_odom_truth), "/rival",
            true);
  RobotLocator locator = Locator();
  locator.Add(TrackedAt(kImageS), now_);
  EXPECT_FALSE(locator.Take(now_).at(0).child);
  EXPECT_THAT(locator.trouble(), HasSubstr("loop"));
}

TEST_F(RobotLocatorTest, AJumpOfOdometryIsToldAndFollowed) {
  Robot(0, 0.6);
  RobotLocator locator = Locator();
  locator.Add(TrackedAt(kStart + 0.5), now_);
  EXPECT_EQ(locator.Take(now_).size(), 1U);
  EXPECT_EQ(locator.trouble(), "");
  const Eigen::Isometry3d T_jump(Eigen::Translation3d(2, 0, 0));
  for (const double time_s : {kStart + 0.61, kStart + 0.62}) {
    auto transforms = RobotTransforms(time_s);
    transforms[0] =
        MakeTransform("odom", kRootLink, StampFromSeconds(time_s), T_jump * WalkingBody(time_s));
    for (const auto& transform : transforms) tree_.Add(transform, "/robot", false);
  }
  locator.Add(TrackedAt(kStart + 0.615), now_);
  const auto located = locator.Take(now_);
  EXPECT_THAT(locator.trouble(), HasSubstr("odom jumped by"));
  const auto T_odom_camera = locator.OdomToCamera(located.at(0).pose.stamp_ns, kCameraLink);
  EXPECT_TRUE((located[0].child->T_map_child * *T_odom_camera)
                  .isApprox(located[0].pose.T_map_camera, kSubtractionTolerance));
}

TEST_F(RobotLocatorTest, WithoutOdometryTheRootOfTheCamerasTreeIsHeld) {
  frames_.odom_frame = "";
  frames_.base_frame = "";
  frames_.head_frame = "";
  RobotLocator locator = Locator();
  locator.Add(TrackedAt(kImageS), now_);
  EXPECT_EQ(locator.Take(now_).at(0).child->frame, kCameraLink) << "a camera that hangs nowhere";
  const Eigen::Isometry3d T_link_camera(Eigen::Translation3d(0, 0.02, 0));
  tree_.Add(MakeTransform("camera_link", kCameraLink, 0, T_link_camera), "/camera", true);
  locator.Add(TrackedAt(kImageS), now_);
  const auto located = locator.Take(now_);
  EXPECT_EQ(located.at(0).child->frame, "camera_link");
  EXPECT_TRUE((located[0].child->T_map_child * T_link_camera)
                  .isApprox(TrackedAt(kImageS).T_map_camera, kSubtractionTolerance));
  EXPECT_FALSE(locator.OdomToCamera(StampFromSeconds(kImageS), kCameraLink));
}

TEST_F(RobotLocatorTest, ACameraThatSomebodyElseHasPutIntoTheMapIsLeftAlone) {
  frames_ = FramesConfig();
  tree_.Add(MakeTransform("map", kCameraLink, 0, T_map_odom_truth), "/rival", true);
  RobotLocator locator = Locator();
  locator.Add(TrackedAt(kImageS), now_);
  EXPECT_FALSE(locator.Take(now_).at(0).child);
  EXPECT_THAT(locator.trouble(), HasSubstr("/rival"));
}

}  // namespace
}  // namespace posefusion
