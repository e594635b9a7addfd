#pragma once

#include <Eigen/Core>

namespace posefusion {

/// Where a part of a body may be of which no joint was found.
struct UnseenPart {
  Eigen::Vector3f p_camera;  ///< metres
  float radius_m = 0;
  bool leaves_image = false;  ///< the part goes on outside the image
};

}  // namespace posefusion
