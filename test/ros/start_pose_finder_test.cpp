#include "posefusion_ros/start_pose_finder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/make_shared.hpp>
#include <random>

#include "posefusion/pipeline/start_pose.h"
#include "test/ros/robot_tf.h"

namespace posefusion {
namespace {

constexpr double kStart = 1000;
constexpr double kImageS = kStart + 0.5;
constexpr double kGravity = 9.81;
constexpr double kTimeoutS = 0.1;
/// Of the accelerometer below, averaged.
constexpr double kImuToleranceRad = 0.01;

double TiltBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  const double cosine = (a.linear().transpose() * up).dot(b.linear().transpose() * up);
  return std::acos(std::min(1.0, cosine));
}

class StartPoseFinderTest : public testing::Test {
 protected:
  StartPoseFinderTest() { frames_.odom_frame = "odom"; }

  StartPose Find(bool imu_speaks = false) {
    StartPoseFinder finder(config_, frames_, tree_);
    for (const auto& imu : imu_) finder.AddImu(imu);
    return finder.Find(StampFromSeconds(kImageS), kCameraLink, imu_speaks, kTimeoutS);
  }

  /// At rest in BODY, with noise.
  void AddImu(double gravity = kGravity) {
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0, 0.1);
    for (double time_s = kStart; time_s < kStart + 1; time_s += 0.005) {
      const Eigen::Vector3d up =
          WalkingBody(kImageS).linear().transpose() * Eigen::Vector3d(0, 0, gravity);
      auto imu = boost::make_shared<sensor_msgs::Imu>();
      imu->header.stamp = ros::Time(time_s);
      imu->header.frame_id = kRootLink;
      imu->linear_acceleration.x = up.x() + noise(random);
      imu->linear_acceleration.y = up.y() + noise(random);
      imu->linear_acceleration.z = up.z() + noise(random);
      imu_.push_back(imu);
    }
  }

  StartConfig config_;
  FramesConfig frames_;
  TfTree tree_{0.5};
  std::vector<sensor_msgs::ImuConstPtr> imu_;
};

TEST_F(StartPoseFinderTest, OdometryGivesThePoseOfTheFirstImage) {
  AddRobot(tree_, kStart, kStart + 1);
  const StartPose start = Find();
  EXPECT_TRUE(start.as_asked);
  EXPECT_TRUE(start.T_map_camera.isApprox(OdomToCameraTruth(kImageS), 1e-6));
}

TEST_F(StartPoseFinderTest, AnAccelerometerGivesTheTiltThroughTf) {
  AddRobot(tree_, kStart, kStart + 1);
  AddImu();
  config_.source = StartSource::kImu;
  const StartPose start = Find(true);
  EXPECT_TRUE(start.as_asked) << start.told_by;
  EXPECT_LT(TiltBetween(start.T_map_camera, OdomToCameraTruth(kImageS)), kImuToleranceRad);
  EXPECT_TRUE(start.T_map_camera.translation().isZero()) << "the camera is the origin";
}

TEST_F(StartPoseFinderTest, AutomaticTakesTheImuWhenThereIsNoOdometry) {
  AddRobot(tree_, kStart, kStart + 1);
  AddImu();
  frames_.odom_frame = "";
  EXPECT_EQ(Find(true).told_by, "IMU");
  EXPECT_EQ(Find(false).told_by, "parameters") << "nobody speaks, nobody is waited for";
}

TEST_F(StartPoseFinderTest, WhatDoesNotComeIsToldAndTheCameraIsLevel) {
  const StartPose start = Find();
  EXPECT_FALSE(start.as_asked);
  EXPECT_THAT(start.told_by, testing::HasSubstr("odometry"));
  EXPECT_TRUE(start.T_map_camera.isApprox(LevelStartPose()));
}

TEST_F(StartPoseFinderTest, ARobotThatFallsHasNoUpwards) {
  AddRobot(tree_, kStart, kStart + 1);
  AddImu(2.0);
  config_.source = StartSource::kImu;
  EXPECT_FALSE(Find(true).as_asked);
}

TEST_F(StartPoseFinderTest, GivenAnglesTurnTheCameraDownAndClockwise) {
  config_.source = StartSource::kGiven;
  config_.camera_pitch_rad = 0.3;
  const Eigen::Isometry3d down = Find().T_map_camera;
  EXPECT_NEAR((down.linear() * Eigen::Vector3d::UnitZ()).z(), -std::sin(0.3), 1e-12);
  config_.camera_pitch_rad = 0;
  config_.camera_roll_rad = 0.3;
  const Eigen::Isometry3d rolled = Find().T_map_camera;
  // The image's right (x) of a camera rolled clockwise points downwards.
  EXPECT_NEAR((rolled.linear() * Eigen::Vector3d::UnitX()).z(), -std::sin(0.3), 1e-12);
}

}  // namespace
}  // namespace posefusion
