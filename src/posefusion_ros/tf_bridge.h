#pragma once

#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/transform_broadcaster.h>

#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "posefusion_ros/robot_locator.h"
#include "posefusion_ros/start_pose_finder.h"
#include "posefusion_ros/trouble_log.h"

namespace posefusion {

/// Tells tf where the robot is in the map and asks tf where the camera is in the robot.
///
/// With an odometry frame `map -> odom` is a correction (REP-105): the tracked pose with the
/// robot's odom -> camera at the stamp of the image subtracted, sent at `rate_hz` with a stamp a
/// little in the future; the last good one stays while tracking is lost. Without, map -> root of
/// the camera's tree carries the stamps of the images. A frame that somebody else holds is never
/// given another parent. Thread-safe.
class TfBridge {
 public:
  struct Callbacks {
    /// Poses in order, each once its transforms have come. Any thread, one at a time.
    std::function<void(const LocatedPose&)> located;
    TroubleLog::Sink log_error;
    TroubleLog::Sink log_info;
  };

  /// @throws std::invalid_argument for frame names that cannot be.
  TfBridge(ros::NodeHandle node, const FramesConfig& frames, const TfConfig& tf,
           const StartConfig& start, double jump_back_s, Callbacks callbacks);

  /// A frame has been tracked.
  void Offer(const TrackedPose& pose);

  /// Map and poses have been forgotten: nothing is sent until the next pose.
  void Reset();

  /// The camera's pose in the map's first frame; may wait for tf (start.wait_s), but not again for
  /// the next frame if nothing came. From one thread.
  Eigen::Isometry3d FindStartPose(StampNs stamp_ns, const std::string& camera_frame);

  /// T_odom_camera when the image was taken, without waiting; nothing without odometry or when tf
  /// does not tell. The motion between two images is T_odom_camera(t0)^-1 * T_odom_camera(t1).
  std::optional<Eigen::Isometry3d> OdomToCamera(StampNs stamp_ns,
                                                const std::string& camera_frame) const {
    return locator_.OdomToCamera(stamp_ns, camera_frame);
  }

  /// What is wrong with the robot's frames; empty when nothing is.
  std::string trouble() const;

 private:
  using TfEvent = ros::MessageEvent<const tf2_msgs::TFMessage>;

  void OnTf(const TfEvent& event, bool is_static);
  bool IsOwn(const geometry_msgs::TransformStamped& transform, const std::string& publisher) const;
  void Deliver();
  void Broadcast();
  void Send(const ros::Time& stamp);
  void Tell();

  const FramesConfig frames_;
  const TfConfig tf_;
  const Callbacks callbacks_;
  const double start_wait_s_;
  TfTree tree_;
  StartPoseFinder start_;
  std::string start_told_;      ///< where the start pose came from last
  bool start_may_wait_ = true;  ///< what was waited for last did come
  mutable std::mutex mutex_;    ///< guards what follows
  RobotLocator locator_;
  TroubleLog log_;
  std::optional<MapChild> child_;  ///< the last good one
  Eigen::Isometry3d T_map_visual_ = Eigen::Isometry3d::Identity();
  ros::Time sent_;  ///< stamp of the newest map -> child
  tf2_ros::TransformBroadcaster broadcaster_;
  ros::Subscriber tf_subscriber_;
  ros::Subscriber tf_static_subscriber_;
  ros::Subscriber imu_subscriber_;
  ros::WallTimer timer_;
};

}  // namespace posefusion
