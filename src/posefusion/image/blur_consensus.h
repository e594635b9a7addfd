#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "posefusion/image/blur_growth.h"

namespace posefusion {

/// What the tiles of an image agree on: weighted medians, in which textured tiles count most. A
/// person who moves is blurred and counts little, so this is the camera's share.
struct BlurConsensus {
  cv::Point2d moved_px;  ///< where the content went while the shutter was open
  double length_px = 0;  ///< how far; more than |moved_px| when the image turns
  double change_px = 0;  ///< how far that differs from the motion of the image before
  double growth_xx_px2 = 0;
  double growth_yy_px2 = 0;
  double spread_px2 = 0;  ///< median deviation of the growth along x and y
  double error_px2 = 0;   ///< standard deviation of the growth by noise
};

/// `share` is exposure over the time between images; `before` and `share_before` are those of the
/// image before, or empty: then nothing has changed.
BlurConsensus FindConsensus(const std::vector<BlurTile>& tiles, double share,
                            const std::vector<BlurTile>& before, double share_before);

}  // namespace posefusion
