#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace posefusion {

/// A local maximum of a heat map, in its pixels.
struct HeatMapPeak {
  float x = 0;
  float y = 0;
  float confidence = 0;  ///< height of the maximum, at most 1
};

/// Local maxima (3 x 3) of a CV_32FC1 heat map above `threshold`, refined to parts of a pixel by a
/// parabola in each direction; the highest first, 64 at most. NaN is no maximum.
std::vector<HeatMapPeak> FindPeaks(const cv::Mat& heat, double threshold);

}  // namespace posefusion
