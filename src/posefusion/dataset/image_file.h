#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

namespace posefusion {

/// Reads a PNG or JPEG colour image as CV_8UC3 in the order R G B; orientation tags are ignored,
/// because the depth image has none.
/// @throws std::runtime_error naming the file when it is missing, of another format or truncated.
cv::Mat ReadColourImage(const std::string& path);

/// Reads a PNG with one channel of 16 bits as CV_16UC1.
/// @throws std::runtime_error as ReadColourImage does, and for any other pixel type.
cv::Mat ReadDepthImage(const std::string& path);

}  // namespace posefusion
