#pragma once

#include <string>

#include "posefusion/image/camera_model.h"

namespace posefusion {

/// What camera.yaml of a dataset folder says.
struct CameraFile {
  CameraModel camera;           ///< of colour and registered depth
  double depth_scale = 1000.0;  ///< units of the depth PNGs per metre
};

/// Reads camera.yaml: width, height, fx, fy, cx, cy (pixels), depth_scale (units per metre) and
/// optionally distortion [k1, k2, p1, p2, k3] (plumb_bob, up to five numbers; absent = none).
/// @throws std::invalid_argument naming file and key for a missing, unknown or impossible one.
CameraFile ReadCameraFile(const std::string& path);

}  // namespace posefusion
