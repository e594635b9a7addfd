#pragma once

#include <std_msgs/Header.h>

#include "posefusion/pipeline/slam.h"
#include "posefusion_ros/robot_locator.h"

namespace posefusion {

/// Chains the motions between tracked frames: where the map is corrected, the chain does not jump.
/// Not thread-safe.
class VisualOdometry {
 public:
  /// A frame has been tracked; its pose is the last of `trajectory`, and the one before is where
  /// the map has the camera of the frame before by now.
  TrackedPose Advance(const FrameResult& result, const Trajectory& trajectory,
                      const std_msgs::Header& rgb_header);

  /// A frame could not be tracked: the next one has no velocity.
  void NoteLost() { has_last_ = false; }

  /// The map has been forgotten.
  void Reset() { *this = VisualOdometry(); }

 private:
  Eigen::Isometry3d T_visual_camera_ = Eigen::Isometry3d::Identity();
  bool has_last_ = false;  ///< the frame before was tracked
};

}  // namespace posefusion
