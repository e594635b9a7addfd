#pragma once

#include "posefusion/segmentation/human_removal_config.h"
#include "posefusion_ros/nodelets/frames_config.h"
#include "posefusion_ros/nodelets/input_config.h"

namespace posefusion {

/// What the HumanRemoval nodelet does besides cutting people out.
struct HumanRemovalRosConfig {
  InputConfig input;
  bool input_is_paired = true;  ///< the topics under sharp/ carry only pairs
  /// Frames that may wait; the oldest is dropped. More wait while there are no keypoints yet.
  int queue_size = 1;
  /// A frame waits so long for its keypoints, as long as those of nearly every frame come in time.
  double keypoint_grace_s = 0.03;
  /// And so long for the camera's pose in `frames.odom_frame`, while those of the frames before
  /// came.
  double gravity_wait_s = 0.05;
  double reset_after_jump_back_s = 0.5;  ///< stamps this far back mean that a bag was restarted
};

template <class V>
void Describe(V& v, HumanRemovalRosConfig& c) {
  v.Group("input", c.input);
  v.Field("input_is_paired", c.input_is_paired);
  v.Field("queue_size", c.queue_size, 1, 1000);
  v.Field("keypoint_grace_s", c.keypoint_grace_s, 0.0, 10.0);
  v.Field("gravity_wait_s", c.gravity_wait_s, 0.0, 10.0);
  v.Field("reset_after_jump_back_s", c.reset_after_jump_back_s, 0.0, 3600.0);
}

/// All parameters of the HumanRemoval nodelet: the core's own keys beside the groups of this side.
struct HumanRemovalNodeletConfig {
  HumanRemovalRosConfig ros;
  FramesConfig frames;  ///< odom_frame tells where down is; the others are not used
  HumanRemovalConfig removal;
};

template <class V>
void Describe(V& v, HumanRemovalNodeletConfig& c) {
  v.Group("ros", c.ros);
  v.Group("frames", c.frames);
  Describe(v, c.removal);
}

}  // namespace posefusion
