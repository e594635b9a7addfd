#include "posefusion_ros/visual_odometry.h"

#include <gtest/gtest.h>

namespace posefusion {
namespace {

constexpr double kRounding = 1e-9;
constexpr StampNs kFrameNs = 33'333'333;

Eigen::Isometry3d PoseAt(int i) {
  Eigen::Isometry3d T(Eigen::Translation3d(0.02 * i, 0.01 * i, 1));
  T.rotate(Eigen::AngleAxisd(0.01 * i, Eigen::Vector3d::UnitY()));
  return T;
}

TrackedPose Advance(VisualOdometry& odometry, Trajectory& trajectory, const Eigen::Isometry3d& T) {
  FrameResult result;
  result.stamp_ns = static_cast<StampNs>(trajectory.size() + 1) * kFrameNs;
  result.tracking.T_map_camera = T;
  trajectory.push_back({result.stamp_ns, T});
  return odometry.Advance(result, trajectory, {});
}

TEST(VisualOdometry, IsTheMapsPoseAsLongAsTheMapStaysAsItIs) {
  VisualOdometry odometry;
  Trajectory trajectory;
  for (int i = 0; i < 50; ++i) {
    const TrackedPose pose = Advance(odometry, trajectory, PoseAt(i));
    EXPECT_TRUE(pose.T_visual_camera.isApprox(PoseAt(i), kRounding));
    if (i == 0) continue;
    EXPECT_NEAR(pose.velocity.head<3>().norm() * pose.interval_s, 0.02236, 1e-4);
  }
}

TEST(VisualOdometry, DoesNotJumpWhenTheMapIsCorrected) {
  VisualOdometry odometry;
  Trajectory trajectory;
  for (int i = 0; i < 5; ++i) Advance(odometry, trajectory, PoseAt(i));
  const Eigen::Isometry3d T_correction(Eigen::Translation3d(1, 2, 3));
  for (StampedPose& pose : trajectory) pose.T_map_camera = T_correction * pose.T_map_camera;
  const TrackedPose pose = Advance(odometry, trajectory, T_correction * PoseAt(5));
  EXPECT_TRUE(pose.T_visual_camera.isApprox(PoseAt(5), kRounding));
  EXPECT_TRUE(pose.T_map_camera.isApprox(T_correction * PoseAt(5)));
}

TEST(VisualOdometry, HasNoVelocityAfterALostFrame) {
  VisualOdometry odometry;
  Trajectory trajectory;
  EXPECT_EQ(Advance(odometry, trajectory, PoseAt(0)).interval_s, 0);
  EXPECT_GT(Advance(odometry, trajectory, PoseAt(1)).interval_s, 0);
  odometry.NoteLost();
  EXPECT_EQ(Advance(odometry, trajectory, PoseAt(2)).interval_s, 0);
}

}  // namespace
}  // namespace posefusion
