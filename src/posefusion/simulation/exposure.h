#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "posefusion/common/parallel.h"
#include "posefusion/simulation/ray_packet.h"
#include "posefusion/simulation/renderer.h"

namespace posefusion {

constexpr int kTileSide = 16;     ///< pixels; blocks of work, and of one number of views
constexpr int kMotionStride = 4;  ///< pixels between places where motion is measured

/// The camera's poses over an exposure, at shares 0 to 1 of its time.
class ExposurePoses {
 public:
  ExposurePoses(const HeadMotion& head, const Exposure& exposure);
  RayOrigin At(double share) const;
  /// The pose itself, for measuring.
  Eigen::Isometry3d PoseAt(double share) const;

 private:
  std::vector<Eigen::Isometry3d> poses_;
};

/// Share of the exposure's time at which a row's shutter is half through its opening, and half of
/// that opening as a share.
struct RowTime {
  double middle;
  double half;
};
RowTime TimeOfRow(const Exposure& exposure, int row, int height);

/// How far the content of every 4th pixel of `view` moves over the image while its row is open.
cv::Mat MeasureMotion(const RayScene& scene, const PixelRays& rays, const View& view,
                      const Exposure& exposure, const ExposurePoses& poses);

/// How far the image is smeared: the median of `motion_px` over all of it. That is the camera's own
/// motion unless a person who moves fills more than half of the view.
double TrueBlurLength(const cv::Mat& motion_px);

/// Number of views for each tile: 1 where nothing moves by more than a pixel, else odd.
cv::Mat ViewsPerTile(const cv::Mat& motion_px, int max_views);

}  // namespace posefusion
