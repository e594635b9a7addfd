#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "posefusion/tracking/motion_prior.h"
#include "posefusion/tracking/motion_prior_config.h"

namespace posefusion {

/// Remembers what odometry said at the last tracked frame and how far the camera has gone since.
/// Not thread-safe.
class OdometryMotion {
 public:
  explicit OdometryMotion(const MotionPriorConfig& config) : config_(config) {}

  /// A new frame, and where odometry has the camera then, if it is known. Poses that are not
  /// finite count as unknown.
  void Advance(const std::optional<Eigen::Isometry3d>& T_odom_camera);

  /// The motion since the last tracked frame; nothing where odometry was missing at one end.
  std::optional<MotionPrior> SinceLastTracked() const;

  /// The frame of the last Advance was tracked.
  void NoteTracked();

 private:
  MotionPriorConfig config_;
  std::optional<Eigen::Isometry3d> T_odom_last_;    ///< at the last tracked frame
  std::optional<Eigen::Isometry3d> T_odom_latest_;  ///< the newest that is known since then
  std::optional<Eigen::Isometry3d> T_odom_camera_;  ///< of this frame
  double way_m_ = 0;                                ///< since the last tracked frame
  double turn_rad_ = 0;
};

}  // namespace posefusion
