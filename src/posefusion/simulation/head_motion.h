#pragma once

#include <Eigen/Geometry>

namespace posefusion {

/// Where the simulated robot's head camera is, as a smooth deterministic function of time.
/// Map frame: z up, floor at z = 0, metres. Camera: RGB optical frame. Time: seconds from the
/// start.
class HeadMotion {
 public:
  virtual ~HeadMotion() = default;

  /// True pose of the camera at a time; defined for every time, constant outside the run.
  virtual Eigen::Isometry3d T_map_camera(double time_s) const = 0;
};

}  // namespace posefusion
