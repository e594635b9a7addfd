#pragma once

#include <algorithm>
#include <cmath>

#include "posefusion/common/lie.h"
#include "posefusion/common/stage_clock.h"
#include "posefusion/simulation/head_motion.h"

namespace posefusion {

/// Medians and 95 % quantiles of a camera's speed.
struct SpeedStatistics {
  double median_m_s = 0;
  double p95_m_s = 0;
  double median_deg_s = 0;
  double p95_deg_s = 0;
};

/// From differences over 0.1 s at 30 Hz, as the numbers in the tests were taken from recordings.
inline SpeedStatistics SpeedsOf(const HeadMotion& motion, double seconds) {
  constexpr double kWindowS = 0.1;
  constexpr double kDegrees = 180 / 3.141592653589793;
  std::vector<double> linear;
  std::vector<double> angular;
  for (double t = 0; t + kWindowS < seconds; t += 1.0 / 30) {
    const Eigen::Isometry3d from = motion.T_map_camera(t);
    const Eigen::Isometry3d to = motion.T_map_camera(t + kWindowS);
    linear.push_back((to.translation() - from.translation()).norm() / kWindowS);
    angular.push_back(LogSO3(from.linear().transpose() * to.linear()).norm() / kWindowS * kDegrees);
  }
  return {Quantile(linear, 0.5), Quantile(linear, 0.95), Quantile(angular, 0.5),
          Quantile(angular, 0.95)};
}

/// Largest change of velocity between two neighbouring intervals of `step_s`: goes to zero with the
/// interval for a motion that is continuously differentiable.
inline double LargestVelocityStep(const HeadMotion& motion, double seconds, double step_s) {
  double largest = 0;
  for (double t = 0; t < seconds; t += 0.003) {
    const Eigen::Vector3d a = motion.T_map_camera(t).translation();
    const Eigen::Vector3d b = motion.T_map_camera(t + step_s).translation();
    const Eigen::Vector3d c = motion.T_map_camera(t + 2 * step_s).translation();
    largest = std::max(largest, (a - 2 * b + c).norm() / step_s);
  }
  return largest;
}

}  // namespace posefusion
