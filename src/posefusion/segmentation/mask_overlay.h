#pragma once

#include <opencv2/core/mat.hpp>

#include "posefusion/segmentation/person_cutter.h"

namespace posefusion {

/// A copy of a colour image (CV_8UC3, R G B) with what `cutter` found in it last: people tinted
/// red, background surfaces blue, seeds as dots, yellow for joints and green for others.
cv::Mat DrawCut(const cv::Mat& rgb, const cv::Mat& mask, const PersonCutter& cutter);

}  // namespace posefusion
