#pragma once

#include <sensor_msgs/Imu.h>

#include <deque>
#include <mutex>
#include <optional>
#include <string>

#include "posefusion_ros/nodelets/frames_config.h"
#include "posefusion_ros/tf_tree.h"

namespace posefusion {

/// The camera in the map before anything has been seen.
struct StartPose {
  Eigen::Isometry3d T_map_camera;
  std::string told_by;   ///< for people
  bool as_asked = true;  ///< false: what was asked for did not come, the camera is taken as level
};

/// Finds out how the camera stands when the map begins, so that the map's z points upwards: from
/// odometry, whose frame stands upright, or from an accelerometer. Thread-safe.
class StartPoseFinder {
 public:
  /// `tree` must outlive this.
  StartPoseFinder(const StartConfig& config, const FramesConfig& frames, const TfTree& tree)
      : config_(config), frames_(frames), tree_(tree) {}

  void AddImu(const sensor_msgs::ImuConstPtr& imu);

  /// `imu_speaks`: somebody publishes. Waits up to `timeout_s` until what is needed has come.
  StartPose Find(StampNs stamp_ns, const std::string& camera_frame, bool imu_speaks,
                 double timeout_s) const;

 private:
  std::optional<Eigen::Vector3d> UpInCamera(StampNs stamp_ns, const std::string& camera_frame,
                                            double timeout_s) const;
  std::optional<sensor_msgs::Imu> MeanImu(StampNs stamp_ns) const;
  StartPose Given(const std::string& why_not) const;

  const StartConfig config_;
  const FramesConfig frames_;
  const TfTree& tree_;
  mutable std::mutex mutex_;
  std::deque<sensor_msgs::ImuConstPtr> imu_;  ///< the latest, oldest first
};

}  // namespace posefusion
