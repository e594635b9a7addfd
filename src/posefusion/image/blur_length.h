#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "posefusion/common/stamp.h"
#include "posefusion/image/blur_consensus.h"
#include "posefusion/image/blur_growth.h"
#include "posefusion/image/image_motion.h"

namespace posefusion {

/// What is known of the blur of an image.
struct BlurEstimate {
  double length_px = 0;    ///< how far its content moved while the shutter was open
  double detail = 0;       ///< what fine detail it has left, see FineDetail() [grey levels^2]
  bool is_sudden = false;  ///< the blur grew much at once; this alone shows it
  double contrast = 0;     ///< of the image, see CoarseContrast() [grey levels^2]
};

/// Estimates how far the content of each image moved while the shutter was open, from two
/// measurements that fail in different places:
///   how far the image has moved since the one before, times exposure over the time between them:
///   good for lasting motion such as a fall, blind for a knock shorter than a frame;
///   by how much the blur grew against the image before, along and across (MeasureBlurGrowth):
///   good for a knock, but the sum drifts, and there is none where nothing has texture.
/// Both are combined for the camera as by a Kalman filter whose state are the squares of the
/// components of l. What moves otherwise, such as a person close by, has the length of its own
/// motion. The median over the image is the result. What is in view plays no part: a scene
/// of less texture has not grown blurred. Images come in stamp order. The same images give the same
/// lengths. Not thread-safe.
class BlurLength {
 public:
  explicit BlurLength(double exposure_s) : exposure_s_(exposure_s) {}

  /// The next image (CV_8UC1). Its length is taken to be small for the first, and for one after a
  /// gap of more than 0.2 s, after a step back in time, of another size or in another light.
  BlurEstimate Next(const cv::Mat& grey, StampNs stamp_ns);

  /// The next image does not follow on another: nothing could be seen in the last.
  void Forget();

 private:
  /// Squares of the components of the camera's l and the variance of each.
  struct Blur {
    double xx_px2 = 0;
    double yy_px2 = 0;
    double variance_px4 = 0;
  };

  static Blur Unknown();
  static Blur FromMotion(const BlurConsensus& consensus);
  bool Follows(const cv::Mat& grey, StampNs stamp_ns) const;
  /// False when the light changed, which looks like blur. Takes the image's contrast.
  bool HasSameContrast(double contrast);
  void Grow(const BlurConsensus& consensus);
  void Correct(const Blur& measured);
  double MedianLength(double share, const BlurConsensus& consensus);
  /// Whether the camera's motion explains a place clearly better than the motion found there.
  bool MovesWithCamera(cv::Point place, const cv::Vec2f& camera_moved_px) const;

  const double exposure_s_;
  ImageMotion image_motion_;
  cv::Mat smooth_;  ///< the last image, see SmoothForBlurGrowth
  cv::Mat before_;  ///< the one before
  cv::Mat fine_;    ///< the last image, smoothed against noise only
  cv::Size size_;
  StampNs stamp_ns_ = 0;
  std::vector<BlurTile> tiles_;  ///< of the last image; empty when it followed on none
  double share_ = 0;             ///< of the last image
  double contrast_ = 0;          ///< of the last image
  Blur blur_;                    ///< of the last image
  std::vector<float> lengths_px_;
};

}  // namespace posefusion
