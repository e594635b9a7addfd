#pragma once

#include <string>
#include <vector>

#include "posefusion/image/blur_filter.h"
#include "posefusion/pipeline/camera_info_config.h"
#include "posefusion/pipeline/slam_config.h"
#include "posefusion/segmentation/human_removal_config.h"

namespace posefusion {

/// Every value of a run: a group per nodelet, and what they share.
struct SystemConfig {
  CameraInfoConfig camera_info;  ///< of bags
  BlurFilterConfig blur_filter;
  HumanRemovalConfig human_removal;
  SlamConfig mapping;
};

template <class V>
void Describe(V& v, SystemConfig& c) {
  v.Group("camera_info", c.camera_info);
  v.Group("blur_filter", c.blur_filter);
  v.Group("human_removal", c.human_removal);
  v.Group("mapping", c.mapping);
}

/// The defaults, overlaid by yaml files in their order (files of config/presets and
/// config/datasets, or a user's own).
/// @throws std::invalid_argument naming file and full key for what cannot be used.
SystemConfig LoadSystemConfig(const std::vector<std::string>& yaml_paths);

}  // namespace posefusion
