#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "posefusion/common/stamp.h"

namespace posefusion {

/// Where the camera (RGB optical frame) was at a moment.
struct StampedPose {
  StampNs stamp_ns = 0;
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
};

/// Poses in order of increasing stamps.
using Trajectory = std::vector<StampedPose>;

}  // namespace posefusion
