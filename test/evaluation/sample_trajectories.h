#pragma once

#include <cmath>

#include "posefusion/common/lie.h"
#include "posefusion/common/trajectory.h"

namespace posefusion {

constexpr StampNs kSampleStartNs = 1'000'000'000'000;
constexpr StampNs kSamplePeriodNs = 33'333'333;  ///< 30 Hz

/// A camera that moves smoothly in all directions and turns, with `num_poses` poses at 30 Hz.
inline Trajectory WavyTrajectory(int num_poses) {
  Trajectory trajectory;
  for (int i = 0; i < num_poses; ++i) {
    const double t = i / 30.0;
    StampedPose pose{kSampleStartNs + i * kSamplePeriodNs, Eigen::Isometry3d::Identity()};
    pose.T_map_camera.translation() << std::sin(t), 0.7 * std::cos(1.3 * t), 0.3 * std::sin(2 * t);
    pose.T_map_camera.linear() = ExpSO3({0.3 * std::sin(t), 0.5 * t, 0.2 * std::cos(t)});
    trajectory.push_back(pose);
  }
  return trajectory;
}

/// The same poses in another map frame.
inline Trajectory InOtherMap(const Trajectory& trajectory, const Eigen::Isometry3d& T_other_map) {
  Trajectory moved = trajectory;
  for (StampedPose& pose : moved) pose.T_map_camera = T_other_map * pose.T_map_camera;
  return moved;
}

}  // namespace posefusion
