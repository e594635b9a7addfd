#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "posefusion_ros/tf_tree.h"
#include "posefusion_ros/trouble_log.h"

namespace posefusion {

/// Where down is for the camera, by the robot's odometry: its frame stands upright (REP 105). Not
/// thread-safe; no ROS master.
class GravityFinder {
 public:
  static constexpr double kPatienceS = 1;     ///< missing for less time is not told
  static constexpr double kLogPeriodS = 600;  ///< nor again before

  /// `odom_frame` "" = there is no odometry, nothing is known. `tree` must outlive this.
  GravityFinder(std::string odom_frame, const TfTree& tree, TroubleLog::Sink log_error);

  /// Unit vector downwards in the camera frame when the image was taken. Nothing when tf has not
  /// told after `timeout_s`; not waited for while the pose missed last has still not come: tf is
  /// too late or silent then. `now_s` is any steady clock in seconds.
  std::optional<Eigen::Vector3f> Find(StampNs stamp_ns, const std::string& camera_frame,
                                      double timeout_s, double now_s);

 private:
  void NoteMissing(StampNs stamp_ns, const std::string& camera_frame, double now_s);

  const std::string odom_frame_;
  const TfTree& tree_;
  const TroubleLog::Sink log_error_;
  std::optional<StampNs> missed_ns_;       ///< the image of the last call, when nothing was found
  std::optional<double> missing_since_s_;  ///< no image since then had a pose
  std::optional<double> told_s_;
};

}  // namespace posefusion
