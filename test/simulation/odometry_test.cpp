#include "posefusion/simulation/odometry.h"

#include <gtest/gtest.h>

#include "posefusion/common/lie.h"
#include "posefusion/simulation/simulation_config.h"

namespace posefusion {
namespace {

constexpr double kSeconds = 60;

Mover MoverOf(const std::string& preset, int seed) {
  SimulationConfig config;
  config.preset = preset;
  config.seed = seed;
  config.seconds = kSeconds;
  return MakeMover(CheckedConfig(config));
}

/// Pose of the odometry frame in the map that the true pose of the body implies.
Eigen::Isometry3d ImpliedMapOdom(const RobotMotion& robot, const Odometry& odometry, double t) {
  return robot.T_map_body(t) * odometry.T_odom_body(t).inverse();
}

TEST(Odometry, DriftsByAFewPercentOfTheWay) {
  double drift = 0;
  double way = 0;
  for (int seed = 1; seed <= 8; ++seed) {
    const Mover mover = MoverOf("hrp_loop", seed);
    const Odometry odometry({}, *mover.robot, seed, kSeconds);
    const Eigen::Isometry3d start = mover.robot->T_map_footprint(0);
    const Eigen::Isometry3d believed = start * odometry.T_odom_footprint(kSeconds);
    drift += (believed.translation() - mover.robot->T_map_footprint(kSeconds).translation()).norm();
    for (double t = 0; t < kSeconds; t += 0.1) {
      way += (mover.robot->T_map_footprint(t + 0.1).translation() -
              mover.robot->T_map_footprint(t).translation())
                 .norm();
    }
  }
  EXPECT_GT(drift / way, 0.01);
  EXPECT_LT(drift / way, 0.06);
}

TEST(Odometry, IsContinuousAndRightOverShortTimes) {
  const Mover mover = MoverOf("hrp_loop", 2);
  const Odometry odometry({}, *mover.robot, 2, kSeconds);
  for (double t = 0; t < 30; t += 0.01) {
    const Eigen::Isometry3d believed =
        odometry.T_odom_body(t).inverse() * odometry.T_odom_body(t + 0.01);
    const Eigen::Isometry3d truth =
        mover.robot->T_map_body(t).inverse() * mover.robot->T_map_body(t + 0.01);
    const Eigen::Isometry3d error = truth.inverse() * believed;
    ASSERT_LT(error.translation().norm(), 0.004) << t;  // elastic shaking is not felt
    ASSERT_LT(LogSO3(error.linear()).norm(), 0.03) << t;
  }
}

TEST(Odometry, DoesNotFeelBeingCarried) {
  const Mover mover = MoverOf("hrp_falls", 1);
  const Odometry odometry({}, *mover.robot, 1, kSeconds);
  const Fall& fall = mover.robot->falls().front();
  const Eigen::Isometry3d before = odometry.T_odom_footprint(fall.start_s + 0.5);
  const Eigen::Isometry3d after = odometry.T_odom_footprint(fall.standing_s());
  EXPECT_LT((after.translation() - before.translation()).norm(), 0.05);
  const auto correction = [&](double t) { return ImpliedMapOdom(*mover.robot, odometry, t); };
  const Eigen::Isometry3d jump =
      correction(fall.start_s - 0.5).inverse() * correction(fall.standing_s() + 0.5);
  EXPECT_GT(LogSO3(jump.linear()).norm(), 0.5);
}

TEST(Odometry, StandsStillWhileTheRobotDoes) {
  const Mover mover = MoverOf("hrp_loop", 3);
  const Odometry odometry({}, *mover.robot, 3, kSeconds);
  EXPECT_LT(odometry.T_odom_footprint(0.5).translation().norm(), 1e-3);
}

}  // namespace
}  // namespace posefusion
