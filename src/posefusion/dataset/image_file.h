#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace posefusion {

/// Reads a PNG or JPEG colour image as CV_8UC3 in the order R G B; orientation tags are ignored,
/// because the depth image has none.
/// @throws std::runtime_error naming the file when it is missing, of another format or truncated.
cv::Mat ReadColourImage(const std::string& path);

/// Reads a PNG with one channel of 16 bits as CV_16UC1.
/// @throws std::runtime_error as ReadColourImage does, and for any other pixel type.
cv::Mat ReadDepthImage(const std::string& path);

/// Writes an image in the format that the name ends with; colours are B G R, as OpenCV has them.
/// The file appears whole or not at all. `parameters` are those of cv::imwrite.
/// @throws std::runtime_error naming a file that cannot be encoded or written.
void WriteImage(const cv::Mat& image, const std::string& path,
                const std::vector<int>& parameters = {});

}  // namespace posefusion
