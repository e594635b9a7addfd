#pragma once

#include <Eigen/Core>

#include "posefusion/image/camera_model.h"

namespace posefusion {

/// (x / z, y / z) of the ray that a pixel of the incoming image sees, lens distortion taken out.
Eigen::Vector2d RayOf(const CameraModel& camera, double u, double v);

/// Pixel of the incoming image, lens distortion put in, that shows a point with z > 0.
Eigen::Vector2d DistortedPixelOf(const CameraModel& camera, const Eigen::Vector3d& p_camera);

}  // namespace posefusion
