#include "posefusion/simulation/imu.h"

#include <gtest/gtest.h>

#include <cmath>

#include "posefusion/common/lie.h"
#include "posefusion/simulation/simulation_config.h"

namespace posefusion {
namespace {

ImuConfig WithoutErrors() {
  ImuConfig config;
  config.gyro_noise = config.gyro_bias_rad_s = config.gyro_bias_walk = 0;
  config.accelerometer_noise = config.accelerometer_bias_m_s2 = 0;
  config.accelerometer_bias_walk = 0;
  return config;
}

Mover WalkingRobot() {
  SimulationConfig config;
  config.preset = "hrp_loop";
  config.seconds = 10;
  return MakeMover(CheckedConfig(config));
}

TEST(SimulateImu, IntegratesToThePose) {
  const Mover mover = WalkingRobot();
  const auto pose = [&](double t) { return mover.robot->T_map_body(t); };
  ImuConfig config = WithoutErrors();
  config.rate_hz = 1000;
  constexpr double kSeconds = 5;
  const auto samples = SimulateImu(config, pose, 1, kSeconds);
  const double dt = 1 / config.rate_hz;
  Eigen::Matrix3d R = pose(0).linear();
  Eigen::Vector3d p = pose(0).translation();
  Eigen::Vector3d v = (pose(1e-4).translation() - pose(-1e-4).translation()) / 2e-4;
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    const Eigen::Vector3d w =
        0.5 * (samples[i].angular_velocity_rad_s + samples[i + 1].angular_velocity_rad_s);
    const Eigen::Matrix3d R_next = R * ExpSO3(w * dt);
    const Eigen::Vector3d a =
        0.5 * (R * samples[i].acceleration_m_s2 + R_next * samples[i + 1].acceleration_m_s2) -
        Eigen::Vector3d(0, 0, kGravityMS2);
    p += v * dt + 0.5 * a * dt * dt;
    v += a * dt;
    R = R_next;
  }
  EXPECT_LT(LogSO3(R.transpose() * pose(kSeconds).linear()).norm(), 2e-3);
  EXPECT_LT((p - pose(kSeconds).translation()).norm(), 0.03);
}

TEST(SimulateImu, FeelsGravityUpwardsAtRest) {
  Eigen::Isometry3d tilted = Eigen::Isometry3d::Identity();
  tilted.rotate(Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitX()));
  const auto samples = SimulateImu(
      WithoutErrors(), [&](double) { return tilted; }, 1, 0.1);
  const Eigen::Vector3d up = tilted.linear().transpose() * Eigen::Vector3d::UnitZ();
  for (const ImuSample& sample : samples) {
    EXPECT_LT((sample.acceleration_m_s2 - kGravityMS2 * up).norm(), 1e-9);
    EXPECT_LT(sample.angular_velocity_rad_s.norm(), 1e-12);
  }
}

TEST(SimulateImu, HasTheNoiseOfItsConfig) {
  ImuConfig config;
  config.gyro_bias_walk = config.accelerometer_bias_walk = 0;
  const auto samples = SimulateImu(
      config, [](double) { return Eigen::Isometry3d::Identity(); }, 7, 100);
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  Eigen::Array3d squares = Eigen::Array3d::Zero();
  for (const ImuSample& sample : samples) {
    sum += sample.angular_velocity_rad_s.array();
    squares += sample.angular_velocity_rad_s.array().square();
  }
  const auto n = static_cast<double>(samples.size());
  const Eigen::Array3d deviation = (squares / n - (sum / n).square()).sqrt();
  const double expected = config.gyro_noise * std::sqrt(config.rate_hz);
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(deviation[axis], expected, 0.05 * expected);
}

}  // namespace
}  // namespace posefusion
