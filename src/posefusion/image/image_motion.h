#pragma once

#include <opencv2/core/mat.hpp>

#include "posefusion/image/motion_field.h"

namespace posefusion {

/// Follows the motion of the image at a width of 160 pixels. Where nothing has texture, and beyond
/// some 20 pixels of the full image per frame where little has, the motion is a guess. The same
/// images give the same result. Not thread-safe.
class ImageMotion {
 public:
  /// Takes the next image (CV_8UC1) and tells where its content went since the image before: the
  /// motion in pixels of the image (CV_32FC2, 160 columns). It has the size 0 for the first image,
  /// after another size, and for less than 64 rows or columns. Valid until the next call.
  const cv::Mat& Next(const cv::Mat& grey);

 private:
  MotionField field_{MotionDetail::kFine};
  cv::Size size_;  ///< of the last image
  cv::Mat before_;
  cv::Mat now_;
  cv::Mat motion_px_;
};

}  // namespace posefusion
