#pragma once

#include <Eigen/Geometry>

#include "posefusion/image/camera_model.h"
#include "posefusion/simulation/head_motion.h"

namespace posefusion::testing {

/// Stands beside the table of the room, looks across it and turns to the left.
class TurningHead : public HeadMotion {
 public:
  explicit TurningHead(double turn_rad_per_s = 0, double yaw_rad = 1.2)
      : turn_rad_per_s_(turn_rad_per_s), yaw_rad_(yaw_rad) {}

  Eigen::Isometry3d T_map_camera(double time_s) const override {
    Eigen::Matrix3d optical;
    optical << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.translation() << -0.9 + 0.1 * time_s, -1.9, 1.4;
    T.linear() = Eigen::AngleAxisd(yaw_rad_ + turn_rad_per_s_ * time_s, Eigen::Vector3d::UnitZ()) *
                 Eigen::AngleAxisd(0.25, Eigen::Vector3d::UnitY()).toRotationMatrix() * optical;
    return T;
  }

 private:
  double turn_rad_per_s_;
  double yaw_rad_;
};

/// 160x120 with the field of view of the real one.
inline CameraModel QuarterCamera() { return {160, 120, 131.25, 131.25, 79.5, 59.5, {}}; }

}  // namespace posefusion::testing
