#include "posefusion/common/gravity.h"

#include <gtest/gtest.h>

namespace posefusion {
namespace {

/// Level, with x of the odometry frame ahead, somewhere and turned about the vertical.
Eigen::Isometry3d LevelCamera() {
  Eigen::Matrix3d R_level_camera;
  R_level_camera << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  Eigen::Isometry3d T_odom_camera(Eigen::Translation3d(3, -2, 1.5));
  T_odom_camera.rotate(Eigen::AngleAxisd(1.1, Eigen::Vector3d::UnitZ()));
  T_odom_camera.rotate(R_level_camera);
  return T_odom_camera;
}

Eigen::Vector3f GravityAfterTurn(double angle_rad, const Eigen::Vector3d& axis_camera) {
  return GravityInCamera(LevelCamera() * Eigen::AngleAxisd(angle_rad, axis_camera));
}

TEST(GravityInCamera, PointsDownTheImageOfALevelCamera) {
  EXPECT_TRUE(GravityInCamera(LevelCamera()).isApprox(Eigen::Vector3f::UnitY(), 1e-6F));
}

TEST(GravityInCamera, PointsAheadForACameraThatLooksDown) {
  // About x: a positive angle turns the viewing direction upwards.
  const Eigen::Vector3f down = GravityAfterTurn(-0.3, Eigen::Vector3d::UnitX());
  EXPECT_NEAR(down.z(), std::sin(0.3), 1e-6);
  EXPECT_NEAR(down.y(), std::cos(0.3), 1e-6);
}

TEST(GravityInCamera, PointsToTheRightOfTheImageOfACameraRolledClockwise) {
  const Eigen::Vector3f down = GravityAfterTurn(M_PI / 2, Eigen::Vector3d::UnitZ());
  EXPECT_TRUE(down.isApprox(Eigen::Vector3f::UnitX(), 1e-6F)) << down.transpose();
}

}  // namespace
}  // namespace posefusion
