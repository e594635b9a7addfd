#include "posefusion/pipeline/start_pose.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace posefusion {
namespace {

constexpr double kRounding = 1e-12;

Eigen::Isometry3d Tilted(double roll_rad, double pitch_rad) {
  return LevelStartPose() * Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitX()) *
         Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitZ());
}

TEST(StartPose, LevelCameraLooksAlongX) {
  const Eigen::Matrix3d R = LevelStartPose().linear();
  EXPECT_TRUE((R * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitX()));
  EXPECT_TRUE((R * Eigen::Vector3d::UnitY()).isApprox(-Eigen::Vector3d::UnitZ()));
  EXPECT_TRUE(LevelStartPose().translation().isZero());
}

TEST(StartPose, TiltIsTakenFromTheUpwardDirectionOfAnyLength) {
  for (const double roll : {-0.8, 0.0, 0.4}) {
    for (const double pitch : {-1.2, 0.0, 0.7}) {
      const Eigen::Isometry3d truth = Tilted(roll, pitch);
      const Eigen::Vector3d up = truth.linear().transpose() * Eigen::Vector3d::UnitZ();
      const Eigen::Isometry3d T = StartPoseFromUp(9.81 * up);
      EXPECT_TRUE(T.isApprox(truth, kRounding)) << roll << " " << pitch;
    }
  }
}

TEST(StartPose, CameraThatLooksStraightDownHasAHeading) {
  const Eigen::Isometry3d T = StartPoseFromUp(-Eigen::Vector3d::UnitZ());
  EXPECT_TRUE((T.linear() * Eigen::Vector3d::UnitZ()).isApprox(-Eigen::Vector3d::UnitZ()));
  EXPECT_TRUE((T.linear() * -Eigen::Vector3d::UnitY()).isApprox(Eigen::Vector3d::UnitX()));
  EXPECT_NEAR(T.linear().determinant(), 1, kRounding);
}

TEST(StartPose, RefusesWhatHasNoDirection) {
  EXPECT_THROW(StartPoseFromUp(Eigen::Vector3d::Zero()), std::invalid_argument);
  EXPECT_THROW(StartPoseFromUp(Eigen::Vector3d::Constant(NAN)), std::invalid_argument);
}

}  // namespace
}  // namespace posefusion
