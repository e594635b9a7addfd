#pragma once

#include <ros/ros.h>

#include "posefusion_ros/robot_locator.h"

namespace posefusion {

/// Poses of the robot's own frames, at the stamps of the images. One call at a time.
class RobotPublishers {
 public:
  RobotPublishers(ros::NodeHandle node, const FramesConfig& frames);

  /// head_pose and odometry, as far as the robot's frames are known.
  void Publish(const LocatedPose& located);

 private:
  void PublishHeadPose(const LocatedPose& located);
  void PublishOdometry(const LocatedPose& located);

  const FramesConfig frames_;
  ros::Publisher head_pose_;
  ros::Publisher odometry_;
};

}  // namespace posefusion
