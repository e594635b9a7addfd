#pragma once

#include <ros/ros.h>

#include "posefusion_ros/tf_tree.h"

namespace posefusion {

/// Tells a tree what comes on /tf and /tf_static, on the threads of the node's callbacks.
class TfFeed {
 public:
  /// `tree` must outlive this.
  TfFeed(ros::NodeHandle node, TfTree& tree);

 private:
  ros::Subscriber moving_;
  ros::Subscriber fixed_;
};

}  // namespace posefusion
