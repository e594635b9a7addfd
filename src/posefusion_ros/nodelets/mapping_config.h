#pragma once

#include <string>

#include "posefusion/pipeline/slam_config.h"
#include "posefusion_ros/nodelets/frames_config.h"
#include "posefusion_ros/nodelets/input_config.h"

namespace posefusion {

/// What the Mapping nodelet does besides tracking and fusing.
struct MappingRosConfig {
  InputConfig input;
  /// The topics under sharp/ carry only pairs, as BlurFilter sends them. Set to false when they
  /// are remapped to a camera driver.
  bool input_is_paired = true;
  /// Frames are taken with what HumanRemoval publishes for them, not as they come.
  bool human_removal = false;
  double human_removal_hold_s = 2.0;  ///< so long frames wait for HumanRemoval at most
  int queue_size = 1;                 ///< frames that may wait for tracking; the oldest is dropped
  int num_threads = 2;                ///< for tracking and fusion
  double reset_after_jump_back_s = 0.5;  ///< stamps this far back mean that a bag was restarted
  TfConfig tf;
  StartConfig start;
  double path_period_s = 0.5;          ///< between messages on `path`
  double surfel_cloud_period_s = 2.0;  ///< between messages on `surfel_cloud`
  double model_image_period_s = 0.1;   ///< between messages on `model/image`
  std::string output_dir;  ///< trajectory.txt and map.ply are saved here at the end; "" = nowhere
};

template <class V>
void Describe(V& v, MappingRosConfig& c) {
  v.Group("input", c.input);
  v.Field("input_is_paired", c.input_is_paired);
  v.Field("human_removal", c.human_removal);
  v.Field("human_removal_hold_s", c.human_removal_hold_s, 0.1, 60.0);
  v.Field("queue_size", c.queue_size, 1, 1000);
  v.Field("num_threads", c.num_threads, 1, 64);
  v.Field("reset_after_jump_back_s", c.reset_after_jump_back_s, 0.0, 3600.0);
  v.Group("tf", c.tf);
  v.Group("start", c.start);
  v.Field("path_period_s", c.path_period_s, 0.0, 3600.0);
  v.Field("surfel_cloud_period_s", c.surfel_cloud_period_s, 0.0, 3600.0);
  v.Field("model_image_period_s", c.model_image_period_s, 0.0, 3600.0);
  v.Field("output_dir", c.output_dir);
}

/// All parameters of the Mapping nodelet: the core's own keys beside the groups of this side.
struct MappingConfig {
  MappingRosConfig ros;
  FramesConfig frames;
  SlamConfig slam;
};

template <class V>
void Describe(V& v, MappingConfig& c) {
  v.Group("ros", c.ros);
  v.Group("frames", c.frames);
  Describe(v, c.slam);
}

}  // namespace posefusion
