#pragma once

#include "posefusion/image/blur_filter.h"
#include "posefusion_ros/nodelets/input_config.h"

namespace posefusion {

/// What the BlurFilter nodelet does besides judging images.
struct BlurFilterRosConfig {
  InputConfig input;
  bool input_is_paired = false;  ///< colour and depth come in pairs only, depth first
};

template <class V>
void Describe(V& v, BlurFilterRosConfig& c) {
  v.Group("input", c.input);
  v.Field("input_is_paired", c.input_is_paired);
}

/// All parameters of the BlurFilter nodelet: the filter's own keys beside the group of this side.
struct BlurFilterNodeletConfig {
  BlurFilterRosConfig ros;
  BlurFilterConfig filter;
};

template <class V>
void Describe(V& v, BlurFilterNodeletConfig& c) {
  v.Group("ros", c.ros);
  Describe(v, c.filter);
}

}  // namespace posefusion
