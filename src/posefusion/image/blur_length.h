#pragma once

#include <opencv2/core/mat.hpp>

#include "posefusion/common/stamp.h"
#include "posefusion/image/image_motion.h"

namespace posefusion {

/// Estimates how far the content of each image moved while the shutter was open, from two things
/// that fail in different places:
///   how far the image has moved since the one before, times exposure over the time between them:
///   good for lasting motion such as a fall, blind for a knock shorter than a frame;
///   how much sharpness was lost against the image before (SharpnessLoss): good for a knock,
///   but it drifts when summed up over a long motion.
/// The previous estimate plus the loss gives one length, the motion the other; the result lies
/// between them, nearer to the loss when that says more blur. What is in view plays no part: a
/// scene of less texture loses nothing against itself. Images come in stamp order. The same images
/// give the same lengths. Not thread-safe.
class BlurLength {
 public:
  explicit BlurLength(double exposure_s) : exposure_s_(exposure_s) {}

  /// Length in pixels for the next image (CV_8UC1); a small one for the first, and for one after
  /// a gap of more than 0.2 s, after a step back in time or of another size.
  double Next(const cv::Mat& grey, StampNs stamp_ns);

  /// Takes the length of the image before to be small: nothing could be seen in it.
  void Forget();

 private:
  bool Follows(const cv::Mat& grey, StampNs stamp_ns) const;
  double Combine(double moved_px, double loss);

  const double exposure_s_;
  ImageMotion motion_;
  cv::Mat smooth_;  ///< the last image
  StampNs stamp_ns_ = 0;
  double length_px_ = 0;  ///< of the last image, as the base of the next
};

}  // namespace posefusion
