#pragma once

#include <opencv2/core/mat.hpp>
#include <opencv2/video/tracking.hpp>
#include <vector>

#include "posefusion/image/shift_proposals.h"

namespace posefusion {

/// Follows the motion of the image at a width of 160 pixels. Each of 8x6 blocks takes the one of
/// the ShiftProposals that explains it best; from there dense optical flow (dense inverse search,
/// Kroeger et al. 2016) finds the motion of every pixel. Reaches about a fifth of the image's width
/// per frame. Where nothing has texture the motion is a guess. The same images give the same
/// result. Not thread-safe.
class ImageMotion {
 public:
  ImageMotion();

  /// Takes the next image (CV_8UC1) and tells where its content went since the image before: the
  /// motion in pixels of the image (CV_32FC2, 160 columns). It has the size 0 for the first image,
  /// after another size, and for less than 64 rows or columns. Valid until the next call.
  const cv::Mat& Next(const cv::Mat& grey);

 private:
  void StartFromShifts(const std::vector<cv::Point2f>& proposals);

  ShiftProposals proposals_;
  cv::Ptr<cv::DISOpticalFlow> flow_;
  cv::Size size_;  ///< of the last image
  cv::Mat before_;
  cv::Mat now_;
  cv::Mat before_f_;  ///< the same as CV_32FC1
  cv::Mat now_f_;
  cv::Mat motion_px_;
};

}  // namespace posefusion
