#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "posefusion/common/stamp.h"

namespace posefusion {

/// Errors of a MEMS inertial unit. White noise as in the data sheet of Xsens' MTi 10 series (0.03
/// degrees/s/sqrt(Hz) and 60 ug/sqrt(Hz)); biases of that grade.
struct ImuConfig {
  double rate_hz = 200;
  double gyro_noise = 5.2e-4;             ///< rad/s/sqrt(Hz)
  double gyro_bias_rad_s = 0.002;         ///< deviation of the bias at the start
  double gyro_bias_walk = 3e-5;           ///< rad/s/sqrt(s)
  double accelerometer_noise = 5.9e-4;    ///< m/s2/sqrt(Hz)
  double accelerometer_bias_m_s2 = 0.02;  ///< deviation of the bias at the start
  double accelerometer_bias_walk = 2e-4;  ///< m/s2/sqrt(s)
};

/// One measurement in the unit's own axes.
struct ImuSample {
  double time_s = 0;
  Eigen::Vector3d angular_velocity_rad_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d acceleration_m_s2 = Eigen::Vector3d::Zero();  ///< at rest +9.81 upwards
};

constexpr double kGravityMS2 = 9.80665;

/// Measurements of a unit that moves as given, from 0 to `seconds`. Map frame: z up.
std::vector<ImuSample> SimulateImu(const ImuConfig& config,
                                   const std::function<Eigen::Isometry3d(double)>& T_map_imu,
                                   int seed, double seconds);

}  // namespace posefusion
