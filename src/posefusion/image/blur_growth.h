#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace posefusion {

/// What happened in a tile of the image since the image before.
struct BlurTile {
  cv::Point2d moved_px;  ///< median of where its content went
  bool matches = false;  ///< false: nothing is known of the growth
  /// How much more it is blurred along x and y: the growth of the squares of the components of l,
  /// how far the content moved while the shutter was open.
  double growth_xx_px2 = 0;
  double growth_yy_px2 = 0;
  double weight_xx = 0;  ///< inverse variance by noise; small where little has texture
  double weight_yy = 0;
};

/// The image (CV_8UC1) as MeasureBlurGrowth wants it: at half resolution, smoothed (CV_32FC1).
void SmoothForBlurGrowth(const cv::Mat& grey, cv::Mat& smooth);

/// Compares two images, smoothed as above. `motion_px` (CV_32FC2, of any resolution) tells where
/// the content went, in pixels of the full image. Blur diffuses an image along the motion: to
/// second order now = before - d grad + 1/24 tr(growth Hessian), which is solved in each of 8x6
/// tiles for the shift d that is left and the growth. Brightness does not matter. Right to a fifth
/// for blur up to 5 px. The tiles come row by row.
std::vector<BlurTile> MeasureBlurGrowth(const cv::Mat& before, const cv::Mat& now,
                                        const cv::Mat& motion_px);

}  // namespace posefusion
