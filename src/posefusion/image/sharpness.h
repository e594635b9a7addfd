#pragma once

#include <opencv2/core/mat.hpp>

namespace posefusion {

/// The score of the paper (Pech-Pacheco 2000): variance of the 3x3 Laplacian of the grey image
/// (CV_8UC1) [grey levels^2]. Small for a blurred image, and for one without texture.
double VarianceOfLaplacian(const cv::Mat& grey);

/// The same of the image reduced to 20 columns: the contrast of things that are too large to be
/// blurred away. Small for a wall, large for a room, however blurred.
double CoarseContrast(const cv::Mat& grey);

}  // namespace posefusion
