#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "posefusion/skeleton/skeletons.h"

namespace posefusion {

/// Draws bones and joints into a CV_8UC3 image (B G R), a colour per person.
void DrawSkeletons(const std::vector<Skeleton>& people, cv::Mat& bgr);

}  // namespace posefusion
