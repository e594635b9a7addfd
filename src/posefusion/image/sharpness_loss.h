#pragma once

#include <opencv2/core/mat.hpp>

namespace posefusion {

/// How much fine detail an image (CV_8UC1, smoothed against noise) has [grey levels^2]: the mean
/// square of the differences of neighbouring pixels, as the geometric mean of four directions.
double FineDetail(const cv::Mat& image);

/// How much fine structure an image has lost against the one before, with the same things in view:
/// the change of the logarithm of (mean square of differences over 1 pixel / over 16 pixels), taken
/// on what both images show, as the mean of four directions. The ratio does not depend on contrast;
/// positive = less sharp, about 0 for equal sharpness. `shift_px` is where the content went. Images
/// are CV_8UC1 of one size, smoothed against noise. 0 when they share less than a strip.
double SharpnessLoss(const cv::Mat& before, const cv::Mat& now, cv::Point2d shift_px);

}  // namespace posefusion
