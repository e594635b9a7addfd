#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "posefusion/segmentation/seeds.h"

namespace posefusion {

/// A copy of a colour image (CV_8UC3, R G B) in which people are tinted red, and the seeds of
/// `people` are drawn: joints yellow, others green.
cv::Mat DrawMask(const cv::Mat& rgb, const cv::Mat& mask, const std::vector<PersonSeeds>& people);

}  // namespace posefusion
