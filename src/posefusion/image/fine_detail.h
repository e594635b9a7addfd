#pragma once

#include <opencv2/core/mat.hpp>

namespace posefusion {

/// How much fine detail an image (CV_8UC1, smoothed against noise) has [grey levels^2]: the mean
/// square of the differences of neighbouring pixels, as the geometric mean of four directions.
double FineDetail(const cv::Mat& image);

}  // namespace posefusion
