#pragma once

#include <Eigen/Geometry>
#include <array>

#include "posefusion/image/camera_model.h"
#include "posefusion/surfel/surfel_chunk.h"

namespace posefusion {

/// What a camera can see up to a distance: planes through the image's border and two across.
class Frustum {
 public:
  /// `margin_px` widens the image on every side.
  Frustum(const CameraModel& camera, const Eigen::Isometry3d& T_map_camera, double max_depth_m,
          double margin_px);

  /// False only when no point of the box can be seen.
  bool Touches(const Box& box) const;

 private:
  /// normal . p + offset >= 0 inside, map frame.
  struct Plane {
    Eigen::Vector3f normal;
    float offset;
  };
  std::array<Plane, 6> planes_;
};

}  // namespace posefusion
