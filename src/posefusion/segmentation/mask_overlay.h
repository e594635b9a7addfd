#pragma once

#include <opencv2/core/mat.hpp>

#include "posefusion/segmentation/person_cutter.h"

namespace posefusion {

/// Gives `picture` (CV_8UC3) the colours of `rgb`, half tinted, where `mask` (CV_8UC1) is not 0.
void TintMask(const cv::Mat& rgb, const cv::Mat& mask, const cv::Scalar& colour, cv::Mat& picture);

/// A copy of a colour image (CV_8UC3, R G B) with what `cutter` found in it last: people tinted
/// red, background surfaces blue, seeds as dots, yellow for joints and green for others.
cv::Mat DrawCut(const cv::Mat& rgb, const cv::Mat& mask, const PersonCutter& cutter);

}  // namespace posefusion
