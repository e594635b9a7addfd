#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <optional>

namespace posefusion {

/// Normal equations of how an area of an image changed, in its own pixels and grey levels.
/// Unknowns: shift that is left (x, y), growth of the variance of the blur (xx, xy, yy).
struct BlurEquations {
  Eigen::Matrix<double, 5, 5> normal = Eigen::Matrix<double, 5, 5>::Zero();
  Eigen::Matrix<double, 5, 1> right = Eigen::Matrix<double, 5, 1>::Zero();
  double square = 0;  ///< sum of the squares of the differences
  int count = 0;      ///< pixels
};

/// Compares `area` of `now` with what lay `shift` before there in `before` (both CV_32FC1); both
/// have a margin of a pixel around. Brightness is made equal by a factor. Derivatives are those of
/// the mean of both images, which makes the equations right to third order. Columns beyond a
/// multiple of eight are left out; nothing for less than eight, and in darkness.
std::optional<BlurEquations> BuildBlurEquations(const cv::Mat& before, const cv::Mat& now,
                                                const cv::Rect& area, cv::Point shift);

}  // namespace posefusion
