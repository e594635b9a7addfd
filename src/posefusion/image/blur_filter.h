#pragma once

#include <opencv2/core/mat.hpp>

#include "posefusion/common/stamp.h"
#include "posefusion/image/blur_length.h"

namespace posefusion {

/// What blur is judged by.
enum class BlurMode {
  kAbsolute,  ///< variance of the Laplacian, as in the paper; depends on camera, room and exposure
  kLength,    ///< estimated length of the motion blur
};

struct BlurFilterConfig {
  bool enabled = true;
  BlurMode mode = BlurMode::kLength;
  double threshold = 100;      ///< absolute mode: scores below are blurred [grey levels^2]
  double max_length_px = 4.0;  ///< length mode: longer blur is dropped
  /// Length mode: an image with more fine detail left is kept all the same, unless it lost much of
  /// it at once: it is of use, and a camera that always moves fast has none better [grey levels^2].
  double enough_detail = 46;
  double exposure_s = 0.012;       ///< length mode: how long the colour camera's shutter is open
  int max_consecutive_drops = 30;  ///< then one frame is kept whatever its score
  double min_contrast = 10;        ///< below it an image has no texture to judge by [grey levels^2]
};

template <class V>
void Describe(V& v, BlurFilterConfig& c) {
  v.Field("enabled", c.enabled);
  v.Choice("mode", c.mode, {"absolute", "length"});
  v.Field("threshold", c.threshold, 0.0, 1e6);
  v.Field("max_length_px", c.max_length_px, 0.0, 1000.0);
  v.Field("enough_detail", c.enough_detail, 0.0, 1e5);
  v.Field("exposure_s", c.exposure_s, 0.0, 1.0);
  v.Field("max_consecutive_drops", c.max_consecutive_drops, 0, 1000);
  v.Field("min_contrast", c.min_contrast, 0.0, 1e6);
}

/// Why a frame is kept or dropped.
enum class BlurReason {
  kDisabled,   ///< kept: the filter is off, nothing was measured
  kSharp,      ///< kept
  kDetailed,   ///< kept: longer blur, but enough detail
  kNoTexture,  ///< kept: nothing to judge by, such as a white wall
  kDropLimit,  ///< kept although blurred, after max_consecutive_drops dropped ones
  kBlurred,    ///< dropped
};

const char* ToString(BlurReason reason);

struct BlurDecision {
  bool keep = true;
  /// Length mode: estimated length of the blur [px], more is worse. Absolute mode: variance of the
  /// Laplacian [grey levels^2], less is worse.
  double score = 0;
  double threshold = 0;  ///< what the score was compared with
  BlurReason reason = BlurReason::kSharp;
};

/// Numbers of frames, as in Table I of the paper.
struct BlurCounts {
  int seen = 0;
  int dropped = 0;
};

/// Decides which frames are too blurred to be used (paper, section III-A). Frames come in stamp
/// order; the same frames give the same decisions. Not thread-safe.
class BlurFilter {
 public:
  /// @throws std::invalid_argument naming the key for a value out of range.
  explicit BlurFilter(const BlurFilterConfig& config);

  /// Judges the next frame's colour image (CV_8UC3, R G B); 3 ms for 640x480.
  /// @throws std::invalid_argument for an empty image or another type.
  BlurDecision Judge(const cv::Mat& rgb, StampNs stamp_ns);

  const BlurCounts& counts() const { return counts_; }
  const BlurFilterConfig& config() const { return config_; }

 private:
  BlurDecision CompareScore(const cv::Mat& grey) const;
  BlurDecision CompareLength(const cv::Mat& grey, StampNs stamp_ns);

  const BlurFilterConfig config_;
  BlurLength length_;
  int consecutive_drops_ = 0;
  BlurCounts counts_;
};

}  // namespace posefusion
