#pragma once

#include <Eigen/Geometry>

namespace posefusion {

/// Unit vector downwards in the camera frame. `T_odom_camera`: pose of the camera in a frame whose
/// z points upwards, such as that of odometry (REP 105).
inline Eigen::Vector3f GravityInCamera(const Eigen::Isometry3d& T_odom_camera) {
  const Eigen::Vector3d down_odom = -Eigen::Vector3d::UnitZ();
  return (T_odom_camera.linear().transpose() * down_odom).cast<float>();
}

}  // namespace posefusion
