#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

namespace posefusion {

/// Units per metre of 16-bit depth in ROS (REP-118: 16UC1 is millimetres).
constexpr double kMillimetresPerMetre = 1000;

/// Depth as the core wants it: CV_32FC1 metres in new memory, 0 = none.
///
/// CV_16UC1 is divided by `units_per_metre` (1000 for millimetres, 5000 for the TUM benchmark); 0
/// is none. CV_32FC1 is metres already; NaN, infinite and negative values become 0.
/// @throws std::invalid_argument naming `source` and the type for any other type, and for
/// units_per_metre that is not positive.
cv::Mat DepthToMetres(const cv::Mat& depth, const std::string& source,
                      double units_per_metre = kMillimetresPerMetre);

}  // namespace posefusion
