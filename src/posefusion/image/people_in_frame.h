#pragma once

#include <opencv2/core/mat.hpp>

namespace posefusion {

/// Where people are in a frame.
struct PeopleInFrame {
  cv::Mat mask;  ///< CV_8UC1 of the frame's size, 255 = person; empty = nobody
  /// CV_32FC1 metres: depth with the people still in it, where the frame's has them taken out.
  /// Empty = the frame's.
  cv::Mat depth_m;
};

}  // namespace posefusion
