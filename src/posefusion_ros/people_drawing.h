#pragma once

#include <std_msgs/Header.h>
#include <visualization_msgs/MarkerArray.h>

#include <opencv2/core/mat.hpp>
#include <vector>

#include "posefusion/segmentation/seeds.h"

namespace posefusion {

/// Pictures of what HumanRemoval found, for people to look at.

/// The image with the mask (CV_8UC1, 255 = person) tinted in; new memory.
cv::Mat DrawMask(const cv::Mat& rgb, const cv::Mat& mask);

/// Bones and joints of people in the camera frame, one colour per person. The first marker deletes
/// all that were drawn before; without people it is the only one.
visualization_msgs::MarkerArray ToSkeletonMarkers(const std::vector<PersonSeeds>& people,
                                                  const std_msgs::Header& header);

}  // namespace posefusion
