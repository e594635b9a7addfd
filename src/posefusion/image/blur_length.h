#pragma once

#include <opencv2/core/mat.hpp>

#include "posefusion/common/stamp.h"
#include "posefusion/image/image_motion.h"

namespace posefusion {

/// What is known of the blur of an image.
struct BlurEstimate {
  double length_px = 0;    ///< how far its content moved while the shutter was open
  double detail = 0;       ///< what fine detail it has left, see FineDetail() [grey levels^2]
  bool is_sudden = false;  ///< much sharpness was lost at once; this alone shows blur
};

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

  /// The next image (CV_8UC1). Its length is taken to be small for the first, and for one after a
  /// gap of more than 0.2 s, after a step back in time or of another size.
  BlurEstimate Next(const cv::Mat& grey, StampNs stamp_ns);

  /// The next image does not follow on another: nothing could be seen in the last.
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
