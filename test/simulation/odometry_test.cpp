#include "posefusion/simulation/odometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "posefusion/common/lie.h"
#include "posefusion/simulation/simulation_config.h"

namespace posefusion {
namespace {

constexpr double kSeconds = 60;

Mover MoverOf(const std::string& preset, int seed, double seconds = kSeconds) {
  SimulationConfig config;
  config.preset = preset;
  config.seed = seed;
  config.seconds = seconds;
  return MakeMover(CheckedConfig(config));
}

/// Pose of the odometry frame in the map that the true pose of the body implies.
Eigen::Isometry3d ImpliedMapOdom(const RobotMotion& robot, const Odometry& odometry, double t) {
  return robot.T_map_body(t) * odometry.T_odom_body(t).inverse();
}

/// Errors of odometry over each stretch of a run that is `stretch_m` long, as shares of it.
std::vector<double> DriftOver(double stretch_m, const std::string& preset, int seed) {
  const Mover mover = MoverOf(preset, seed, 0);
  const double seconds = FindPreset(preset).seconds;
  const Odometry odometry({}, *mover.robot, seed, seconds);
  const auto truth = [&](double t) { return mover.robot->T_map_footprint(t); };
  std::vector<double> drift;
  double start_s = 0;
  double way_m = 0;
  for (double t = 0; t < seconds; t += 0.1) {
    way_m += (truth(t + 0.1).translation() - truth(t).translation()).norm();
    if (way_m < stretch_m) continue;
    const Eigen::Isometry3d walked = truth(start_s).inverse() * truth(t);
    const Eigen::Isometry3d believed =
        odometry.T_odom_footprint(start_s).inverse() * odometry.T_odom_footprint(t);
    drift.push_back((believed.translation() - walked.translation()).norm() / way_m);
    start_s = t;
    way_m = 0;
  }
  return drift;
}

double MeanOf(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

TEST(Odometry, DriftsByTwoToThreePercentOverFiveMetres) {
  for (const char* preset : {"hrp_loop", "hrp_room", "corridor"}) {
    std::vector<double> drift;
    for (int seed = 1; seed <= 16; ++seed) {
      const auto own = DriftOver(5, preset, seed);
      drift.insert(drift.end(), own.begin(), own.end());
    }
    EXPECT_GT(MeanOf(drift), 0.013) << preset;
    EXPECT_LT(MeanOf(drift), 0.035) << preset;
  }
}

TEST(Odometry, DriftsFasterThanTheWayGrows) {
  std::vector<double> drift;
  for (int seed = 1; seed <= 20; ++seed) {
    const auto own = DriftOver(90, "corridor", seed);
    drift.insert(drift.end(), own.begin(), own.end());
  }
  EXPECT_EQ(drift.size(), 20U);
  EXPECT_GT(MeanOf(drift), 0.035);
  EXPECT_LT(MeanOf(drift), 0.07);
  EXPECT_LT(*std::max_element(drift.begin(), drift.end()), 0.12);
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
