#pragma once

#include <Eigen/Core>

#include "posefusion/image/frame_pyramid.h"
#include "posefusion/tracking/tracking_config.h"

namespace posefusion {

/// R_reference_current: how the camera has turned between two images, taking them for images of
/// something far away (homography K R K^-1), by Gauss-Newton over intensity differences with
/// robust weights. Pixels of negative intensity do not count. Identity where that did not reduce
/// the error.
Eigen::Matrix3d AlignRotation(const Grid<float>& reference, const Grid<float>& current,
                              const CameraModel& camera, const So3Config& config);

}  // namespace posefusion
