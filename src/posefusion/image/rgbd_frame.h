#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

#include "posefusion/common/stamp.h"
#include "posefusion/image/camera_model.h"

namespace posefusion {

/// One colour image with depth registered to its pixels. Images are shared, never changed.
struct RgbdFrame {
  StampNs stamp_ns = 0;        ///< of the colour image; the key of everything made from the frame
  StampNs depth_stamp_ns = 0;  ///< of the depth image
  int index = -1;              ///< of the colour image in its stream, from 0; -1 = not counted
  cv::Mat rgb;                 ///< CV_8UC3, order R G B
  cv::Mat depth_m;             ///< CV_32FC1 metres along the optical axis, 0 = none
  CameraModel camera;          ///< of both images, with the distortion that they have
};

/// @throws std::invalid_argument naming `source` when image types or sizes do not fit each other
/// and the camera.
void CheckFrame(const RgbdFrame& frame, const std::string& source);

/// @throws std::invalid_argument naming both when `stamp_ns` is not after `last_ns`, if there is
/// one.
void CheckFollows(StampNs stamp_ns, const std::optional<StampNs>& last_ns);

}  // namespace posefusion
