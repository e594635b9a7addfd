#pragma once

#include <opencv2/core/mat.hpp>
#include <opencv2/video/tracking.hpp>

namespace posefusion {

/// Where the content of an image was in an earlier one: dense optical flow (dense inverse search,
/// Kroeger et al. 2016) at the resolution of the cells. Keeps its memory. Not thread-safe.
class MotionField {
 public:
  MotionField();

  /// `motion` becomes CV_32FC2 of the images' size: pixel x of `now` shows what pixel
  /// x + motion(x) of `before` showed. Both are CV_8UC1 of one size. The same for any number of
  /// threads.
  void Estimate(const cv::Mat& now, const cv::Mat& before, cv::Mat& motion);

 private:
  cv::Ptr<cv::DISOpticalFlow> flow_;
};

/// Grey image with one pixel per cell of `size` (CV_8UC1), the mean of each.
void ReduceToCells(const cv::Mat& rgb, cv::Size size, cv::Mat& grey);

}  // namespace posefusion
