#include "posefusion_ros/visual_odometry.h"

namespace posefusion {

TrackedPose VisualOdometry::Advance(const FrameResult& result, const Trajectory& trajectory,
                                    const std_msgs::Header& rgb_header) {
  TrackedPose pose;
  pose.stamp_ns = result.stamp_ns;
  pose.camera_frame = rgb_header.frame_id;
  pose.T_map_camera = result.tracking.T_map_camera;
  pose.covariance = result.tracking.covariance;
  if (trajectory.size() < 2) {
    T_visual_camera_ = pose.T_map_camera;
  } else {
    const StampedPose& before = trajectory[trajectory.size() - 2];
    const Eigen::Isometry3d T_step = before.T_map_camera.inverse() * pose.T_map_camera;
    T_visual_camera_ = Orthonormalized(T_visual_camera_ * T_step);
    if (has_last_) {
      pose.interval_s = SecondsBetween(before.stamp_ns, result.stamp_ns);
      pose.velocity = LogSE3(T_step) / pose.interval_s;
    }
  }
  pose.T_visual_camera = T_visual_camera_;
  has_last_ = true;
  return pose;
}

}  // namespace posefusion
