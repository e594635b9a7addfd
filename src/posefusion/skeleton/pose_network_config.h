#pragma once

#include <string>

#include "posefusion/skeleton/part_grouping_config.h"

namespace posefusion {

struct PoseNetworkConfig {
  /// Weights: OpenPose's COCO .caffemodel, or a .pb graph of tf-openpose; "" = no network.
  std::string model;
  std::string model_config;   ///< the .prototxt that goes with a .caffemodel; "" for a .pb
  int input_width_px = 432;   ///< of the network, a multiple of 8; a .pb may be made for one size
  int input_height_px = 368;  ///< the image fills as much of it as its shape allows
  int num_threads = 1;        ///< of OpenCV, which has one number for the whole process
  double rate_hz = 0;         ///< images looked at per second at most, by stamp; 0 = no limit
  int niceness = 10;          ///< of the thread (live): 0 = as the rest, 19 = when others idle
  PartGroupingConfig grouping;
};

template <class V>
void Describe(V& v, PoseNetworkConfig& c) {
  v.Field("model", c.model);
  v.Field("model_config", c.model_config);
  v.Field("input_width_px", c.input_width_px, 64, 2048);
  v.Field("input_height_px", c.input_height_px, 64, 2048);
  v.Field("num_threads", c.num_threads, 1, 64);
  v.Field("rate_hz", c.rate_hz, 0.0, 1000.0);
  v.Field("niceness", c.niceness, 0, 19);
  v.Group("grouping", c.grouping);
}

/// @throws std::invalid_argument naming the key for a value out of range.
PoseNetworkConfig CheckedConfig(const PoseNetworkConfig& config);

}  // namespace posefusion
