#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <utility>

#include "posefusion/common/trajectory.h"

namespace posefusion {

/// Where odometry has the camera.
class OdometrySource {
 public:
  virtual ~OdometrySource() = default;

  /// T_odom_camera at a stamp; nothing where it is not known.
  virtual std::optional<Eigen::Isometry3d> PoseAt(StampNs stamp_ns) const = 0;
};

/// Odometry that is known beforehand: T_odom_camera at stamps of its own, interpolated between
/// them.
class RecordedOdometry : public OdometrySource {
 public:
  /// Longer pauses between samples count as missing odometry.
  static constexpr double kMaxGapS = 0.25;

  explicit RecordedOdometry(Trajectory T_odom_camera)
      : trajectory_(LastOfEachStamp(T_odom_camera)) {}

  std::optional<Eigen::Isometry3d> PoseAt(StampNs stamp_ns) const override {
    return InterpolatedPose(trajectory_, stamp_ns, kMaxGapS);
  }

 private:
  Trajectory trajectory_;
};

}  // namespace posefusion
