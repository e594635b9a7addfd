#pragma once

#include <sensor_msgs/Image.h>

#include <opencv2/core/mat.hpp>
#include <string>

namespace posefusion {

/// A cv::Mat over the pixels of a message, without a copy. It holds the message: as long as the Mat
/// or a Mat sharing its pixels exists, the message does. Nobody may write to it.
/// @throws std::invalid_argument naming the topic when the message is empty or has fewer bytes than
/// its size needs.
cv::Mat ShareImage(const sensor_msgs::ImageConstPtr& image, int type, const std::string& topic);

}  // namespace posefusion
